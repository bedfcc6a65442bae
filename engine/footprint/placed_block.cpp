#include "engine/footprint/placed_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell {
namespace {

// how near two places are the same, over d
constexpr double same = 1e-9;

bool inside(const std::vector<Interval>& pieces, double at, double margin) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const Interval& piece) {
    return at > piece.begin + margin && at < piece.end - margin;
  });
}

using Line = std::vector<Eigen::Vector2d>;

/// The parts of a polyline inside a cut; they end before it, where two blocks share a point.
std::vector<Line> clipped(const Line& line, const Assemblage::Placed& block, Side side) {
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

}  // namespace

double along_sides(Side side, const Eigen::Vector2d& uv) {
  return side == Side::east || side == Side::west ? uv.x() + uv.y() : uv.y() - uv.x();
}

double outward(Side side) { return side == Side::east || side == Side::north ? 1 : -1; }

Result<NetPoint> Assemblage::Placed::at(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d own = uv - shift;
  auto point = block.net->at(own.x(), own.y());
  if (!point)
    return fail(point.error().fault,
                fmt::format("block \"{}\": {}", block.name, point.error().message));
  point->position = block.pose * point->position + offset;
  point->tangent_u = block.pose.linear() * point->tangent_u;
  point->tangent_v = block.pose.linear() * point->tangent_v;
  return point;
}

double Assemblage::Placed::depth(Side side, const Eigen::Vector2d& uv) const {
  const auto& row = block.cut[std::size_t(side)];
  if (!row) return std::numeric_limits<double>::infinity();
  return outward(side) * (*row * block.spacing - along_sides(side, uv - shift));
}

bool Assemblage::Placed::within_cuts(const Eigen::Vector2d& uv) const {
  return std::all_of(all_sides.begin(), all_sides.end(),
                     [&](Side side) { return depth(side, uv) >= -same * block.spacing; });
}

bool Assemblage::Placed::within_boundary(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d own = uv - shift;
  const double margin = -same * block.spacing;
  return inside(block.domain->intervals(Family::u, own.y()), own.x(), margin) ||
         inside(block.domain->intervals(Family::v, own.x()), own.y(), margin);
}

std::vector<Interval> Assemblage::Placed::intervals(Family family, double c) const {
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

std::vector<Eigen::Vector2d> Assemblage::Placed::row(Side side) const {
  const auto& cut = block.cut[std::size_t(side)];
  if (!cut) return {};
  const double d = block.spacing, margin = 1e-6 * d;
  const bool sum = side == Side::east || side == Side::west;
  const int last = static_cast<int>(std::ceil(block.domain->reach() / d)) + 1;
  std::vector<Eigen::Vector2d> joints;
  for (int i = -last; i <= last; ++i) {
    const double u = line_of(block.placement, i, d);
    const double v = sum ? *cut * d - u : *cut * d + u;
    // both rods of the joint reach it
    if (inside(block.domain->intervals(Family::u, v), u, margin) &&
        inside(block.domain->intervals(Family::v, u), v, margin) &&
        within_cuts(Eigen::Vector2d(u, v) + shift))
      joints.push_back(Eigen::Vector2d(u, v) + shift);
  }
  return joints;
}

std::vector<Eigen::Matrix2Xd> Assemblage::Placed::outline(int points) const {
  const Eigen::Matrix2Xd ring = block.domain->boundary(points).colwise() + shift;
  const auto cut_away = [&](Eigen::Index k) {
    return std::any_of(all_sides.begin(), all_sides.end(),
                       [&](Side side) { return depth(side, ring.col(k)) < 0; });
  };
  // once around, from a point that is cut away where there is one
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

}  // namespace gridshell
