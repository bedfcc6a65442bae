#include "engine/gridshell/model.h"

namespace gridshell {

Model build_model(const RodMesh& mesh, const ShellRods& rods) {
  Model model;
  model.nodes = mesh.nodes();
  model.flat = mesh.flat;
  model.load = dead_loads(mesh, rods);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    const std::vector<double>& at = mesh.position[r];
    const RodSection& section = rods.section(r);
    for (std::size_t k = 1; k < node.size(); ++k) {
      const int edge = int(model.edges.size());
      const bool ghost = mesh.is_ghost(node[k - 1]) || mesh.is_ghost(node[k]);
      model.edges.push_back({node[k - 1], node[k], at[k] - at[k - 1], ghost ? 0 : section.EA});
      if (k + 1 == node.size()) continue;
      // only the rod bends, not what lies beyond its end
      const double before = mesh.is_ghost(node[k - 1]) ? 0 : at[k] - at[k - 1];
      const double after = mesh.is_ghost(node[k + 1]) ? 0 : at[k + 1] - at[k];
      model.bends.push_back({edge, 2 * section.EI / (0.5 * (before + after))});
    }
  }
  model.pinned.assign(model.nodes, 0);
  for (int k = 0; k < mesh.edge_points; ++k)
    model.pinned[mesh.joints + k] = mesh.ends.empty() || mesh.ends[k] != RodEnd::free;
  for (int node = mesh.rod_nodes(); node < model.nodes; ++node) model.pinned[node] = 1;
  model.free_index.assign(model.nodes, -1);
  for (int node = 0; node < model.nodes; ++node) {
    if (model.pinned[node]) continue;
    model.free_index[node] = int(model.free_nodes.size());
    model.free_nodes.push_back(node);
  }
  return model;
}

double load_energy(const Model& model, const Eigen::Matrix3Xd& x, double factor) {
  return model.load.size() == 0 ? 0 : -factor * (model.load.array() * x.array()).sum();
}

void add_loads(const Model& model, const Eigen::Matrix3Xd& x, double factor, Assembly& out) {
  if (model.load.size() == 0) return;
  out.energies[Term::load] = load_energy(model, x, factor);
  out.gradient -= factor * model.load;
}

double residual_of(const Model& model, const Eigen::Matrix3Xd& gradient) {
  double largest = 0;
  for (int node : model.free_nodes) {
    const double force = gradient.col(node).norm();
    if (!(force <= largest)) largest = force;  // a nan is kept, not hidden
  }
  return largest;
}

}  // namespace gridshell
