#include "engine/record/gauss_curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Of a rod that is neither: u of its joint if it is the first there, else v, turned to u's left.
void put_other(const Eigen::Vector3d& along, const Eigen::Vector2d& flat, int joint,
               Eigen::Vector2d& first, JointTangents& tangents) {
  if (tangents.u.col(joint).isZero(0)) {
    tangents.u.col(joint) = along;
    first = flat;
    return;
  }
  const double left = first.x() * flat.y() - first.y() * flat.x();
  if (tangents.v.col(joint).isZero(0) && std::abs(left) > 1e-6 * first.norm() * flat.norm())
    tangents.v.col(joint) = left > 0 ? along : Eigen::Vector3d(-along);
}

}  // namespace

Eigen::Vector3d JointTangents::normal(Eigen::Index joint) const {
  return u.col(joint).cross(v.col(joint)).normalized();
}

JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x) {
  JointTangents tangents{Eigen::Matrix3Xd::Zero(3, mesh.joints),
                         Eigen::Matrix3Xd::Zero(3, mesh.joints)};
  std::vector<Eigen::Vector2d> first;  // of joints of a network: its first rod's way in the flat
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    const Family family = footprint.rods[r].family;
    for (std::size_t k = 1; k + 1 < node.size(); ++k) {
      const int joint = mesh.joint_of(node[k]);
      if (joint < 0) continue;
      const Eigen::Vector3d before = x.col(node[k]) - x.col(node[k - 1]);
      const Eigen::Vector3d after = x.col(node[k + 1]) - x.col(node[k]);
      const double l1 = before.norm(), l2 = after.norm();
      const Eigen::Vector3d along = (before * (l2 / l1) + after * (l1 / l2)).normalized();
      if (family != Family::other) {
        (family == Family::u ? tangents.u : tangents.v).col(joint) = along;
        continue;
      }
      first.resize(std::size_t(mesh.joints));
      put_other(along, mesh.flat.col(node[k + 1]) - mesh.flat.col(node[k - 1]), joint,
                first[std::size_t(joint)], tangents);
    }
  }
  return tangents;
}

Eigen::VectorXd cell_curvature(const Footprint& footprint, const JointTangents& tangents) {
  Eigen::VectorXd K(Eigen::Index(footprint.cells.size()));
  for (std::size_t k = 0; k < footprint.cells.size(); ++k) {
    const auto& joint = footprint.cells[k].joints;
    // interior angles: at the four corners the cell lies towards (+u,+v), (-u,+v), (-u,-v), (+u,-v)
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const double side_u = corner == 0 || corner == 3 ? 1 : -1;
      const double side_v = corner < 2 ? 1 : -1;
      sum += angle_between(side_u * tangents.u.col(joint[corner]),
                           side_v * tangents.v.col(joint[corner]));
    }
    K[Eigen::Index(k)] = 2 * M_PI - sum;
  }
  return K;
}

CurvatureBins curvature_bins(const Eigen::VectorXd& x_over_L, const Eigen::VectorXd& K, int bins) {
  const double width = 2.0 / bins;
  CurvatureBins found;
  found.low = Eigen::VectorXd::LinSpaced(bins, -1, 1 - width);
  found.high = found.low.array() + width;
  found.cells = Eigen::VectorXi::Zero(bins);
  found.mean = found.deviation = Eigen::VectorXd::Zero(bins);
  const auto bin_of = [&](Eigen::Index cell) {
    return std::clamp(int(std::floor((x_over_L[cell] + 1) / width)), 0, bins - 1);
  };
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    ++found.cells[bin_of(cell)];
    found.mean[bin_of(cell)] += K[cell];
  }
  found.mean.array() /= found.cells.cast<double>().array();
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    const int bin = bin_of(cell);
    found.deviation[bin] += (K[cell] - found.mean[bin]) * (K[cell] - found.mean[bin]);
  }
  found.deviation = (found.deviation.array() / found.cells.cast<double>().array()).sqrt();
  return found;
}

}  // namespace gridshell
