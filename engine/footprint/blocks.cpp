#include "engine/footprint/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/footprint/placed_block.h"

namespace gridshell {
namespace {

using Places = Assemblage::Places;
using Placed = Assemblage::Placed;

std::string name_of(const Places& places, const BlockSide& side) {
  return fmt::format("{}.{}", places[side.block].block.name, word_of(side.side));
}

std::string name_of(const Places& places, const Join& join) {
  return name_of(places, join.first) + " - " + name_of(places, join.second);
}

tl::unexpected<Error> refuse(const Places& places, const Join& join, const std::string& why) {
  return fail(Fault::bad_input, fmt::format("seam {}: {}", name_of(places, join), why));
}

bool face(Side a, Side b) {
  // east and west, north and south stand beside one another
  return a != b && int(a) / 2 == int(b) / 2;
}

Result<void> check_sides(const Places& places, const std::vector<Join>& joins) {
  std::vector<std::array<int, 4>> used(places.size(), {0, 0, 0, 0});
  for (const Join& join : joins) {
    if (!face(join.first.side, join.second.side))
      return refuse(places, join,
                    "the sides do not face one another; join east with west or north with south");
    for (const BlockSide& side : {join.first, join.second}) {
      if (!places[side.block].block.cut[std::size_t(side.side)])
        return refuse(places, join,
                      fmt::format("{} is not cut at a row of joints", name_of(places, side)));
      if (++used[side.block][std::size_t(side.side)] > 1)
        return refuse(places, join, fmt::format("{} is joined twice", name_of(places, side)));
    }
    const Block &a = places[join.first.block].block, &b = places[join.second.block].block;
    if (a.spacing != b.spacing)
      return refuse(places, join,
                    fmt::format("the distance between rods is d = {:g} mm and {:g} mm, it must be "
                                "the same",
                                a.spacing, b.spacing));
    if (a.placement != b.placement)
      return refuse(places, join,
                    "rods lie on the axes of one block and beside those of the other");
  }
  for (int k = 0; k < int(places.size()); ++k)
    for (const Side side : all_sides)
      if (places[k].block.cut[std::size_t(side)] && !used[k][std::size_t(side)])
        return fail(Fault::bad_input,
                    fmt::format("{} is cut and not joined: its rods would end in the air",
                                name_of(places, BlockSide{k, side})));
  return {};
}

/// Shift of the second block against the first that brings the joints of their rows together.
Result<Eigen::Vector2d> shift_of(const Places& places, const Join& join) {
  const auto a = places[join.first.block].row(join.first.side);
  const auto b = places[join.second.block].row(join.second.side);
  if (a.size() != b.size() || a.empty())
    return refuse(places, join,
                  fmt::format("{} rods cross {} and {} cross {}; the same number must, at least "
                              "2: change a radius, a crossing angle or a row",
                              2 * a.size(), name_of(places, join.first), 2 * b.size(),
                              name_of(places, join.second)));
  const Eigen::Vector2d shift = a.front() - b.front();
  for (std::size_t k = 0; k < a.size(); ++k)
    if ((a[k] - b[k] - shift).norm() > 1e-9 * places[join.first.block].block.spacing)
      return refuse(places, join,
                    fmt::format("its {} rods do not follow one another in the same order on both "
                                "sides",
                                2 * a.size()));
  return shift;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// Both nets at the joints of a seam between blocks that lie in place.
Result<std::vector<std::array<NetPoint, 2>>> pairs_at(const Places& places, const Join& join) {
  std::vector<std::array<NetPoint, 2>> pairs;
  for (const Eigen::Vector2d& joint : places[join.first.block].row(join.first.side)) {
    const auto a = places[join.first.block].at(joint), b = places[join.second.block].at(joint);
    if (!a) return tl::unexpected(a.error());
    if (!b) return tl::unexpected(b.error());
    pairs.push_back({*a, *b});
  }
  return pairs;
}

/// Puts `second` beside the first, or the other way round where `second` lies already.
Result<void> place_beside(Places& places, const Join& join, bool second) {
  const auto shift = shift_of(places, join);
  if (!shift) return tl::unexpected(shift.error());
  Placed& moved = places[second ? join.second.block : join.first.block];
  moved.shift += second ? *shift : Eigen::Vector2d(-*shift);
  const auto pairs = pairs_at(places, join);
  if (!pairs) return tl::unexpected(pairs.error());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& [a, b] : *pairs) middle += (a.position - b.position) / double(pairs->size());
  // level: all boundaries stay in one plane
  middle.z() = 0;
  moved.offset += second ? middle : Eigen::Vector3d(-middle);
  return {};
}

/// Places all blocks from the first on, along the joins.
Result<void> place_all(Places& places, const std::vector<Join>& joins) {
  std::vector<char> placed(places.size(), 0);
  placed.front() = 1;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Join& join : joins) {
      const int a = join.first.block, b = join.second.block;
      if (placed[a] == placed[b]) continue;
      if (auto done = place_beside(places, join, placed[a]); !done) return done;
      placed[a] = placed[b] = moved = true;
    }
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    if (!placed[k])
      return fail(Fault::bad_input, fmt::format("no join holds block \"{}\" to block \"{}\"",
                                                places[k].block.name, places.front().block.name));
  return {};
}

Result<Seam> seam_of(const Places& places, const Join& join, double max_gap) {
  // closes a loop only where nothing is left to shift
  const auto shift = shift_of(places, join);
  if (!shift) return tl::unexpected(shift.error());
  const double d = places.front().block.spacing;
  if (shift->norm() > 1e-9 * d)
    return refuse(
        places, join,
        fmt::format("the joins round the loop leave the sides ({:.4g}, {:.4g}) cells apart",
                    shift->x() / d, shift->y() / d));
  const auto pairs = pairs_at(places, join);
  if (!pairs) return tl::unexpected(pairs.error());
  const auto joints = places[join.first.block].row(join.first.side);
  Seam seam{join.first, join.second, name_of(places, join), {}};
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& [a, b] = (*pairs)[k];
    const double gap = (a.position - b.position).norm();
    seam.rods.push_back({Family::u, joints[k].y(), gap, angle_deg(a.tangent_u, b.tangent_u)});
    seam.rods.push_back({Family::v, joints[k].x(), gap, angle_deg(a.tangent_v, b.tangent_v)});
  }
  for (std::size_t k = 0; k + 1 < seam.rods.size(); k += 2) {
    const SeamRod &u = seam.rods[k], &v = seam.rods[k + 1];
    if (seam.max_gap_mm() <= max_gap || u.gap_mm < seam.max_gap_mm()) continue;
    return refuse(places, join,
                  fmt::format("at the joint (u, v) = ({:g}, {:g}) mm the nets are {:.3g} mm apart "
                              "and the rods' tangents {:.3g} and {:.3g} degrees, the gap must be "
                              "at most {:g} mm",
                              v.line_mm, u.line_mm, u.gap_mm, u.kink_deg, v.kink_deg, max_gap));
  }
  return seam;
}

Result<void> check_apart(const Places& places) {
  const double d = places.front().block.spacing;
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = a + 1; b < places.size(); ++b) {
      const double reach = places[a].block.domain->reach() + places[a].shift.cwiseAbs().maxCoeff();
      const int last = static_cast<int>(std::ceil(reach / d)) + 1;
      for (const Family family : {Family::u, Family::v})
        for (int k = -last; k <= last; ++k) {
          const double line = line_of(places[a].block.placement, k, d);
          for (const Interval& one : places[a].intervals(family, line))
            for (const Interval& two : places[b].intervals(family, line))
              if (std::min(one.end, two.end) - std::max(one.begin, two.begin) > 1e-6 * d)
                return fail(Fault::bad_input,
                            fmt::format("blocks \"{}\" and \"{}\" overlap in the footprint, on the "
                                        "{}-rod at {:g} mm",
                                        places[a].block.name, places[b].block.name,
                                        family == Family::u ? "u" : "v", line));
        }
    }
  return {};
}

}  // namespace

double Seam::max_gap_mm() const {
  double largest = 0;
  for (const SeamRod& rod : rods) largest = std::max(largest, rod.gap_mm);
  return largest;
}

double Seam::max_kink_deg() const {
  double largest = 0;
  for (const SeamRod& rod : rods) largest = std::max(largest, rod.kink_deg);
  return largest;
}

Result<Assemblage> Assemblage::make(std::vector<Block> blocks, const std::vector<Join>& joins,
                                    double max_gap) {
  if (blocks.empty()) return fail(Fault::bad_input, "there is no block to assemble");
  auto places = std::make_shared<Places>();
  for (Block& block : blocks) places->push_back({std::move(block)});
  if (auto good = check_sides(*places, joins); !good) return tl::unexpected(good.error());
  if (auto placed = place_all(*places, joins); !placed) return tl::unexpected(placed.error());
  Assemblage whole;
  for (const Join& join : joins) {
    auto seam = seam_of(*places, join, max_gap);
    if (!seam) return tl::unexpected(seam.error());
    whole.seams_.push_back(std::move(*seam));
  }
  if (auto apart = check_apart(*places); !apart) return tl::unexpected(apart.error());
  whole.places_ = std::move(places);
  whole.joins_ = joins;
  return whole;
}

}  // namespace gridshell
