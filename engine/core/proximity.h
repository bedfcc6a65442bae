// Search for near objects in space: segments, boxes, and a grid of cubes.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace gridshell {

/// The nearest points of the segments p + s (q - p) and a + t (b - a), s and t in [0, 1], and the
/// square of their distance [Ericson 2004, 5.1.9]. For parallel segments, one of the nearest pairs.
struct NearestPoints {
  double s = 0, t = 0, distance2 = 0;
};

NearestPoints nearest_points(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                             const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The point of the segment from a to b that is nearest to p, as a fraction of its length.
inline double nearest_fraction(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
}

/// The distance of p from the segment from a to b.
inline double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b) {
  return (a + nearest_fraction(p, a, b) * (b - a) - p).norm();
}

/// Whether two boxes are within mm of each other.
inline bool are_near(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double mm) {
  return ((a.min() - b.max()).array() <= mm).all() && ((b.min() - a.max()).array() <= mm).all();
}

/// Boxes sorted into the cells of a plane, by their lowest corners. Cells are so wide that boxes
/// within mm of each other are in the same or in neighbouring cells, except those of `wide`.
struct BoxPlane {
  BoxPlane(const std::vector<Eigen::AlignedBox3d>& boxes, double mm);

  int columns = 1, rows = 1;
  std::vector<int> first;   ///< index of a cell's first box, row after row, and the end
  std::vector<int> number;  ///< number of the box at an index
  std::vector<Eigen::AlignedBox3d> box;
  std::vector<int> wide;  ///< numbers of the boxes that are too wide for a cell
};

/// Calls visit(i, j), i < j, once for every two boxes that are within mm of each other.
template <class Visit>
void each_near_pair(const std::vector<Eigen::AlignedBox3d>& boxes, double mm, const Visit& visit) {
  const BoxPlane plane(boxes, mm);
  const auto look = [&](int k, int from, int to) {
    for (int other = from; other < to; ++other)
      if (are_near(plane.box[std::size_t(k)], plane.box[std::size_t(other)], mm))
        visit(std::min(plane.number[std::size_t(k)], plane.number[std::size_t(other)]),
              std::max(plane.number[std::size_t(k)], plane.number[std::size_t(other)]));
  };
  for (int row = 0; row < plane.rows; ++row)
    for (int column = 0; column < plane.columns; ++column) {
      const int cell = row * plane.columns + column;
      const auto begin = [&](int c) { return plane.first[std::size_t(c)]; };
      // the remaining boxes of this cell, the next cell, and the three in the next row
      const int next_end = cell + (column + 1 < plane.columns ? 2 : 1);
      const int above = cell + plane.columns;
      for (int k = begin(cell); k < begin(cell + 1); ++k) {
        look(k, k + 1, begin(next_end));
        if (row + 1 < plane.rows)
          look(k, begin(column > 0 ? above - 1 : above),
               begin(column + 1 < plane.columns ? above + 2 : above + 1));
      }
    }
  for (std::size_t k = 0; k < plane.wide.size(); ++k) {
    const int a = plane.wide[k];
    const Eigen::AlignedBox3d& box = boxes[std::size_t(a)];
    for (const int b : plane.number)
      if (are_near(box, boxes[std::size_t(b)], mm)) visit(std::min(a, b), std::max(a, b));
    for (std::size_t l = k + 1; l < plane.wide.size(); ++l)
      if (are_near(box, boxes[std::size_t(plane.wide[l])], mm)) visit(a, plane.wide[l]);
  }
}

/// Cubes of one size, each with the numbers of the boxes that overlap it.
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

  /// Adds a box with the number `thing`. Returns false, without adding it, if the grid would have
  /// more than `most` entries.
  bool add(int thing, const Eigen::AlignedBox3d& box, std::size_t most);

  /// Numbers of the boxes that may contain a point; null: none.
  const std::vector<int>* at(const Eigen::Vector3d& p) const;
  const Cells& cells() const { return cells_; }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const;

  double size_;
  Cells cells_;
  std::size_t entries_ = 0;
};

}  // namespace gridshell
