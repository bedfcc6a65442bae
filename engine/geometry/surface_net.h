// A net of equal chords on a surface: what a Chebyshev net becomes on a grid.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/surface.h"

namespace gridshell {

/// Where on a surface a net lies: its axes leave `apex`, a point of the surface, along `along_u`
/// and, at a right angle and to the left of it as `up` is seen from above, v.
struct NetPlace {
  Eigen::Vector3d apex, along_u, up;  ///< mm; unit and orthogonal
  /// below zero where the net is used; not a number counts as outside
  Surface::Function outside;
};

/// The point a chord away from `here` in the plane of the surface's normal and `along`, a unit
/// tangent; nothing: none is found near.
std::optional<Eigen::Vector3d> geodesic_chord(const Surface& surface, const Eigen::Vector3d& here,
                                              const Eigen::Vector3d& along, double chord);

/// The point of the surface near `guess` a chord away from A and from B; nothing: none is near.
std::optional<Eigen::Vector3d> chord_corner(const Surface& surface, const Eigen::Vector3d& guess,
                                            const Eigen::Vector3d& A, const Eigen::Vector3d& B,
                                            double chord);

/// Nodes to each side that a value between two nodes takes.
inline constexpr int net_reach = 3;
/// Those around a cell of a grid, row by row along u.
using NetNodes = std::array<Eigen::Vector3d, 4 * net_reach * net_reach>;

/// The error of who asks for a net where there is none.
tl::unexpected<Error> ended_before(double u, double v);

/// The net at a position in the middle cell, t_u and t_v of it from 0 to 1, by a polynomial of
/// degree 5 in u and in v.
NetPoint net_point(const NetNodes& nodes, double t_u, double t_v, double chord);

/// Points p(i, j) of a surface, neighbours a chord h apart. The axes i and j are geodesics, each
/// point in the plane of the normal and the chord before; all others follow from their two
/// neighbours towards the axes, |p - p(i-1, j)| = |p - p(i, j-1)| = h. Distance from the smooth
/// net: of second order in h.
class ChordGrid {
 public:
  enum class Node : char {
    unasked,  ///< too far outside
    known,
    folded,  ///< rods close to parallel: the sine of their angle is below 0.12
    lost     ///< no point of the surface lies there, or it lies past such nodes
  };
  static constexpr double least_sine = 0.12;

  /// As far as the net is used and `margin` nodes further. Errors (bad_input): the axes do not
  /// leave the used part within `most` nodes.
  static Result<ChordGrid> make(const Surface& surface, const NetPlace& place, double chord_mm,
                                int margin, int most);

  double chord() const { return chord_; }
  int first_u() const { return -before_u_; }
  int last_u() const { return columns_ - before_u_ - 1; }
  int first_v() const { return -before_v_; }
  int last_v() const { return rows_ - before_v_ - 1; }
  bool has(int i, int j) const {
    return i >= first_u() && i <= last_u() && j >= first_v() && j <= last_v();
  }
  Node node(int i, int j) const { return has(i, j) ? nodes_[place(i, j)] : Node::unasked; }
  const Eigen::Vector3d& at(int i, int j) const { return points_[place(i, j)]; }
  /// From now on a node is not known.
  void forget(int i, int j) { nodes_[place(i, j)] = Node::lost; }
  /// Whether the net is used there and joined to the apex by neighbours where it is.
  bool inside(int i, int j) const { return has(i, j) && inside_[place(i, j)] != 0; }

 private:
  ChordGrid() = default;
  std::size_t place(int i, int j) const {
    return std::size_t(j + before_v_) * std::size_t(columns_) + std::size_t(i + before_u_);
  }
  struct Axis;
  void put_axis(const Axis& axis, int step_u, int step_v);
  static Result<Axis> geodesic(const Surface& surface, const NetPlace& place, Eigen::Vector3d along,
                               double chord, int margin, int most);
  void fill(const Surface& surface, const NetPlace& place, int margin, int sign_u, int sign_v);
  void join_inside(const NetPlace& place);

  double chord_ = 0;
  int before_u_ = 0, before_v_ = 0, columns_ = 0, rows_ = 0;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Node> nodes_;
  std::vector<char> inside_;
};

// Chebyshev nets on any surface, found on grids of equal chords.

/// What there is of a net that is refused, mm.
struct PartialNet {
  std::vector<Eigen::Matrix3Xd> lines;  ///< every fourth of the coarser grid, where it is used
  Eigen::Matrix3Xd narrow{3, 0};  ///< its nodes where rods are less than 17 degrees from parallel
  Eigen::Vector3d end = Eigen::Vector3d::Zero();  ///< where it ends too early
};

/// From two geodesics that cross at right angles at u = v = 0. Two grids of equal chords, h and
/// h/2, err by multiples of h^2 to leading order: (4 fine - coarse)/3 takes that away. Between the
/// nodes, 6 x 6 of them make a polynomial of degree 5 in u and in v, from which tangents and
/// curvature come too.
class SurfaceNet final : public ChebyshevNet {
 public:
  /// h, the chord of the coarser grid. Errors (bad_input): those of ChordGrid; where the net ends
  /// though it is used, with the position and what may help; `so_far`, where given, is then filled.
  static Result<SurfaceNet> make(const Surface& surface, const NetPlace& place, double chord_mm,
                                 PartialNet* so_far = nullptr);

  Result<NetPoint> at(double u, double v) const override;

  double chord() const { return grid_.chord(); }
  /// Whether the net is used at a node of the coarser grid, joined to the apex by such nodes.
  bool inside(int i, int j) const { return grid_.inside(i, j); }
  int first_u() const { return grid_.first_u(); }
  int last_u() const { return grid_.last_u(); }
  int first_v() const { return grid_.first_v(); }
  int last_v() const { return grid_.last_v(); }

 private:
  SurfaceNet(ChordGrid grid, std::vector<Eigen::Vector3d> points)
      : grid_(std::move(grid)), points_(std::move(points)) {}
  Result<void> check_whole(PartialNet* so_far) const;
  void tell(PartialNet& so_far) const;
  bool known_about(int i, int j) const;
  const Eigen::Vector3d& point(int i, int j) const {
    const int columns = grid_.last_u() - grid_.first_u() + 1;
    return points_[std::size_t(j - grid_.first_v()) * std::size_t(columns) +
                   std::size_t(i - grid_.first_u())];
  }

  ChordGrid grid_;                       ///< the coarser one
  std::vector<Eigen::Vector3d> points_;  ///< its nodes, extrapolated; row by row
};

}  // namespace gridshell
