// Building blocks: nets cut along rows of joints, where the crossing rods leave v-shaped notches,
// and joined there into larger footprints [Baek 2018, Fig. 5].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/geometry/chebyshev_net.h"

namespace gridshell {

/// A side of a block, by where it faces in the footprint: east and west along u + v, north and
/// south along v - u.
enum class Side { east, west, north, south };

/// A net, the part of its (u, v) plane that is used, and the rows of joints at which it is cut.
/// Cut at row m on its east side it is kept where u + v <= m d, on its west side where
/// u + v >= m d; on its north and south side likewise with v - u.
struct Block {
  std::string name;
  std::shared_ptr<const ChebyshevNet> net;
  std::shared_ptr<const Domain> domain;  ///< before it is cut
  /// puts the net into a frame that all blocks share: its boundary in z = 0, +u + v along x
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double spacing = 0;  ///< d, mm
  Placement placement = Placement::half;
  std::array<std::optional<int>, 4> cut;  ///< by side
};

/// A side of the block with that index in the list of blocks.
struct BlockSide {
  int block = 0;
  Side side = Side::east;
};

/// Two sides that become one seam; they must face one another (east west, or north south).
struct Join {
  BlockSide first, second;
};

/// A rod across a seam: how far apart the two nets put it, and the angle between its tangents.
struct SeamRod {
  Family family = Family::u;
  double line_mm = 0;  ///< v of a u-rod, u of a v-rod, in the whole footprint
  double gap_mm = 0;
  double kink_deg = 0;
};

/// The rods across one seam, in order along it.
struct Seam {
  BlockSide first, second;
  std::string name;  ///< "left.east - middle.west"
  std::vector<SeamRod> rods;
  double max_gap_mm() const;
  double max_kink_deg() const;
};

/// A rod of one block alone, on its net, at its position in the assemblage.
struct BlockRod {
  Eigen::Matrix3Xd net;   ///< points along it, mm
  Eigen::Matrix2Xd flat;  ///< and where they lie in the whole footprint
};

/// Blocks side by side: their footprints in one plane, their nets in one space.
class Assemblage {
 public:
  /// Moves each block in the footprint by whole cells so that the joints of its seams coincide, and
  /// its net straight and level so that the middles of the seams do. The first block stays.
  ///
  /// Errors (bad_input), naming the sides: blocks of unequal d or placement; sides that do not face
  /// one another, are not cut, or are cut and not joined; another number or order of rods across a
  /// seam (with both counts); a rod whose gap is above `max_gap_mm` (with the gap and the kink); a
  /// block without a seam; joins round a loop that do not close; blocks that overlap.
  static Result<Assemblage> make(std::vector<Block> blocks, const std::vector<Join>& joins,
                                 double max_gap_mm);

  /// The nets piece by piece; on a seam the middle of both.
  std::shared_ptr<const ChebyshevNet> net() const;
  /// The inside of the joined footprints; rods run on across seams.
  std::unique_ptr<Domain> domain() const;
  /// A position near the net at every column of `uv` without its gaps: each block moved towards the
  /// other by half the gap at the seam, fading out over `fade_mm` away from it. Errors: as net().
  Result<Eigen::Matrix3Xd> closed(const Eigen::Matrix2Xd& uv, double fade_mm) const;

  const std::vector<Seam>& seams() const { return seams_; }
  int blocks() const;
  const Block& block(int index) const;
  /// The rods of one block, cut at its boundary and seams, as polylines of steps of about
  /// `step_mm`. Errors (bad_input): those of its net.
  Result<std::vector<BlockRod>> rods(int index, double step_mm) const;

  struct PlacedBlock;  ///< a block and where it lies
  using Places = std::vector<PlacedBlock>;

 private:
  std::shared_ptr<const Places> places_;
  std::vector<Join> joins_;
  std::vector<Seam> seams_;
};

// A building block where it lies in an assemblage.

/// +1 where a cut keeps what lies below its row (east, north), else -1.
double outward(Side side);

/// A block moved by `shift` in the footprint and by `offset` in space. Points (u, v) are those of
/// the whole footprint, mm.
struct Assemblage::PlacedBlock {
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
