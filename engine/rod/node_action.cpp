#include "engine/rod/node_action.h"

namespace gridshell {

double NodeAction::value(const Eigen::Vector3d& x) const {
  return -force.dot(x) + 0.5 * (stiffness.array() * (x - anchor).array().square()).sum();
}

Eigen::Vector3d NodeAction::gradient(const Eigen::Vector3d& x) const {
  return -force + stiffness.cwiseProduct(x - anchor);
}

}  // namespace gridshell
