#include "engine/measure/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell {

Deviation::Deviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho)
    : of_joints_((joints - net).colwise().norm().transpose() / rho), sorted_(of_joints_) {
  // a NaN goes last, so that the largest shows it
  std::sort(sorted_.begin(), sorted_.end(),
            [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
}

double Deviation::largest() const { return quantile(1); }

double Deviation::mean() const {
  return of_joints_.size() ? of_joints_.mean() : std::numeric_limits<double>::quiet_NaN();
}

double Deviation::quantile(double q) const {
  if (sorted_.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted_.size() - 1);
  const auto below = static_cast<Eigen::Index>(at);
  const auto above = std::min(below + 1, sorted_.size() - 1);
  const double part = at - static_cast<double>(below);
  // no product with a NaN that does not count
  return part == 0 ? sorted_[below] : (1 - part) * sorted_[below] + part * sorted_[above];
}

}  // namespace gridshell
