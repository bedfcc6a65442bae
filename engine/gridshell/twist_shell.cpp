#include "engine/gridshell/twist_shell.h"

#include <array>
#include <cmath>

namespace gridshell {
namespace {

bool along_u(const RodMesh& mesh, std::size_t rod) {
  const Eigen::Vector2d way =
      mesh.flat.col(mesh.rods[rod].back()) - mesh.flat.col(mesh.rods[rod].front());
  return std::abs(way.x()) > std::abs(way.y());
}

/// the rod without its ghosts, and what holds its ends
TwistRod rod_of(const RodMesh& mesh, std::size_t r, const RodMaterial& material) {
  TwistRod rod{{}, {}, material, RodEnd::pinned, RodEnd::pinned, {0, 0, 1}};
  for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
    if (mesh.is_ghost(mesh.rods[r][k])) continue;
    rod.nodes.push_back(mesh.rods[r][k]);
    rod.position.push_back(mesh.position[r][k]);
  }
  if (mesh.ends.empty()) return rod;
  rod.begin = mesh.ends[2 * r];
  rod.end = mesh.ends[2 * r + 1];
  return rod;
}

/// u rod and v rod of every joint
std::vector<std::array<int, 2>> crossings_of(const RodMesh& mesh) {
  std::vector<std::array<int, 2>> rods(std::size_t(mesh.joints), {-1, -1});
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (int node : mesh.rods[r])
      if (node < mesh.joints) rods[std::size_t(node)][along_u(mesh, r) ? 0 : 1] = int(r);
  return rods;
}

int twins(const RodMesh& mesh, const TwistModel& model) {
  return model.nodes - mesh.nodes();  // the model's ghosts are the mesh's
}

}  // namespace

Result<TwistModel> twist_model_of(const RodMesh& mesh, const TwistRods& shell) {
  const JointLaw& law = shell.joints;
  const bool springs = law.spring_N_per_mm > 0;
  const int own = mesh.rod_nodes();  // first of the nodes that v rods have to themselves
  std::vector<TwistRod> rods;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    rods.push_back(
        rod_of(mesh, r, shell.materials.size() == 1 ? shell.materials[0] : shell.materials[r]));
    if (!springs || along_u(mesh, r)) continue;
    for (int& node : rods.back().nodes)
      if (node < mesh.joints) node += own;
  }
  auto model = build_twist_model(own + (springs ? mesh.joints : 0), rods);
  if (!model) return model;
  const auto crossings = crossings_of(mesh);
  for (int joint = 0; joint < mesh.joints; ++joint) {
    const int other = springs ? own + joint : joint;
    const auto [u, v] = crossings[std::size_t(joint)];
    if (springs) model->springs.push_back({joint, other, law.spring_N_per_mm});
    if (law.shear_Nmm > 0) add_joint_shear(*model, u, joint, v, other, law.shear_Nmm, M_PI / 2);
    if (law.twist_Nmm > 0) add_joint_twist(*model, u, joint, v, other, law.twist_Nmm);
  }
  const Eigen::Matrix3Xd load = dead_loads(mesh, shell.loads);
  if (load.size() > 0) model->load.leftCols(own) = load.leftCols(own);
  return model;
}

Eigen::Matrix3Xd to_twist_nodes(const RodMesh& mesh, const TwistModel& model,
                                const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd all(3, model.nodes);
  all << x.leftCols(mesh.rod_nodes()), x.leftCols(twins(mesh, model)), x.rightCols(mesh.ghosts);
  return all;
}

Eigen::Matrix3Xd from_twist_nodes(const RodMesh& mesh, const TwistModel& model,
                                  const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd nodes(3, mesh.nodes());
  nodes << x.leftCols(mesh.rod_nodes()), x.rightCols(mesh.ghosts);
  const int own = twins(mesh, model);
  if (own == 0) return nodes;
  nodes.leftCols(own) = (0.5 * (x.leftCols(own) + x.middleCols(mesh.rod_nodes(), own))).eval();
  return nodes;
}

}  // namespace gridshell
