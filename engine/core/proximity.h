// What is near what in space: segments, boxes, and things found by where they are.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gridshell {

/// The nearest points of the segments p + s (q - p) and a + t (b - a), s and t in [0, 1], and the
/// square of their distance [Ericson 2004, 5.1.9]. Of parallel ones, one of the nearest pairs.
struct NearestPoints {
  double s = 0, t = 0, distance2 = 0;
};

NearestPoints nearest_points(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                             const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Boxes that are near each other, by a sweep along the axis on which they lie farthest apart.

/// Whether two boxes are within mm of each other.
bool are_near(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double mm);

/// visit(i, j), i < j, once for every two boxes that are within mm of each other.
template <class Visit>
void each_near_pair(const std::vector<Eigen::AlignedBox3d>& boxes, double mm, const Visit& visit) {
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
  Eigen::Index along = 0;
  all.sizes().maxCoeff(&along);
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < boxes.size(); ++k) order.emplace_back(boxes[k].min()[along], int(k));
  std::ranges::sort(order);
  std::vector<Eigen::AlignedBox3d> sorted;
  for (const auto& [low, k] : order) sorted.push_back(boxes[std::size_t(k)]);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double end = sorted[i].max()[along] + mm;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].min()[along] <= end; ++j)
      if (are_near(sorted[i], sorted[j], mm))
        visit(std::min(order[i].second, order[j].second),
              std::max(order[i].second, order[j].second));
  }
}

/// Cubes of one size, each with the numbers of the things whose boxes reach into it.
class BoxGrid {
 public:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t sum = 0;
      for (const std::int64_t k : cell) sum = (sum ^ std::uint64_t(k)) * 0x9E3779B97F4A7C15u;
      return std::size_t(sum ^ (sum >> 32));
    }
  };
  using Cells = std::unordered_map<Cell, std::vector<int>, Hash>;

  explicit BoxGrid(double size_mm) : size_(size_mm) {}

  /// False where it would take more than `most` entries in all; the thing is then not in it.
  bool add(int thing, const Eigen::AlignedBox3d& box, std::size_t most);

  /// What may be at a point; nothing: nothing is.
  const std::vector<int>* at(const Eigen::Vector3d& p) const;
  const Cells& cells() const { return cells_; }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const;

  double size_;
  Cells cells_;
  std::size_t entries_ = 0;
};

}  // namespace gridshell
