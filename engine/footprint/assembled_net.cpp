// An assemblage as a Chebyshev net and as a domain: each is made of those of the blocks.

#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/footprint/assemblage.h"

namespace gridshell {
namespace {

using PositionedBlocks = Assemblage::PositionedBlocks;

/// The blocks that contain a point: one, or on a seam those that meet there.
std::vector<const Assemblage::PositionedBlock*> blocks_at(const PositionedBlocks& positioned,
                                                          const Eigen::Vector2d& uv) {
  std::vector<const Assemblage::PositionedBlock*> found, nearest;
  for (const auto& one : positioned)
    if (one.within_cuts(uv)) found.push_back(&one);
  if (found.size() < 2) return found;
  for (const auto* one : found)
    if (one->within_boundary(uv)) nearest.push_back(one);
  return nearest.empty() ? found : nearest;
}

class AssembledNet final : public ChebyshevNet {
 public:
  explicit AssembledNet(std::shared_ptr<const PositionedBlocks> positioned)
      : positioned_(std::move(positioned)) {}

  Result<NetPoint> at(double u, double v) const override {
    const Eigen::Vector2d uv(u, v);
    const auto found = blocks_at(*positioned_, uv);
    if (found.empty()) return invalid("no block contains (u, v) = ({:g}, {:g}) mm", u, v);
    NetPoint middle{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (const auto* one : found) {
      const auto point = one->at(uv);
      if (!point) return point;
      if (found.size() == 1) return point;
      const double fraction = 1.0 / double(found.size());
      middle.position += fraction * point->position;
      middle.tangent_u += point->tangent_u;
      middle.tangent_v += point->tangent_v;
      middle.K += fraction * point->K;
    }
    middle.tangent_u.normalize();
    middle.tangent_v.normalize();
    middle.omega = angle_between(middle.tangent_u, middle.tangent_v);
    return middle;
  }

 private:
  std::shared_ptr<const PositionedBlocks> positioned_;
};

/// Joins open polylines to a ring: after each the one whose first point is nearest to its end.
std::vector<Eigen::Vector2d> linked(std::vector<Eigen::Matrix2Xd> pieces) {
  std::vector<Eigen::Vector2d> ring;
  while (!pieces.empty()) {
    auto next = pieces.begin();
    if (!ring.empty())
      next = std::ranges::min_element(pieces, [&](const auto& a, const auto& b) {
        return (a.col(0) - ring.back()).norm() < (b.col(0) - ring.back()).norm();
      });
    for (Eigen::Index k = 0; k < next->cols(); ++k) ring.emplace_back(next->col(k));
    pieces.erase(next);
  }
  return ring;
}

/// Chooses `points` corners of a closed polyline, about evenly by length. Points between corners
/// are not used: they need not be on the boundary of a block.
Eigen::Matrix2Xd evenly(const std::vector<Eigen::Vector2d>& ring, int points) {
  std::vector<double> length{0};
  for (std::size_t k = 1; k <= ring.size(); ++k)
    length.push_back(length.back() + (ring[k % ring.size()] - ring[k - 1]).norm());
  Eigen::Matrix2Xd even(2, points);
  std::size_t k = 0;
  for (int n = 0; n < points; ++n) {
    const double at = length.back() * n / points;
    while (k + 1 < ring.size() && std::abs(length[k + 1] - at) <= std::abs(length[k] - at)) ++k;
    even.col(n) = ring[k];
  }
  return even;
}

class AssembledDomain final : public Domain {
 public:
  explicit AssembledDomain(std::shared_ptr<const PositionedBlocks> positioned)
      : positioned_(std::move(positioned)) {}

  std::vector<Interval> intervals(Family family, double c) const override {
    std::vector<Interval> pieces;
    for (const auto& one : *positioned_)
      for (const Interval& piece : one.intervals(family, c)) pieces.push_back(piece);
    std::ranges::sort(pieces,
                      [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    // a rod that ends on a seam continues in the next block
    std::vector<Interval> rods;
    const double near = 1e-9 * positioned_->front().block.spacing;
    for (const Interval& piece : pieces) {
      if (!rods.empty() && piece.begin <= rods.back().end + near)
        rods.back().end = std::max(rods.back().end, piece.end);
      else
        rods.push_back(piece);
    }
    return rods;
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    std::vector<Eigen::Matrix2Xd> pieces;
    for (const auto& one : *positioned_)
      for (auto& piece : one.outline(4 * points)) pieces.push_back(std::move(piece));
    return evenly(linked(std::move(pieces)), points);
  }

  double reach() const override {
    double reach = 0;
    for (const auto& one : *positioned_)
      reach = std::max(reach, one.block.domain->reach() + one.shift.cwiseAbs().maxCoeff());
    return reach;
  }

 private:
  std::shared_ptr<const PositionedBlocks> positioned_;
};

}  // namespace

std::shared_ptr<const ChebyshevNet> Assemblage::net() const {
  return std::make_shared<AssembledNet>(positioned_);
}

std::unique_ptr<Domain> Assemblage::domain() const {
  return std::make_unique<AssembledDomain>(positioned_);
}

Result<Eigen::Matrix3Xd> Assemblage::closed(const Eigen::Matrix2Xd& uv, double fade) const {
  auto points = points_on(AssembledNet(positioned_), uv);
  if (!points) return points;
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    const auto found = blocks_at(*positioned_, uv.col(k));
    if (found.size() != 1) continue;
    for (const Join& join : joins_) {
      const bool first = found.front() == &(*positioned_)[join.first.block];
      if (!first && found.front() != &(*positioned_)[join.second.block]) continue;
      const BlockSide own = first ? join.first : join.second;
      const PositionedBlock& other = (*positioned_)[first ? join.second.block : join.first.block];
      // both nets are evaluated at the nearest point of the seam
      const double t = found.front()->depth(own.side, uv.col(k)) / fade;
      const bool sum = own.side == Side::east || own.side == Side::west;
      const Eigen::Vector2d across = 0.5 * Eigen::Vector2d(sum ? 1 : -1, 1) * outward(own.side);
      const Eigen::Vector2d on_seam = uv.col(k) + t * fade * across;
      const auto a = found.front()->at(on_seam), b = other.at(on_seam);
      // past the end of a seam one of the nets may fold: there is no gap to close
      if (!(t < 1) || !a || !b) continue;
      points->col(k) += 0.5 * (1 - t) * (1 - t) * (1 + 2 * t) * (b->position - a->position);
    }
  }
  return points;
}

int Assemblage::blocks() const { return static_cast<int>(positioned_->size()); }

const Block& Assemblage::block(int index) const { return (*positioned_)[index].block; }

Result<std::vector<BlockRod>> Assemblage::rods(int index, double step) const {
  const PositionedBlock& one = (*positioned_)[index];
  const Block& block = one.block;
  std::vector<BlockRod> rods;
  const int last =
      static_cast<int>(std::ceil(AssembledDomain(positioned_).reach() / block.spacing)) + 1;
  for (const Family family : {Family::u, Family::v}) {
    for (int k = -last; k <= last; ++k) {
      const double line = line_of(block.placement, k, block.spacing);
      for (const Interval& piece : one.intervals(family, line)) {
        const int steps =
            std::max(1, static_cast<int>(std::ceil((piece.end - piece.begin) / step)));
        BlockRod rod{Eigen::Matrix3Xd(3, steps + 1), Eigen::Matrix2Xd(2, steps + 1)};
        for (int n = 0; n <= steps; ++n) {
          const double along = piece.begin + (piece.end - piece.begin) * n / steps;
          rod.flat.col(n) =
              family == Family::u ? Eigen::Vector2d(along, line) : Eigen::Vector2d(line, along);
          TRY(point, one.at(rod.flat.col(n)));
          rod.net.col(n) = point->position;
        }
        rods.push_back(std::move(rod));
      }
    }
  }
  return rods;
}

}  // namespace gridshell
