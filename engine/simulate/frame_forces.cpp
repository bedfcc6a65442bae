#include "engine/simulate/frame_forces.h"

#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/record/frame.h"

namespace gridshell::simulate {

int end_node(const RodMesh& mesh, int k) {
  const std::vector<int>& rod = mesh.rods[std::size_t(k / 2)];
  if (mesh.end_of(k) != RodEnd::joined) return mesh.joints + k;
  return k % 2 == 0 ? rod.front() : rod.back();
}

std::vector<int> supports_of(const RodMesh& mesh) {
  std::vector<int> nodes(std::size_t(mesh.joints));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int k = 0; k < mesh.edge_points; ++k)
    if (mesh.end_of(k) != RodEnd::joined) nodes.push_back(mesh.joints + k);
  for (int node : mesh.far_ends)
    if (node >= 0) nodes.push_back(node);
  return nodes;
}

Eigen::Matrix3Xd reactions_of(const RodMesh& mesh, const Model& model, const Assembly& at,
                              const std::vector<Constraint>& holds) {
  const std::vector<int> supports = supports_of(mesh);
  std::vector<Eigen::Vector3d> on(std::size_t(mesh.rod_nodes()), Eigen::Vector3d::Zero());
  for (const int node : supports)
    if (model.pinned(node)) on[std::size_t(node)] = at.gradient.col(node);
  // a ghost is held by what holds its end
  for (const Model::Rod& rod : model.rods) {
    for (const int edge : {rod.ghost_begin, rod.ghost_end}) {
      if (edge < 0) continue;
      const ModelEdge& ghost = model.edges[std::size_t(edge)];
      const bool begins = edge == rod.ghost_begin;
      const int end = begins ? ghost.to : ghost.from, beyond = begins ? ghost.from : ghost.to;
      if (end < mesh.rod_nodes()) on[std::size_t(end)] += at.gradient.col(beyond);
    }
  }
  for (const Constraint& hold : holds)
    on[std::size_t(hold.node)] = hold.part(at.gradient.col(hold.node));
  for (const MeshSpring& spring : mesh.springs)
    on[std::size_t(spring.node)] += at.gradient.col(spring.support);
  Eigen::Matrix3Xd reactions(3, long(supports.size()));
  for (std::size_t k = 0; k < supports.size(); ++k)
    reactions.col(long(k)) = on[std::size_t(supports[k])];
  return reactions;
}

namespace {

/// What acts on every node of the model, N.
Eigen::Matrix3Xd acting_on(const Model& model, const Eigen::Matrix3Xd& x,
                           const ExternalLoads& outside) {
  Eigen::Matrix3Xd acting = Eigen::Matrix3Xd::Zero(3, model.nodes);
  const auto add = [&](const std::vector<NodeAction>& actions, double factor) {
    for (NodeAction one : actions) {
      one.stiffness.setZero();
      one.add_gradient(-factor, x, acting);
    }
  };
  add(model.loads, outside.load);
  if (outside.steady) add(*outside.steady, 1);
  if (outside.field) add(*outside.field, outside.field_factor);
  return acting;
}

}  // namespace

Eigen::Matrix3Xd loads_on(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& x,
                          const ExternalLoads& outside) {
  Eigen::Matrix3Xd acting = acting_on(model, x, outside);
  if (acting.isZero(0)) return {};
  // the second node of a joint with a spring
  for (int k = mesh.nodes(); k < model.nodes; ++k) acting.col(k - mesh.nodes()) += acting.col(k);
  const std::vector<int> supports = supports_of(mesh);
  std::vector<int> place(std::size_t(mesh.nodes()), -1);
  for (std::size_t k = 0; k < supports.size(); ++k) place[std::size_t(supports[k])] = int(k);
  Eigen::Matrix3Xd loads = acting(Eigen::all, supports);
  // between two supports as a beam does
  const auto hand_on = [&](std::size_t r, std::size_t from, std::size_t to) {
    const auto& s = mesh.position[r];
    for (std::size_t k = from + 1; k < to; ++k) {
      const double share = (s[k] - s[from]) / (s[to] - s[from]);
      const Eigen::Vector3d force = acting.col(mesh.rods[r][k]);
      loads.col(place[std::size_t(mesh.rods[r][from])]) += (1 - share) * force;
      loads.col(place[std::size_t(mesh.rods[r][to])]) += share * force;
    }
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    std::optional<std::size_t> before;
    for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
      if (place[std::size_t(mesh.rods[r][k])] < 0) continue;
      if (before) hand_on(r, *before, k);
      before = k;
    }
  }
  return loads;
}

Eigen::VectorXd brace_forces(const Footprint& footprint, const Model& model,
                             const Eigen::Matrix3Xd& x) {
  if (model.bars.empty()) return {};
  std::map<std::pair<int, int>, double> along;
  for (const ModelBar& bar : model.bars) {
    const int a = bar.law.a, b = bar.law.b;
    along[{a, b}] += bar.law.force(bar.law.strain((x.col(b) - x.col(a)).norm()));
  }
  Eigen::VectorXd forces(2 * Eigen::Index(footprint.cells.size()));
  for (Eigen::Index k = 0; k < forces.size(); ++k) {
    const auto& joints = footprint.cells[std::size_t(k / 2)].joints;
    const auto there = along.find({joints[std::size_t(k % 2)], joints[std::size_t(k % 2 + 2)]});
    forces[k] = there == along.end() ? record::unknown : there->second;
  }
  return forces;
}

}  // namespace gridshell::simulate
