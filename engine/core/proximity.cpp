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
  // where the lines are nearest, or of parallel ones the begin
  const double across = dd * ee - de * de;
  near.s = across > 1e-14 * dd * ee ? within(de * er - dr * ee, across) : 0;
  near.t = within(de * near.s + er, ee);
  near.s = within(de * near.t - dr, dd);
  near.distance2 = (r + near.s * d - near.t * e).squaredNorm();
  return near;
}

bool are_near(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double mm) {
  return ((a.min() - b.max()).array() <= mm).all() && ((b.min() - a.max()).array() <= mm).all();
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
    const double place = std::floor(p[k] / size_);
    // far away all is one cell
    cell[std::size_t(k)] =
        std::abs(place) < 1e15 ? std::int64_t(place) : std::int64_t(place > 0 ? 1e15 : -1e15);
  }
  return cell;
}

}  // namespace gridshell
