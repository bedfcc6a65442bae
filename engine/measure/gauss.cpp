#include "engine/measure/gauss.h"

#include <Eigen/Geometry>
#include <cmath>

namespace gridshell {
namespace {

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x) {
  JointTangents tangents{Eigen::Matrix3Xd::Zero(3, mesh.joints),
                         Eigen::Matrix3Xd::Zero(3, mesh.joints)};
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    Eigen::Matrix3Xd& side = footprint.rods[r].family == Family::u ? tangents.u : tangents.v;
    for (std::size_t k = 1; k + 1 < node.size(); ++k) {
      if (node[k] >= mesh.joints) continue;
      const Eigen::Vector3d before = x.col(node[k]) - x.col(node[k - 1]);
      const Eigen::Vector3d after = x.col(node[k + 1]) - x.col(node[k]);
      const double l1 = before.norm(), l2 = after.norm();
      side.col(node[k]) = (before * (l2 / l1) + after * (l1 / l2)).normalized();
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

double total_curvature_from_corners(const Footprint& footprint, const JointTangents& tangents) {
  // which of the four quadrants around a joint hold a cell, counter-clockwise from (+u, +v)
  std::vector<std::array<bool, 4>> holds(footprint.joints.size(), {false, false, false, false});
  for (const FootprintCell& cell : footprint.cells)
    for (int corner = 0; corner < 4; ++corner) holds[cell.joints[corner]][corner] = true;

  double total = 0;
  for (std::size_t j = 0; j < holds.size(); ++j) {
    // omega: the angle of quadrants (+,+) and (-,-); the other two have pi - omega
    const Eigen::Vector3d u = tangents.u.col(Eigen::Index(j)), v = tangents.v.col(Eigen::Index(j));
    const double omega = 2 * std::atan2((u - v).norm(), (u + v).norm());
    const int even = holds[j][0] + holds[j][2], odd = holds[j][1] + holds[j][3];
    const int cells = even + odd;
    if (cells == 1) total += even ? M_PI / 2 - omega : omega - M_PI / 2;
    if (cells == 3) total += (even == 1 ? omega : M_PI - omega) - M_PI / 2;
    if (cells == 2 && even != 1) total += even == 2 ? M_PI - 2 * omega : 2 * omega - M_PI;
  }
  return total;
}

}  // namespace gridshell
