#include "engine/design/symmetry.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <optional>

#include "engine/footprint/mesh_symmetry.h"

namespace gridshell {
namespace {

/// (u, v) of all joints, then of all ends.
Eigen::Matrix2Xd places_of(const Footprint& footprint) {
  const Eigen::Index joints = Eigen::Index(footprint.joints.size());
  Eigen::Matrix2Xd places(2, joints + 2 * Eigen::Index(footprint.rods.size()));
  for (Eigen::Index k = 0; k < joints; ++k) {
    const FootprintJoint& joint = footprint.joints[std::size_t(k)];
    places.col(k) << joint.u, joint.v;
  }
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    for (int side = 0; side < 2; ++side) {
      places.col(joints + 2 * Eigen::Index(r) + side) =
          rod.at(side == 0 ? rod.span.begin : rod.span.end);
    }
  }
  return places;
}

/// Which place each goes to; joints to joints, ends to ends.
std::optional<std::vector<int>> permutation_of(const Eigen::Matrix2Xd& places, Eigen::Index joints,
                                               const Eigen::Matrix2d& map, double near_mm) {
  auto to = images_of(places.leftCols(joints), map, near_mm);
  const auto ends = images_of(places.rightCols(places.cols() - joints), map, near_mm);
  if (!to || !ends) return std::nullopt;
  for (const int end : *ends) to->push_back(int(joints) + end);
  return to;
}

/// The rotation or reflection that takes points to others best [Kabsch 1976], if it takes them
/// there.
std::optional<Eigen::Matrix3d> motion_between(const Eigen::Matrix3Xd& from,
                                              const Eigen::Matrix3Xd& to, double near_mm) {
  const Eigen::Vector3d a = from.rowwise().mean(), b = to.rowwise().mean();
  const Eigen::Matrix3Xd x = from.colwise() - a, y = to.colwise() - b;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(y * x.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if ((turn * x - y).colwise().norm().maxCoeff() > near_mm) return std::nullopt;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if ((turn * up - up).norm() > 1e-3) return std::nullopt;
  return turn;
}

}  // namespace

std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm) {
  const Eigen::Matrix2Xd places = places_of(scene.footprint);
  Eigen::Matrix3Xd points(3, places.cols());
  points << joints, scene.motion.end;
  std::vector<ShellSymmetry> found;
  for (const Eigen::Matrix3d& map : square_symmetries()) {
    if (map(2, 2) < 0) continue;  // it turns the shell over
    const auto to = permutation_of(places, joints.cols(), map.topLeftCorner<2, 2>(), near_mm);
    if (!to) continue;
    Eigen::Matrix3Xd there(3, points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      there.col(k) = points.col((*to)[std::size_t(k)]);
    const auto turn = motion_between(points, there, near_mm);
    if (!turn) continue;
    ShellSymmetry one{{}, *turn};
    for (Eigen::Index k = joints.cols(); k < points.cols(); ++k)
      one.to.push_back((*to)[std::size_t(k)] - int(joints.cols()));
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace gridshell
