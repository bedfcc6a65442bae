#include "engine/record/shape_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell {

NetDeviation::NetDeviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho)
    : of_joints_((joints - net).colwise().norm().transpose() / rho), sorted_(of_joints_) {
  // a NaN goes last, so that the largest shows it
  std::sort(sorted_.begin(), sorted_.end(),
            [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
}

double NetDeviation::largest() const { return quantile(1); }

double NetDeviation::mean() const {
  return of_joints_.size() ? of_joints_.mean() : std::numeric_limits<double>::quiet_NaN();
}

double NetDeviation::quantile(double q) const {
  if (sorted_.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted_.size() - 1);
  const auto below = static_cast<Eigen::Index>(at);
  const auto above = std::min(below + 1, sorted_.size() - 1);
  const double part = at - static_cast<double>(below);
  // no product with a NaN that does not count
  return part == 0 ? sorted_[below] : (1 - part) * sorted_[below] + part * sorted_[above];
}

PushReach push_reach(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (depth == 0 || before.cols() == 0) return {none, none, none};
  const Eigen::ArrayXd moved =
      (now - before).colwise().norm().transpose().array() / std::abs(depth);
  PushReach reach{double((moved > 0.1).count()) / double(moved.size()),
                  double((moved > 0.5).count()) / double(moved.size()), none};
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    if (!(moved[k] > 0.1)) continue;
    const double latitude = std::asin(before(2, k) / before.col(k).norm()) * 180 / M_PI;
    if (!(reach.lowest_latitude_deg <= latitude)) reach.lowest_latitude_deg = latitude;
  }
  return reach;
}

namespace {

constexpr double counts = 0.05;  // of a rod's largest curvature

/// Curvature vectors at the inner nodes of a rod: the change of the unit tangent over the length.
Eigen::Matrix3Xd curvatures(const std::vector<int>& rod, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd found(3, std::max<Eigen::Index>(0, Eigen::Index(rod.size()) - 2));
  for (Eigen::Index k = 0; k < found.cols(); ++k) {
    const Eigen::Vector3d before = x.col(rod[std::size_t(k) + 1]) - x.col(rod[std::size_t(k)]);
    const Eigen::Vector3d after = x.col(rod[std::size_t(k) + 2]) - x.col(rod[std::size_t(k) + 1]);
    found.col(k) =
        (after.normalized() - before.normalized()) / (0.5 * (before.norm() + after.norm()));
  }
  return found;
}

int inflections_of(const Eigen::Matrix3Xd& curvature) {
  if (curvature.cols() == 0) return 0;
  const double least = counts * curvature.colwise().norm().maxCoeff();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  int found = 0;
  for (const auto& now : curvature.colwise()) {
    if (now.norm() <= least) continue;
    found += last.dot(now) < 0;
    last = now;
  }
  return found;
}

}  // namespace

std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x) {
  std::vector<int> all;
  for (const std::vector<int>& rod : mesh.rods) all.push_back(inflections_of(curvatures(rod, x)));
  return all;
}

}  // namespace gridshell
