#include "engine/measure/rod_mode.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace gridshell {
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
