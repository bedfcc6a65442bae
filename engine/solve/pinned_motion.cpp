#include "engine/solve/pinned_motion.h"

#include <Eigen/Geometry>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"

namespace gridshell {

Eigen::Vector3d EndRotation::at(double t) const {
  return (1 + t * stretch) * (Eigen::AngleAxisd(t * angle, axis) * arm);
}

Eigen::Vector3d EndRotation::rate(double t) const {
  const Eigen::Vector3d turned = Eigen::AngleAxisd(t * angle, axis) * arm;
  return stretch * turned + (1 + t * stretch) * angle * axis.cross(turned);
}

EndRotation rotation_between(int node, int about, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to) {
  const Eigen::AngleAxisd rotation(turn_between(from, to));
  return {node, about, from, rotation.axis(), rotation.angle(), to.norm() / from.norm() - 1};
}

Eigen::Matrix3Xd PinnedMotion::at(double t) const {
  Eigen::Matrix3Xd x = begin + progress(t) * change;
  for (const EndRotation& turn : turns) x.col(turn.node) = x.col(turn.about) + turn.at(t);
  return x;
}

Eigen::Matrix3Xd PinnedMotion::rate(double t) const {
  Eigen::Matrix3Xd x = speed(t) * change;
  for (const EndRotation& turn : turns) x.col(turn.node) = x.col(turn.about) + turn.rate(t);
  return x;
}

void PinnedMotion::apply_loads(Linearisation& system, double t) const {
  system.outside.load = factor_at(load, t);
  system.outside.field_factor = factor_at(field, t);
  system.outside.opening = factor_at(opening, t);
}

void PinnedMotion::impose(Linearisation& system, double t, State& state) const {
  apply_loads(system, t);
  const Model& model = system.model();
  const Eigen::Matrix3Xd there = at(t);
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < model.nodes; ++node)
    if (model.pinned(node)) x.col(node) = there.col(node);
  for (const Constraint& constraint : system.constraints())
    x.col(constraint.node) += constraint.part(there.col(constraint.node) - x.col(constraint.node));
  move_to(model, x, state);
}

void PinnedMotion::velocity(Linearisation& system, double t, const State& state,
                            State& velocity) const {
  ExternalLoads growing = system.outside;
  growing.load = speed(t) * load.change;
  growing.field_factor = speed(t) * field.change;
  growing.opening = speed(t) * opening.change;
  system.tangent(rate(t), growing, state, velocity.x);
  velocity.force = system.force_change(velocity.x, growing.opening);
}

PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion) {
  PinnedMotion pinned;
  pinned.begin = pinned.change = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  pinned.begin.middleCols(mesh.joints, mesh.edge_points) = motion.begin;
  pinned.change.middleCols(mesh.joints, mesh.edge_points) = motion.end - motion.begin;
  for (std::size_t k = 0; k < mesh.fixed_joints.size(); ++k) {
    const Eigen::Vector3d from = motion.begin_joints.col(Eigen::Index(k));
    pinned.begin.col(mesh.fixed_joints[k]) = from;
    pinned.change.col(mesh.fixed_joints[k]) = motion.end_joints.col(Eigen::Index(k)) - from;
  }
  // a ghost is in the prescribed direction from its edge point
  const auto set_ghost = [&](int ghost, Eigen::Index end, double side) {
    const double length = side * mesh.ghost_length;
    pinned.begin.col(ghost) = motion.begin.col(end) + length * motion.begin_tangent.col(end);
    pinned.change.col(ghost) = motion.end.col(end) + length * motion.end_tangent.col(end);
    pinned.change.col(ghost) -= pinned.begin.col(ghost);
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    if (mesh.is_ghost(node.front())) set_ghost(node.front(), 2 * Eigen::Index(r), -1);
    if (mesh.is_ghost(node.back())) set_ghost(node.back(), 2 * Eigen::Index(r) + 1, 1);
  }
  // a spring's support is placed where its rod would be pinned
  for (const MeshSpring& spring : mesh.springs) {
    pinned.begin.col(spring.support) = pinned.begin.col(spring.node);
    pinned.change.col(spring.support) = pinned.change.col(spring.node);
  }
  for (Eigen::Index end = 0; end < Eigen::Index(mesh.far_ends.size()); ++end) {
    const int far_end = mesh.far_ends[std::size_t(end)];
    if (far_end < 0) continue;
    pinned.begin.col(far_end) = motion.begin_far.col(end);
    pinned.turns.push_back(rotation_between(far_end, mesh.joints + int(end),
                                            motion.begin_far.col(end) - motion.begin.col(end),
                                            motion.end_far.col(end) - motion.end.col(end)));
  }
  return pinned;
}

}  // namespace gridshell
