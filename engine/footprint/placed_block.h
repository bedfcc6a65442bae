// A building block where it lies in an assemblage.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/blocks.h"

namespace gridshell {

/// How far a point lies along the direction of `side`'s pair: u + v, or v - u.
double along_sides(Side side, const Eigen::Vector2d& uv);

/// +1 where a cut keeps what lies below its row (east, north), else -1.
double outward(Side side);

/// A block moved by `shift` in the footprint and by `offset` in space. Points (u, v) are those of
/// the whole footprint, mm.
struct Assemblage::Placed {
  Block block;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  /// The net there, in place. Errors: those of the net.
  Result<NetPoint> at(const Eigen::Vector2d& uv) const;
  /// How far `uv` lies inside the cut on `side`, along u + v or v - u; infinite without a cut.
  double depth(Side side, const Eigen::Vector2d& uv) const;
  /// Whether `uv` lies inside all cuts, and inside the uncut boundary, to 1e-9 d.
  bool within_cuts(const Eigen::Vector2d& uv) const;
  bool within_boundary(const Eigen::Vector2d& uv) const;
  /// Pieces of a grid line inside, in order.
  std::vector<Interval> intervals(Family family, double c) const;
  /// The joints on the row of a cut that lie inside, by growing u.
  std::vector<Eigen::Vector2d> row(Side side) const;
  /// The boundary without what the cuts take away, open polylines counter-clockwise that end just
  /// before the cuts; the whole boundary of a block without cuts.
  std::vector<Eigen::Matrix2Xd> outline(int points) const;
};

inline constexpr std::array<Side, 4> all_sides{Side::east, Side::west, Side::north, Side::south};

}  // namespace gridshell
