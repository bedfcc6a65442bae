// Assembled shells: nets are cut along rows of joints into blocks, and blocks are joined at these
// cuts into a larger footprint [Baek 2018, Fig. 5].
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

/// A side of a block in the footprint: east and west are the directions of +(u + v) and -(u + v),
/// north and south those of +(v - u) and -(v - u).
enum class Side { east, west, north, south };

/// A building block: a net, the part of its (u, v) plane that is used, and the rows of joints at
/// which it is cut. A cut at row m of the east side retains u + v <= m d, of the west side
/// u + v >= m d; the north and south sides likewise with v - u.
struct Block {
  std::string name;
  std::shared_ptr<const ChebyshevNet> net;
  std::shared_ptr<const Domain> domain;  ///< its part of the (u, v) plane, before the cuts
  /// moves the net into the common frame of all blocks: its boundary in z = 0, +(u + v) along x
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double spacing = 0;  ///< d, mm
  Placement placement = Placement::half;
  std::array<std::optional<int>, 4>
      cut;  ///< row m of each side, in the order of Side; empty: no cut
};

/// One side of block number `block` of a list.
struct BlockSide {
  int block = 0;
  Side side = Side::east;
};

/// Two sides that are joined in a seam: an east and a west side, or a north and a south side.
struct Join {
  BlockSide first, second;
};

/// A rod that crosses a seam.
struct SeamRod {
  Family family = Family::u;
  double line_mm = 0;   ///< v of a u-rod, u of a v-rod, in the complete footprint
  double gap_mm = 0;    ///< distance between its positions on the two nets at the seam
  double kink_deg = 0;  ///< angle between its tangents on the two nets there
};

/// The rods across one seam, in order along it.
struct Seam {
  BlockSide first, second;
  std::string name;  ///< "left.east - middle.west"
  std::vector<SeamRod> rods;
  double max_gap_mm() const;
  double max_kink_deg() const;
};

/// A rod of a single block as a polyline, at the block's position in the assembled shell.
struct BlockRod {
  Eigen::Matrix3Xd net;   ///< points on the net, mm
  Eigen::Matrix2Xd flat;  ///< the same points in the complete footprint, mm
};

/// Joined blocks: their footprints in one plane, their nets in one space.
class Assemblage {
 public:
  /// Joins the blocks. In the footprint each block is translated by an integer number of cells, so
  /// that the joints of its seams coincide; its net is translated horizontally, so that the middles
  /// of the seams coincide. The first block is not moved.
  ///
  /// Errors (bad_input), naming the sides: blocks of unequal d or placement; sides that do not face
  /// one another, are not cut, or are cut and not joined; another number or order of rods across a
  /// seam (with both counts); a rod whose gap is above `max_gap_mm` (with the gap and the kink); a
  /// block without a seam; joins round a loop that do not close; blocks that overlap.
  static Result<Assemblage> make(std::vector<Block> blocks, const std::vector<Join>& joins,
                                 double max_gap_mm);

  /// The net of the assembled shell: that of the block that contains a point; on a seam the mean of
  /// the nets of both blocks.
  std::shared_ptr<const ChebyshevNet> net() const;
  /// The region of the joined footprints. Rods continue across seams.
  std::unique_ptr<Domain> domain() const;
  /// Positions at the columns of `uv`, 3 x n, mm, on the net but without gaps: at a seam each block
  /// is displaced towards the other by half the gap; the displacement decreases to zero within
  /// `fade_mm` of the seam. Errors: those of net()->at().
  Result<Eigen::Matrix3Xd> closed(const Eigen::Matrix2Xd& uv, double fade_mm) const;

  const std::vector<Seam>& seams() const { return seams_; }
  int blocks() const;
  const Block& block(int index) const;
  /// The rods of one block, cut at its boundary and seams, as polylines with steps of at most
  /// `step_mm`. Errors (bad_input): those of its net.
  Result<std::vector<BlockRod>> rods(int index, double step_mm) const;

  struct PositionedBlock;  ///< a block and its position
  using PositionedBlocks = std::vector<PositionedBlock>;

 private:
  std::shared_ptr<const PositionedBlocks> positioned_;
  std::vector<Join> joins_;
  std::vector<Seam> seams_;
};

/// +1 if a cut of this side retains the part below its row (east, north), else -1.
double outward(Side side);

/// A block translated by `shift` in the footprint and by `offset` in space. Arguments (u, v) are
/// positions in the complete footprint, mm.
struct Assemblage::PositionedBlock {
  Block block;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  /// The net, translated, at (u, v). Errors: those of the net.
  Result<NetPoint> at(const Eigen::Vector2d& uv) const;
  /// Distance of `uv` from the cut on `side`, measured in u + v or v - u, positive inside; infinite
  /// without a cut.
  double depth(Side side, const Eigen::Vector2d& uv) const;
  /// Whether `uv` is inside all cuts, with a tolerance of 1e-9 d.
  bool within_cuts(const Eigen::Vector2d& uv) const;
  /// Whether `uv` is inside the boundary before the cuts, with a tolerance of 1e-9 d.
  bool within_boundary(const Eigen::Vector2d& uv) const;
  /// The pieces of a grid line (as Domain::intervals()) inside the block, in order.
  std::vector<Interval> intervals(Family family, double c) const;
  /// Positions (u, v) of the joints on the row of a cut that are inside the boundary, by rising u.
  std::vector<Eigen::Vector2d> row(Side side) const;
  /// The parts of the boundary that the cuts leave: open counter-clockwise polylines that end just
  /// before the cuts. Without cuts the complete boundary.
  std::vector<Eigen::Matrix2Xd> outline(int points) const;
};

inline constexpr std::array<Side, 4> all_sides{Side::east, Side::west, Side::north, Side::south};

}  // namespace gridshell
