// Chebyshev nets on any surface, computed on grids of equal chords.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/surface.h"

namespace gridshell {

/// Position and direction of a net on a surface. The u axis starts at `apex` along `along_u`, the v
/// axis along up x along_u.
struct NetPose {
  Eigen::Vector3d apex;         ///< a point of the surface, mm
  Eigen::Vector3d along_u, up;  ///< unit and orthogonal; `up` is the surface's normal
  /// Below zero at points of the surface that the net is to cover. NaN counts as outside.
  Surface::Function outside;
};

/// The point of the surface at distance `chord` (mm) from `here`, in the plane of the surface's
/// normal and the unit tangent `along`: one step of a geodesic. Empty if no such point is near.
std::optional<Eigen::Vector3d> geodesic_chord(const Surface& surface, const Eigen::Vector3d& here,
                                              const Eigen::Vector3d& along, double chord);

/// The point of the surface at distance `chord` (mm) from both A and B, by Newton's method from
/// `guess`. Empty if no such point is near.
std::optional<Eigen::Vector3d> chord_corner(const Surface& surface, const Eigen::Vector3d& guess,
                                            const Eigen::Vector3d& A, const Eigen::Vector3d& B,
                                            double chord);

/// Number of nodes on each side of a position that interpolation between nodes uses.
inline constexpr int net_reach = 3;
/// The 6 x 6 nodes around a cell of a grid, row by row along u, mm.
using NetNodes = std::array<Eigen::Vector3d, 4 * net_reach * net_reach>;

/// The error (bad_input) "the net ends before (u, v)".
tl::unexpected<Error> ended_before(double u, double v);

/// Position, tangents and curvature of the net inside the middle cell of `nodes`, by a polynomial
/// of degree 5 in u and in v. t_u, t_v: position in the cell, 0 to 1; `chord`: its side, mm.
NetPoint net_point(const NetNodes& nodes, double t_u, double t_v, double chord);

/// A discrete Chebyshev net: points p(i, j) of a surface, neighbours at distance h (the chord). The
/// axes j = 0 and i = 0 are discrete geodesics (geodesic_chord()). Every other point follows from
/// its two neighbours towards the axes: |p(i,j) - p(i-1,j)| = |p(i,j) - p(i,j-1)| = h. It differs
/// from the smooth net by O(h^2).
class ChordGrid {
 public:
  enum class Node : char {
    uncomputed,  ///< not computed: more than `margin` nodes outside the part that is used
    known,       ///< computed
    folded,      ///< rods are close to parallel: the sine of their angle is below least_sine
    lost         ///< the surface has no such point here or at a node towards the axes
  };
  static constexpr double least_sine = 0.12;

  /// Computes all nodes of the part that is used (NetPose::outside below zero) and `margin` nodes
  /// around it. `chord_mm`: h. Errors (bad_input): an axis is still inside that part after `most`
  /// nodes.
  static Result<ChordGrid> make(const Surface& surface, const NetPose& pose, double chord_mm,
                                int margin, int most);

  double chord() const { return chord_; }
  int first_u() const { return -before_u_; }
  int last_u() const { return columns_ - before_u_ - 1; }
  int first_v() const { return -before_v_; }
  int last_v() const { return rows_ - before_v_ - 1; }
  bool has(int i, int j) const {
    return i >= first_u() && i <= last_u() && j >= first_v() && j <= last_v();
  }
  Node node(int i, int j) const { return has(i, j) ? nodes_[index(i, j)] : Node::uncomputed; }
  const Eigen::Vector3d& at(int i, int j) const { return points_[index(i, j)]; }
  /// Marks a node as lost.
  void forget(int i, int j) { nodes_[index(i, j)] = Node::lost; }
  /// Whether node (i, j) is in the part that is used and connected to the apex by nodes of it.
  bool inside(int i, int j) const { return has(i, j) && inside_[index(i, j)] != 0; }

 private:
  ChordGrid() = default;
  std::size_t index(int i, int j) const {
    return std::size_t(j + before_v_) * std::size_t(columns_) + std::size_t(i + before_u_);
  }
  struct Axis;
  void put_axis(const Axis& axis, int step_u, int step_v);
  static Result<Axis> geodesic(const Surface& surface, const NetPose& pose, Eigen::Vector3d along,
                               double chord, int margin, int most);
  void fill(const Surface& surface, const NetPose& pose, int margin, int sign_u, int sign_v);
  void join_inside(const NetPose& pose);

  double chord_ = 0;
  int before_u_ = 0, before_v_ = 0, columns_ = 0, rows_ = 0;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Node> nodes_;
  std::vector<char> inside_;
};

/// The computed part of a net that was refused, for a picture of what went wrong; mm.
struct PartialNet {
  std::vector<Eigen::Matrix3Xd> lines;  ///< every fourth line of the coarser grid
  Eigen::Matrix3Xd narrow{3, 0};        ///< nodes where rods cross at less than 17 degrees
  Eigen::Vector3d end = Eigen::Vector3d::Zero();  ///< the position at which the net ends too early
};

/// The smooth Chebyshev net whose axes are two geodesics that cross at right angles at u = v = 0.
/// It is computed on two ChordGrids, of h and h/2, and extrapolated: (4 fine - coarse)/3
/// [Richardson 1911]. Between the nodes, positions, tangents and curvature are those of a
/// polynomial of degree 5 in u and in v through 6 x 6 nodes (net_point()).
class SurfaceNet final : public ChebyshevNet {
 public:
  /// `chord_mm`: h of the coarser grid. Errors (bad_input): those of ChordGrid::make(); a net that
  /// ends inside the part that is used, with the position and what may help. On such an error
  /// `so_far`, if given, receives the part that was computed.
  static Result<SurfaceNet> make(const Surface& surface, const NetPose& pose, double chord_mm,
                                 PartialNet* so_far = nullptr);

  Result<NetPoint> at(double u, double v) const override;

  double chord() const { return grid_.chord(); }
  /// As ChordGrid::inside(), of the coarser grid.
  bool inside(int i, int j) const { return grid_.inside(i, j); }
  int first_u() const { return grid_.first_u(); }
  int last_u() const { return grid_.last_u(); }
  int first_v() const { return grid_.first_v(); }
  int last_v() const { return grid_.last_v(); }

 private:
  SurfaceNet(ChordGrid grid, std::vector<Eigen::Vector3d> points)
      : grid_(std::move(grid)), points_(std::move(points)) {}
  Result<void> check_whole(PartialNet* so_far) const;
  void report_to(PartialNet& so_far) const;
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
