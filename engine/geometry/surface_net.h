// Chebyshev nets on any surface, found on grids of equal chords.
#pragma once

#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/chord_grid.h"

namespace gridshell {

/// What there is of a net that is refused, mm.
struct NetSoFar {
  std::vector<Eigen::Matrix3Xd> lines;  ///< every fourth of the coarser grid, where it is wanted
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
  /// though it is wanted, with the place and what may help; `so_far`, where given, is then filled.
  static Result<SurfaceNet> make(const Surface& surface, const NetPlace& place, double chord_mm,
                                 NetSoFar* so_far = nullptr);

  Result<NetPoint> at(double u, double v) const override;

  double chord() const { return grid_.chord(); }
  /// Whether the net is wanted at a node of the coarser grid, joined to the apex by such nodes.
  bool inside(int i, int j) const { return grid_.inside(i, j); }
  int first_u() const { return grid_.first_u(); }
  int last_u() const { return grid_.last_u(); }
  int first_v() const { return grid_.first_v(); }
  int last_v() const { return grid_.last_v(); }

 private:
  SurfaceNet(ChordGrid grid, std::vector<Eigen::Vector3d> points)
      : grid_(std::move(grid)), points_(std::move(points)) {}
  Result<void> check_whole(NetSoFar* so_far) const;
  void tell(NetSoFar& so_far) const;
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
