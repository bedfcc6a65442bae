#include "engine/footprint/assemblage.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/dense.h"
#include "engine/core/try.h"

namespace gridshell {
namespace {

// distance over d below which two positions are equal
constexpr double same = 1e-9;

bool inside(const std::vector<Interval>& pieces, double at, double margin) {
  return std::ranges::any_of(pieces, [&](const Interval& piece) {
    return at > piece.begin + margin && at < piece.end - margin;
  });
}

using Line = std::vector<Eigen::Vector2d>;

/// The parts of a polyline inside a cut. They end before the cut: points on it would be in the
/// outlines of both blocks.
std::vector<Line> clipped(const Line& line, const Assemblage::PositionedBlock& block, Side side) {
  std::vector<Line> kept;
  bool open = false;
  for (const Eigen::Vector2d& point : line) {
    const bool inside = block.depth(side, point) > same * block.block.spacing;
    if (inside && !open) kept.emplace_back();
    if (inside) kept.back().push_back(point);
    open = inside;
  }
  return kept;
}

using PositionedBlocks = Assemblage::PositionedBlocks;
using PositionedBlock = Assemblage::PositionedBlock;

std::string name_of(const PositionedBlocks& positioned, const BlockSide& side) {
  return fmt::format("{}.{}", positioned[side.block].block.name, word_of(side.side));
}

std::string name_of(const PositionedBlocks& positioned, const Join& join) {
  return name_of(positioned, join.first) + " - " + name_of(positioned, join.second);
}

tl::unexpected<Error> refuse(const PositionedBlocks& positioned, const Join& join,
                             const std::string& why) {
  return invalid("seam {}: {}", name_of(positioned, join), why);
}

bool face(Side a, Side b) {
  // the opposite sides are neighbours in the enum: east and west, north and south
  return a != b && int(a) / 2 == int(b) / 2;
}

Result<void> check_sides(const PositionedBlocks& positioned, const std::vector<Join>& joins) {
  std::vector<std::array<int, 4>> used(positioned.size(), {0, 0, 0, 0});
  for (const Join& join : joins) {
    if (!face(join.first.side, join.second.side))
      return refuse(positioned, join,
                    "the sides do not face one another; join east with west or north with south");
    for (const BlockSide& side : {join.first, join.second}) {
      if (!positioned[side.block].block.cut[std::size_t(side.side)])
        return refuse(positioned, join,
                      fmt::format("{} is not cut at a row of joints", name_of(positioned, side)));
      if (++used[side.block][std::size_t(side.side)] > 1)
        return refuse(positioned, join,
                      fmt::format("{} is joined twice", name_of(positioned, side)));
    }
    const Block &a = positioned[join.first.block].block, &b = positioned[join.second.block].block;
    if (a.spacing != b.spacing)
      return refuse(positioned, join,
                    fmt::format("the distance between rods is d = {:g} mm and {:g} mm, expected "
                                "the same",
                                a.spacing, b.spacing));
    if (a.placement != b.placement)
      return refuse(positioned, join,
                    "rods lie on the axes of one block and next to those of the other");
  }
  for (int k = 0; k < int(positioned.size()); ++k)
    for (const Side side : all_sides)
      if (positioned[k].block.cut[std::size_t(side)] && !used[k][std::size_t(side)])
        return invalid("{} is cut and not joined: its rods would end in the air",
                       name_of(positioned, BlockSide{k, side}));
  return {};
}

/// Shift of the second block against the first that brings the joints of their rows together.
Result<Eigen::Vector2d> shift_of(const PositionedBlocks& positioned, const Join& join) {
  const auto a = positioned[join.first.block].row(join.first.side);
  const auto b = positioned[join.second.block].row(join.second.side);
  if (a.size() != b.size() || a.empty())
    return refuse(positioned, join,
                  fmt::format("got {} rods across {} and {} across {}, expected equal numbers, at "
                              "least 2: change a radius, a crossing angle or a row",
                              2 * a.size(), name_of(positioned, join.first), 2 * b.size(),
                              name_of(positioned, join.second)));
  const Eigen::Vector2d shift = a.front() - b.front();
  for (std::size_t k = 0; k < a.size(); ++k)
    if ((a[k] - b[k] - shift).norm() > 1e-9 * positioned[join.first.block].block.spacing)
      return refuse(positioned, join,
                    fmt::format("its {} rods do not follow one another in the same order on both "
                                "sides",
                                2 * a.size()));
  return shift;
}

/// Both nets at the joints of a seam between two blocks with known positions.
Result<std::vector<std::array<NetPoint, 2>>> pairs_at(const PositionedBlocks& positioned,
                                                      const Join& join) {
  std::vector<std::array<NetPoint, 2>> pairs;
  for (const Eigen::Vector2d& joint : positioned[join.first.block].row(join.first.side)) {
    TRY(a, positioned[join.first.block].at(joint), b = positioned[join.second.block].at(joint));
    if (!b) return tl::unexpected(b.error());
    pairs.push_back({*a, *b});
  }
  return pairs;
}

/// Moves one block of a join next to the other: the second block if `second`, else the first.
Result<void> move_next_to(PositionedBlocks& positioned, const Join& join, bool second) {
  TRY(shift, shift_of(positioned, join));
  PositionedBlock& moved = positioned[second ? join.second.block : join.first.block];
  moved.shift += second ? *shift : Eigen::Vector2d(-*shift);
  TRY(pairs, pairs_at(positioned, join));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& [a, b] : *pairs) middle += (a.position - b.position) / double(pairs->size());
  // only horizontally: all boundaries remain in one plane
  middle.z() = 0;
  moved.offset += second ? middle : Eigen::Vector3d(-middle);
  return {};
}

/// Positions all blocks, starting from the first, along the joins.
Result<void> position_all(PositionedBlocks& positioned, const std::vector<Join>& joins) {
  std::vector<char> known(positioned.size(), 0);
  known.front() = 1;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Join& join : joins) {
      const int a = join.first.block, b = join.second.block;
      if (known[a] == known[b]) continue;
      if (auto done = move_next_to(positioned, join, known[a]); !done) return done;
      known[a] = known[b] = moved = true;
    }
  }
  for (std::size_t k = 0; k < positioned.size(); ++k)
    if (!known[k])
      return invalid("no join connects block \"{}\" to block \"{}\"", positioned[k].block.name,
                     positioned.front().block.name);
  return {};
}

Result<Seam> seam_of(const PositionedBlocks& positioned, const Join& join, double max_gap) {
  // all blocks have their positions: a remaining shift means that a loop of joins does not close
  TRY(shift, shift_of(positioned, join));
  const double d = positioned.front().block.spacing;
  if (shift->norm() > 1e-9 * d)
    return refuse(
        positioned, join,
        fmt::format(
            "the joins round the loop leave a gap of ({:.4g}, {:.4g}) cells between the sides",
            shift->x() / d, shift->y() / d));
  TRY(pairs, pairs_at(positioned, join));
  const auto joints = positioned[join.first.block].row(join.first.side);
  Seam seam{join.first, join.second, name_of(positioned, join), {}};
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& [a, b] = (*pairs)[k];
    const double gap = (a.position - b.position).norm();
    seam.rods.push_back(
        {Family::u, joints[k].y(), gap, angle_between(a.tangent_u, b.tangent_u) * 180 / M_PI});
    seam.rods.push_back(
        {Family::v, joints[k].x(), gap, angle_between(a.tangent_v, b.tangent_v) * 180 / M_PI});
  }
  for (std::size_t k = 0; k + 1 < seam.rods.size(); k += 2) {
    const SeamRod &u = seam.rods[k], &v = seam.rods[k + 1];
    if (seam.max_gap_mm() <= max_gap || u.gap_mm < seam.max_gap_mm()) continue;
    return refuse(
        positioned, join,
        fmt::format(
            "at the joint (u, v) = ({:g}, {:g}) mm the nets have a gap of {:.3g} mm and the rods' "
            "tangents {:.3g} and {:.3g} degrees, expected a gap of at most {:g} mm",
            v.line_mm, u.line_mm, u.gap_mm, u.kink_deg, v.kink_deg, max_gap));
  }
  return seam;
}

Result<void> check_apart(const PositionedBlocks& positioned) {
  const double d = positioned.front().block.spacing;
  for (std::size_t a = 0; a < positioned.size(); ++a)
    for (std::size_t b = a + 1; b < positioned.size(); ++b) {
      const double reach =
          positioned[a].block.domain->reach() + positioned[a].shift.cwiseAbs().maxCoeff();
      const int last = static_cast<int>(std::ceil(reach / d)) + 1;
      for (const Family family : {Family::u, Family::v})
        for (int k = -last; k <= last; ++k) {
          const double line = line_of(positioned[a].block.placement, k, d);
          for (const Interval& one : positioned[a].intervals(family, line))
            for (const Interval& two : positioned[b].intervals(family, line))
              if (std::min(one.end, two.end) - std::max(one.begin, two.begin) > 1e-6 * d)
                return invalid(
                    "blocks \"{}\" and \"{}\" overlap in the footprint, on the {}-rod at {:g} mm",
                    positioned[a].block.name, positioned[b].block.name,
                    family == Family::u ? "u" : "v", line);
        }
    }
  return {};
}

/// Coordinate of a point across the cuts of `side`: u + v (east, west) or v - u (north, south).
double along_sides(Side side, const Eigen::Vector2d& uv) {
  return side == Side::east || side == Side::west ? uv.x() + uv.y() : uv.y() - uv.x();
}

}  // namespace

double outward(Side side) { return side == Side::east || side == Side::north ? 1 : -1; }

Result<NetPoint> Assemblage::PositionedBlock::at(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d own = uv - shift;
  auto point = block.net->at(own.x(), own.y());
  if (!point)
    return fail(point.error().fault, "block \"{}\": {}", block.name, point.error().message);
  point->position = block.pose * point->position + offset;
  point->tangent_u = block.pose.linear() * point->tangent_u;
  point->tangent_v = block.pose.linear() * point->tangent_v;
  return point;
}

double Assemblage::PositionedBlock::depth(Side side, const Eigen::Vector2d& uv) const {
  const auto& row = block.cut[std::size_t(side)];
  if (!row) return std::numeric_limits<double>::infinity();
  return outward(side) * (*row * block.spacing - along_sides(side, uv - shift));
}

bool Assemblage::PositionedBlock::within_cuts(const Eigen::Vector2d& uv) const {
  return std::ranges::all_of(all_sides,
                             [&](Side side) { return depth(side, uv) >= -same * block.spacing; });
}

bool Assemblage::PositionedBlock::within_boundary(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d own = uv - shift;
  const double margin = -same * block.spacing;
  return inside(block.domain->intervals(Family::u, own.y()), own.x(), margin) ||
         inside(block.domain->intervals(Family::v, own.x()), own.y(), margin);
}

std::vector<Interval> Assemblage::PositionedBlock::intervals(Family family, double c) const {
  const int along = family == Family::u ? 0 : 1;
  const double own = c - shift[1 - along];
  std::vector<Interval> pieces;
  for (Interval piece : block.domain->intervals(family, own)) {
    for (const Side side : all_sides) {
      const auto& row = block.cut[std::size_t(side)];
      if (!row) continue;
      // u + v grows along both families, v - u falls along u
      const bool sum = side == Side::east || side == Side::west;
      const double slope = sum || along == 1 ? 1 : -1;
      const double rest = sum || along == 0 ? own : -own;
      const double at = slope * (*row * block.spacing - rest);
      if (outward(side) * slope > 0)
        piece.end = std::min(piece.end, at);
      else
        piece.begin = std::max(piece.begin, at);
    }
    if (piece.begin < piece.end)
      pieces.push_back({piece.begin + shift[along], piece.end + shift[along]});
  }
  return pieces;
}

std::vector<Eigen::Vector2d> Assemblage::PositionedBlock::row(Side side) const {
  const auto& cut = block.cut[std::size_t(side)];
  if (!cut) return {};
  const double d = block.spacing, margin = 1e-6 * d;
  const bool sum = side == Side::east || side == Side::west;
  const int last = static_cast<int>(std::ceil(block.domain->reach() / d)) + 1;
  std::vector<Eigen::Vector2d> joints;
  for (int i = -last; i <= last; ++i) {
    const double u = line_of(block.placement, i, d);
    const double v = sum ? *cut * d - u : *cut * d + u;
    // a joint only if both its rods reach it
    if (inside(block.domain->intervals(Family::u, v), u, margin) &&
        inside(block.domain->intervals(Family::v, u), v, margin) &&
        within_cuts(Eigen::Vector2d(u, v) + shift))
      joints.push_back(Eigen::Vector2d(u, v) + shift);
  }
  return joints;
}

std::vector<Eigen::Matrix2Xd> Assemblage::PositionedBlock::outline(int points) const {
  const Eigen::Matrix2Xd ring = block.domain->boundary(points).colwise() + shift;
  const auto cut_away = [&](Eigen::Index k) {
    return std::ranges::any_of(all_sides, [&](Side side) { return depth(side, ring.col(k)) < 0; });
  };
  // once around, starting at a point that is cut away, if there is one
  Eigen::Index first = 0;
  while (first + 1 < ring.cols() && !cut_away(first)) ++first;
  Line around;
  for (Eigen::Index k = 0; k <= ring.cols(); ++k)
    around.emplace_back(ring.col((first + k) % ring.cols()));
  std::vector<Line> lines{around};
  for (const Side side : all_sides) {
    std::vector<Line> kept;
    for (const Line& line : lines)
      for (Line& part : clipped(line, *this, side)) kept.push_back(std::move(part));
    lines = std::move(kept);
  }
  std::vector<Eigen::Matrix2Xd> outlines;
  for (const Line& line : lines) {
    outlines.emplace_back(2, Eigen::Index(line.size()));
    for (std::size_t k = 0; k < line.size(); ++k) outlines.back().col(Eigen::Index(k)) = line[k];
  }
  return outlines;
}

double Seam::max_gap_mm() const { return std::ranges::max(rods, {}, &SeamRod::gap_mm).gap_mm; }

double Seam::max_kink_deg() const {
  return std::ranges::max(rods, {}, &SeamRod::kink_deg).kink_deg;
}

Result<Assemblage> Assemblage::make(std::vector<Block> blocks, const std::vector<Join>& joins,
                                    double max_gap) {
  if (blocks.empty()) return invalid("got no block, expected at least one");
  auto positioned = std::make_shared<PositionedBlocks>();
  for (Block& block : blocks) positioned->push_back({std::move(block)});
  TRY_DO(check_sides(*positioned, joins));
  TRY_DO(position_all(*positioned, joins));
  Assemblage whole;
  for (const Join& join : joins) {
    TRY(seam, seam_of(*positioned, join, max_gap));
    whole.seams_.push_back(std::move(*seam));
  }
  TRY_DO(check_apart(*positioned));
  whole.positioned_ = std::move(positioned);
  whole.joins_ = joins;
  return whole;
}

}  // namespace gridshell
