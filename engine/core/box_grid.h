// Things in space, found by where they are.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace gridshell {

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
  bool add(int thing, const Eigen::AlignedBox3d& box, std::size_t most) {
    const Cell low = cell_of(box.min()), high = cell_of(box.max());
    double count = double(entries_);
    double here = 1;
    for (std::size_t k = 0; k < 3; ++k) here *= double(high[k] - low[k] + 1);
    count += here;
    if (!(count <= double(most))) return false;
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t k = low[2]; k <= high[2]; ++k) cells_[{i, j, k}].push_back(thing);
    entries_ = std::size_t(count);
    return true;
  }

  /// What may be at a point; nothing: nothing is.
  const std::vector<int>* at(const Eigen::Vector3d& p) const {
    const auto found = cells_.find(cell_of(p));
    return found == cells_.end() ? nullptr : &found->second;
  }
  const Cells& cells() const { return cells_; }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) {
      const double place = std::floor(p[k] / size_);
      // far away all is one cell
      cell[std::size_t(k)] =
          std::abs(place) < 1e15 ? std::int64_t(place) : std::int64_t(place > 0 ? 1e15 : -1e15);
    }
    return cell;
  }

  double size_;
  Cells cells_;
  std::size_t entries_ = 0;
};

}  // namespace gridshell
