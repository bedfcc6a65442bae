// A grid of cubes in which points of space are found.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "engine/core/proximity.h"

namespace gridshell {

/// Cubes of one size, each with the numbers of the points in it.
class PointGrid {
 public:
  explicit PointGrid(double size_mm) : size_(size_mm) {}

  void add(int thing, const Eigen::Vector3d& p) { cells_[cell_of(p)].push_back(thing); }

  /// Whether `applies` is true for a point in the 27 cubes around p. These contain all points that
  /// are nearer to p than the cubes' size, and some others.
  template <class Predicate>
  bool any_near(const Eigen::Vector3d& p, const Predicate& applies) const {
    const BoxGrid::Cell middle = cell_of(p);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
      if (found != cells_.end() && std::ranges::any_of(found->second, applies)) return true;
    }
    return false;
  }

 private:
  BoxGrid::Cell cell_of(const Eigen::Vector3d& p) const {
    BoxGrid::Cell cell;
    for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = std::int64_t(std::floor(p[k] / size_));
    return cell;
  }

  double size_;
  BoxGrid::Cells cells_;
};

}  // namespace gridshell
