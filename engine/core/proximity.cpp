#include "engine/core/proximity.h"

namespace gridshell {

NearestPoints nearest_points(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                             const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = q - p, e = b - a, r = p - a;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const double dr = d.dot(r), er = e.dot(r);
  const auto within = [](double above, double below) {
    return below > 0 ? std::clamp(above / below, 0.0, 1.0) : 0.0;
  };
  NearestPoints near;
  // the nearest point of the lines; for parallel lines the start
  const double across = dd * ee - de * de;
  near.s = across > 1e-14 * dd * ee ? within(de * er - dr * ee, across) : 0;
  near.t = within(de * near.s + er, ee);
  near.s = within(de * near.t - dr, dd);
  near.distance2 = (r + near.s * d - near.t * e).squaredNorm();
  return near;
}

BoxPlane::BoxPlane(const std::vector<Eigen::AlignedBox3d>& boxes, double mm) {
  const auto count = boxes.size();
  Eigen::AlignedBox3d all;
  Eigen::Vector3d mean{0, 0, 0}, largest{0, 0, 0};
  for (const Eigen::AlignedBox3d& each : boxes) {
    all.extend(each);
    mean += each.sizes() / double(count);
    largest = largest.cwiseMax(each.sizes());
  }
  // the plane perpendicular to the shortest side of the box around all
  Eigen::Index across = 0;
  if (count > 0) all.sizes().minCoeff(&across);
  const Eigen::Index axes[2] = {(across + 1) % 3, (across + 2) % 3};
  double size[2];
  int* const cells[2] = {&columns, &rows};
  const double most = std::sqrt(double(count)) + 1;
  for (int k = 0; k < 2 && count > 0; ++k) {
    const double whole = all.sizes()[axes[k]];
    size[k] = std::max(std::min(largest[axes[k]], 4 * mean[axes[k]]) + mm, whole / most);
    // all boxes are in one cell if the extent is zero
    *cells[k] = size[k] > 0 ? int(std::min(most, whole / size[k])) + 1 : 1;
  }
  const auto cell_of = [&](const Eigen::AlignedBox3d& each) {
    int at[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
      if (!(each.sizes()[axes[k]] + mm <= size[k])) return -1;
      const double offset = each.min()[axes[k]] - all.min()[axes[k]];
      if (size[k] > 0) at[k] = int(std::min(*cells[k] - 1.0, offset / size[k]));
    }
    return at[1] * columns + at[0];
  };
  std::vector<int> cell(count);
  first.assign(std::size_t(columns * rows) + 1, 0);
  for (std::size_t k = 0; k < count; ++k) {
    cell[k] = cell_of(boxes[k]);
    if (cell[k] < 0)
      wide.push_back(int(k));
    else
      ++first[std::size_t(cell[k]) + 1];
  }
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  std::vector<int> next(first.begin(), first.end() - 1);
  number.resize(count - wide.size());
  box.resize(number.size());
  for (std::size_t k = 0; k < count; ++k) {
    if (cell[k] < 0) continue;
    const auto index = std::size_t(next[std::size_t(cell[k])]++);
    number[index] = int(k);
    box[index] = boxes[k];
  }
}

bool BoxGrid::add(int thing, const Eigen::AlignedBox3d& box, std::size_t most) {
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

const std::vector<int>* BoxGrid::at(const Eigen::Vector3d& p) const {
  const auto found = cells_.find(cell_of(p));
  return found == cells_.end() ? nullptr : &found->second;
}

BoxGrid::Cell BoxGrid::cell_of(const Eigen::Vector3d& p) const {
  Cell cell;
  for (int k = 0; k < 3; ++k) {
    const double coordinate = std::floor(p[k] / size_);
    // all points far away are in one cell
    cell[std::size_t(k)] = std::abs(coordinate) < 1e15
                               ? std::int64_t(coordinate)
                               : std::int64_t(coordinate > 0 ? 1e15 : -1e15);
  }
  return cell;
}

}  // namespace gridshell
