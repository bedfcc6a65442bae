#include "engine/solve/motion.h"

namespace gridshell {

Eigen::Matrix3Xd PinnedMotion::at(double t) const { return begin + come(t) * change; }

Eigen::Vector3d PinnedMotion::at(double t, int node) const {
  return begin.col(node) + come(t) * change.col(node);
}

void PinnedMotion::load_up(Linearisation& system, double t) const {
  system.outside.load = grown(load, t);
  system.outside.field_factor = grown(field, t);
}

void PinnedMotion::impose(Linearisation& system, double t, State& state) const {
  load_up(system, t);
  const Model& model = system.model();
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < model.nodes; ++node)
    if (model.pinned(node)) x.col(node) = at(t, node);
  for (const Hold& hold : system.holds())
    x.col(hold.node) += hold.part(at(t, hold.node) - x.col(hold.node));
  move_to(model, x, state);
}

void PinnedMotion::velocity(Linearisation& system, double t, const State& state,
                            State& velocity) const {
  Outside growing = system.outside;
  growing.load = speed(t) * load.change;
  growing.field_factor = speed(t) * field.change;
  system.tangent(speed(t) * change, growing, state, velocity.x);
  velocity.force = system.force_change(velocity.x);
}

PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion) {
  PinnedMotion pinned;
  pinned.begin = pinned.change = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  pinned.begin.middleCols(mesh.joints, mesh.edge_points) = motion.begin;
  pinned.change.middleCols(mesh.joints, mesh.edge_points) = motion.end - motion.begin;
  // a ghost stays in the held direction from its edge point
  const auto place = [&](int ghost, Eigen::Index end, double side) {
    const double length = side * mesh.ghost_length;
    pinned.begin.col(ghost) = motion.begin.col(end) + length * motion.begin_tangent.col(end);
    pinned.change.col(ghost) = motion.end.col(end) + length * motion.end_tangent.col(end);
    pinned.change.col(ghost) -= pinned.begin.col(ghost);
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    if (mesh.is_ghost(node.front())) place(node.front(), 2 * Eigen::Index(r), -1);
    if (mesh.is_ghost(node.back())) place(node.back(), 2 * Eigen::Index(r) + 1, 1);
  }
  return pinned;
}

}  // namespace gridshell
