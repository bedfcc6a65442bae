// Surfaces F(x, y, z) = 0.
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

/// A point where two triangles without a common vertex meet; nothing: there is none. They are
/// looked for among boxes of about `size`, mm. Errors (bad_input): triangles so uneven in size, or
/// so many at one position, that it would take too long.
Result<std::optional<Eigen::Vector3d>> first_crossing(
    const Eigen::Matrix3Xd& vertices, const std::vector<std::array<int, 3>>& triangles,
    double size);

// A mesh of triangles that is a surface.

/// What is wrong with a mesh, with the position.
tl::unexpected<Error> mesh_error(const std::string& what, const Eigen::Vector3d& place);

/// One connected, two-sided sheet of triangles, all with the same orientation, that does not meet
/// itself.
class TriangleMesh {
 public:
  using Triangles = std::vector<std::array<int, 3>>;

  /// Vertices that no triangle has are left out. Errors (bad_input), with the position: a triangle
  /// of no area, an edge of three triangles, several pieces, a mesh of one side, neighbours folded
  /// onto one another, triangles that meet elsewhere than at their edges, a number of a vertex that
  /// is not there; those of lines_of().
  static Result<TriangleMesh> make(const Eigen::Matrix3Xd& vertices, Triangles triangles);

  const Eigen::Matrix3Xd& vertices() const { return vertices_; }
  const Triangles& triangles() const { return triangles_; }
  const Eigen::Matrix3Xd& normals() const { return normals_; }  ///< of the vertices, unit
  /// Vertices joined to each by an edge.
  const std::vector<std::vector<int>>& neighbours() const { return neighbours_; }
  const std::vector<MeshLine>& lines() const { return lines_; }
  bool on_rim(int vertex) const { return on_rim_[std::size_t(vertex)] != 0; }  ///< or at a hole
  bool on_crease(int vertex) const { return on_crease_[std::size_t(vertex)] != 0; }
  double mean_edge() const { return mean_edge_; }
  double longest_edge(int vertex) const { return longest_[std::size_t(vertex)]; }
  /// A corner of a triangle and the sides to the next and the last.
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

/// Where a function of space is zero. `length_mm`: how far apart values are taken whose differences
/// are its slopes; small compared with the radii of the surface's curvature.
class Surface {
 public:
  using Function = std::function<double(const Eigen::Vector3d&)>;
  Surface(Function F, double length_mm) : F_(std::move(F)), h_(1e-3 * length_mm) {}

  double at(const Eigen::Vector3d& p) const { return F_(p); }
  /// grad F, by central differences: relative error about 1e-8.
  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;
  /// The point of the surface along the slope of F from p, by Newton's method. Errors (bad_input):
  /// none is found near, F has no value or no slope there.
  Result<Eigen::Vector3d> nearest(const Eigen::Vector3d& p) const;

  /// The curvature of the surface at one of its points.
  struct Curvature {
    Eigen::Matrix3d axes;  ///< columns: first and second principal direction, unit normal
    double first,
        second;    ///< principal curvatures, 1/mm, |first| >= |second|, signed by the normal
    bool umbilic;  ///< both equal: the directions mean nothing
  };
  /// Second derivatives by differences of the slopes: relative error about 1e-5.
  Curvature curvature(const Eigen::Vector3d& p) const;

 private:
  Function F_;
  double h_;
};

// A smooth surface through the vertices of a mesh.

/// F = 0, where F(p) = sum w_k F_k / sum w_k over centres spread on the mesh, w_k falling to zero
/// at a radius about each; F_k is the height of p above a polynomial of degree 4 over the tangent
/// plane of its centre, fitted to the vertices around by weighted least squares, so near the
/// surface F is the distance from it (a partition of unity of local fits [Ohtake, Belyaev, Alexa,
/// Turk, Seidel 2003]). Error of fifth order in the length of the edges; three times continuously
/// differentiable. Where few vertices are around, the degree is lower. It continues past the mesh's
/// rim for some three quarters of `detail_mm`, further out it has no value. At creases it has two
/// sides that know nothing of one another: what lies behind a crease is as far away as the path
/// around the crease's end is long. Where the mesh turns too sharply for a polynomial, or another
/// part of it is too near, it has no value.
class MeshSurface {
 public:
  /// `detail_mm`: what is a quarter as large is not followed any more, mm (the spacing of the
  /// rods). `fit_mm`: how far vertices may lie off the surface, which is as smooth as this allows;
  /// 0: a thousandth of the mesh's size, or what is needed. Errors (bad_input): vertices off the
  /// fitted surface by more than `fit_mm`, with the position; no part of the mesh that is smooth;
  /// too large a mesh for its details, or too uneven a one.
  static Result<MeshSurface> fit(const TriangleMesh& mesh, double detail_mm, double fit_mm = 0);

  double at(const Eigen::Vector3d& p) const;  ///< not a number far from the mesh
  /// Deviations of the mesh's vertices, those at creases and without a value left out.
  double largest_distance() const { return farthest_; }
  const Eigen::Vector3d& farthest_vertex() const { return farthest_at_; }

 private:
  static constexpr int degree = 4, terms = (degree + 1) * (degree + 2) / 2;
  struct Patch {
    Eigen::Vector3d centre;
    Eigen::Matrix3d axes;                    ///< rows: two tangents, the normal
    Eigen::Matrix<double, terms, 1> height;  ///< by u^a v^b over the fit's radius
    double radius = 1;                       ///< of the fit
    double reach = 0;                        ///< where its weight becomes zero
    double slope = 1;                        ///< |grad| of the height above it at its centre
    bool beside_crease = false;
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

/// The highest point of the mesh above or below (x, y); nothing: it has none.
std::optional<double> highest_at(const TriangleMesh& mesh, double x, double y);

// A function of x, y and z that a user writes down.

/// "x^2 + 2*y^2 - sin(z)": arithmetic with ^, the usual functions, _pi, and x, y, z in mm; read by
/// muParser. Its copies share what they compute with: one thread at a time.
class Expression {
 public:
  /// Errors (bad_input): what does not parse, with the position counted from 1.
  static Result<Expression> parse(const std::string& text);

  const std::string& text() const { return text_; }
  /// Not a number where it has no value.
  double at(const Eigen::Vector3d& point) const;

 private:
  struct Parsed;
  Expression(std::string text, std::shared_ptr<Parsed> parsed)
      : text_(std::move(text)), parsed_(std::move(parsed)) {}

  std::string text_;
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace gridshell
