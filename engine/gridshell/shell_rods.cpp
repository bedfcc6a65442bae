#include "engine/gridshell/shell_rods.h"

namespace gridshell {

Eigen::VectorXd lumped(const RodMesh& mesh, const std::vector<double>& per_mm) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.nodes());
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    for (std::size_t k = 1; k < node.size(); ++k) {
      if (mesh.is_ghost(node[k - 1]) || mesh.is_ghost(node[k])) continue;
      const double half = 0.5 * per_mm[r] * (mesh.position[r][k] - mesh.position[r][k - 1]);
      sum[node[k - 1]] += half;
      sum[node[k]] += half;
    }
  }
  return sum;
}

Eigen::Matrix3Xd dead_loads(const RodMesh& mesh, const ShellRods& rods) {
  if (!rods.loaded()) return {};
  Eigen::Matrix3Xd load = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  if (!rods.weight_N_per_mm.empty()) load.row(2) = -lumped(mesh, rods.weight_N_per_mm).transpose();
  for (const PointLoad& point : rods.points) load.col(point.joint) += point.force;
  return load;
}

}  // namespace gridshell
