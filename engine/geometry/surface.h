// Surfaces F(x, y, z) = 0: an expression that a user gives, or a smooth surface through the
// vertices of a triangle mesh; and the mesh itself.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/proximity.h"
#include "engine/core/result.h"
#include "engine/geometry/mesh_lines.h"

namespace gridshell {

/// A point where two triangles without a common vertex meet; empty: there is none. `size` is about
/// the size of the triangles, mm: the search uses boxes of it. Errors (bad_input): triangles so
/// uneven in size, or so many at one position, that the search would take too long.
Result<std::optional<Eigen::Vector3d>> first_crossing(
    const Eigen::Matrix3Xd& vertices, const std::vector<std::array<int, 3>>& triangles,
    double size);

/// An error of a mesh (bad_input), with the position.
tl::unexpected<Error> mesh_error(const std::string& what, const Eigen::Vector3d& position);

/// One connected, two-sided sheet of triangles, all with the same orientation, that does not meet
/// itself.
class TriangleMesh {
 public:
  using Triangles = std::vector<std::array<int, 3>>;

  /// Vertices without a triangle are left out. Errors (bad_input), with the position: a triangle
  /// without area, an edge with three triangles, several pieces, a mesh with one side only,
  /// neighbours folded onto one another, triangles that meet elsewhere than at their edges, an
  /// index of a vertex that does not exist; those of lines_of().
  static Result<TriangleMesh> make(const Eigen::Matrix3Xd& vertices, Triangles triangles);

  const Eigen::Matrix3Xd& vertices() const { return vertices_; }
  const Triangles& triangles() const { return triangles_; }
  const Eigen::Matrix3Xd& normals() const { return normals_; }  ///< unit normal at each vertex
  /// Vertices joined to each by an edge.
  const std::vector<std::vector<int>>& neighbours() const { return neighbours_; }
  const std::vector<MeshLine>& lines() const { return lines_; }
  /// Whether a vertex is on the rim or at a hole.
  bool on_rim(int vertex) const { return on_rim_[std::size_t(vertex)] != 0; }
  bool on_crease(int vertex) const { return on_crease_[std::size_t(vertex)] != 0; }
  double mean_edge() const { return mean_edge_; }
  double longest_edge(int vertex) const { return longest_[std::size_t(vertex)]; }
  /// The first corner of a triangle and the two sides from it.
  std::array<Eigen::Vector3d, 3> corner_and_sides(const std::array<int, 3>& triangle) const {
    const Eigen::Vector3d p = vertices_.col(triangle[0]);
    return {p, vertices_.col(triangle[1]) - p, vertices_.col(triangle[2]) - p};
  }
  double area() const;
  double size() const;  ///< the longest side of the box around it

 private:
  Eigen::Matrix3Xd vertices_, normals_;
  Triangles triangles_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<MeshLine> lines_;
  std::vector<char> on_rim_, on_crease_;
  std::vector<double> longest_;
  double mean_edge_ = 0;
};

/// The surface where a function F of space is zero. `length_mm`: a length that is small compared
/// with the radii of curvature; derivatives of F are differences over a thousandth of it.
class Surface {
 public:
  using Function = std::function<double(const Eigen::Vector3d&)>;
  Surface(Function F, double length_mm) : F_(std::move(F)), h_(1e-3 * length_mm) {}

  double at(const Eigen::Vector3d& p) const { return F_(p); }
  /// grad F, by central differences: relative error about 1e-8.
  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;
  /// The point of the surface that is reached from p along the gradient of F, by Newton's method.
  /// Errors (bad_input): no point is found near p; F has no value or a zero gradient.
  Result<Eigen::Vector3d> nearest(const Eigen::Vector3d& p) const;

  /// The curvature of the surface at one of its points.
  struct Curvature {
    Eigen::Matrix3d axes;  ///< columns: first and second principal direction, unit normal
    double first,
        second;    ///< principal curvatures, 1/mm, |first| >= |second|, signed by the normal
    bool umbilic;  ///< whether both are equal, so that the directions are arbitrary
  };
  /// The curvature at a point of the surface, by differences of gradients: relative error about
  /// 1e-5.
  Curvature curvature(const Eigen::Vector3d& p) const;

 private:
  Function F_;
  double h_;
};

/// A smooth surface F = 0 through the vertices of a mesh: a partition of unity of local fits
/// [Ohtake, Belyaev, Alexa, Turk, Seidel 2003]. F(p) = sum w_k F_k / sum w_k over centres k
/// distributed over the mesh. The weight w_k falls to zero at a radius about its centre. F_k is the
/// height of p above a polynomial of degree 4 over the tangent plane of the centre, fitted to the
/// vertices around by weighted least squares; the degree is lower if these are few. Near the
/// surface F is the distance from it. The error is of fifth order in the length of the edges; F is
/// three times continuously differentiable.
///
/// F continues past the mesh's rim for about three quarters of `detail_mm`; further out it has no
/// value. The two sides of a crease are independent: the distance of a point behind a crease is the
/// length of the path around the crease's end. F has no value where the mesh bends too sharply for
/// a polynomial or where another part of it is too near.
class MeshSurface {
 public:
  /// `detail_mm`: the spacing of the rods; details smaller than a quarter of it are smoothed.
  /// `fit_mm`: allowed distance of vertices from the surface, which is as smooth as this allows; 0:
  /// a thousandth of the mesh's size, or more if needed. Errors (bad_input): a vertex further than
  /// `fit_mm` from the fitted surface, with its position; no part of the mesh is smooth; the mesh
  /// is too large compared with `detail_mm`, or its triangles are too uneven in size.
  static Result<MeshSurface> fit(const TriangleMesh& mesh, double detail_mm, double fit_mm = 0);

  double at(const Eigen::Vector3d& p) const;  ///< F(p), mm; NaN far from the mesh
  /// Largest distance of a vertex from the surface, mm, except vertices at creases or without a
  /// value.
  double largest_distance() const { return farthest_; }
  /// Position of that vertex.
  const Eigen::Vector3d& farthest_vertex() const { return farthest_at_; }

 private:
  static constexpr int degree = 4, terms = (degree + 1) * (degree + 2) / 2;
  struct Patch {
    Eigen::Vector3d centre;
    Eigen::Matrix3d axes;                    ///< rows: two tangents, the normal
    Eigen::Matrix<double, terms, 1> height;  ///< coefficients of u^a v^b, u and v over the radius
    double radius = 1;                       ///< radius of the fit
    double reach = 0;                        ///< distance at which its weight becomes zero
    double slope = 1;                        ///< |grad| of the height above it at its centre
    bool near_crease = false;                ///< whether a crease is within its radius
  };
  explicit MeshSurface(double reach) : near_(reach / 2) {}
  static Result<MeshSurface> fitted(const TriangleMesh& mesh, const Barriers& lines,
                                    double detail_mm, double radii);
  static Eigen::Matrix<double, terms, 1> powers(double u, double v);
  static double above(const Patch& patch, const Eigen::Vector3d& p);
  static std::optional<Patch> patch_of(const TriangleMesh& mesh, int vertex,
                                       const std::vector<int>& around, double radius);
  double distance(const Patch& patch, const Eigen::Vector3d& p) const;
  void measure(const TriangleMesh& mesh);

  std::vector<Patch> patches_;
  BoxGrid near_;
  Barriers lines_;
  double farthest_ = 0;
  Eigen::Vector3d farthest_at_ = Eigen::Vector3d::Zero();
};

/// Height of the highest point of the mesh above or below (x, y); empty: there is none.
std::optional<double> highest_at(const TriangleMesh& mesh, double x, double y);

/// A function of x, y and z (mm) that a user gives as text, "x^2 + 2*y^2 - sin(z)": arithmetic with
/// ^, the usual functions and _pi, evaluated by muParser. An expression and its copies must not be
/// evaluated by several threads at the same time.
class Expression {
 public:
  /// Errors (bad_input): the text is no expression, with the position counted from 1.
  static Result<Expression> parse(const std::string& text);

  const std::string& text() const { return text_; }
  /// The value at a point; NaN if it has none.
  double at(const Eigen::Vector3d& point) const;

 private:
  struct Parsed;
  Expression(std::string text, std::shared_ptr<Parsed> parsed)
      : text_(std::move(text)), parsed_(std::move(parsed)) {}

  std::string text_;
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace gridshell
