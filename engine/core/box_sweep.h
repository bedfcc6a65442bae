// Boxes that are near each other, by a sweep along the axis on which they lie farthest apart.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace gridshell {

/// Around what it took: nothing at first.
struct Box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};

  void take(const Eigen::Vector3d& p) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  void take(const Box& box) {
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], box.low[k]), high[k] = std::max(high[k], box.high[k]);
  }
  bool near(const Box& other, double mm) const {
    for (int k = 0; k < 3; ++k)
      if (low[k] - other.high[k] > mm || other.low[k] - high[k] > mm) return false;
    return true;
  }
};

/// visit(i, j), i < j, once for every two boxes that are within mm of each other.
template <class Visit>
void each_near_pair(const std::vector<Box>& boxes, double mm, const Visit& visit) {
  Box all;
  for (const Box& box : boxes) all.take(box);
  int along = 0;  // where they lie farthest apart
  for (int k = 1; k < 3; ++k)
    if (all.high[k] - all.low[k] > all.high[along] - all.low[along]) along = k;
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < boxes.size(); ++k) order.emplace_back(boxes[k].low[along], int(k));
  std::ranges::sort(order);
  std::vector<Box> sorted;
  for (const auto& [low, k] : order) sorted.push_back(boxes[std::size_t(k)]);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double end = sorted[i].high[along] + mm;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].low[along] <= end; ++j)
      if (sorted[i].near(sorted[j], mm))
        visit(std::min(order[i].second, order[j].second),
              std::max(order[i].second, order[j].second));
  }
}

}  // namespace gridshell
