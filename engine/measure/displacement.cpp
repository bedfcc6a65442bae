#include "engine/measure/displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell {

Reach reach_of(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (depth == 0 || before.cols() == 0) return {none, none, none};
  const Eigen::ArrayXd moved =
      (now - before).colwise().norm().transpose().array() / std::abs(depth);
  Reach reach{double((moved > 0.1).count()) / double(moved.size()),
              double((moved > 0.5).count()) / double(moved.size()), none};
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    if (!(moved[k] > 0.1)) continue;
    const double latitude = std::asin(before(2, k) / before.col(k).norm()) * 180 / M_PI;
    if (!(reach.lowest_latitude_deg <= latitude)) reach.lowest_latitude_deg = latitude;
  }
  return reach;
}

}  // namespace gridshell
