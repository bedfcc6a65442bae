#include "engine/session/first_state.h"

#include <cmath>

#include "engine/scene/net_design.h"
#include "engine/scene/second_ring.h"
#include "engine/solve/buckle.h"
#include "engine/solve/rest.h"

namespace gridshell {
namespace {

/// By how much the joints far out on y = -x lie higher than those on y = x, mm.
double lower_on_diagonal(const RodMesh& mesh, const Eigen::Matrix3Xd& nodes) {
  Eigen::VectorXd weight(mesh.joints);
  for (int k = 0; k < mesh.joints; ++k) weight[k] = -std::pow(mesh.flat.col(k).prod(), 3);
  const double all = weight.cwiseAbs().sum();
  return all > 0 ? weight.dot(nodes.row(2).head(mesh.joints)) / all : 0;
}

/// The seed's dome, at rest on the bend rung; of mirror images the one asked for.
Result<State> buckled_dome(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                           double t, const Scene& scene, const Watch& watch) {
  constexpr double clearly_mm = 1e-3;  // that one diagonal lies lower
  auto first = first_buckled(system, mesh, motion, t, scene.seed, scene.flat, watch);
  const auto lower = [&](const State& state) {
    return scene.seed.diagonal * lower_on_diagonal(mesh, nodes_of(mesh, system.model(), state.x));
  };
  if (!first || lower(*first) > -clearly_mm) return first;
  BuckleSeed other = scene.seed;
  other.diagonal *= -1;
  auto second = first_buckled(system, mesh, motion, t, other, scene.flat, watch);
  return second && lower(*second) > lower(*first) ? second : first;
}

}  // namespace

Result<State> buckled_state(NestedShell& shell, const Scene& scene, const ShellRods& rods, double t,
                            const Watch& watch) {
  const RodMesh& mesh = shell.mesh(0);
  const PinnedMotion& motion = shell.motion(0);
  if (scene.mechanics() == Rung::bend)
    return buckled_dome(shell.system(0), mesh, motion, t, scene, watch);
  const auto bend = build_model(mesh, rods, Rung::bend);
  if (!bend) return tl::unexpected<Error>(bend.error());
  Linearisation system(*bend);
  const auto shape = buckled_dome(system, mesh, motion, t, scene, watch);
  if (!shape) return shape;
  const Model& model = shell.model(0);
  State state = flat_state(model, mesh, motion, scene.flat);
  move_to(model, columns_of(mesh, model, shape->x), state);
  motion.impose(shell.system(0), t, state);
  return rest_below(shell.system(0), std::move(state), watch);
}

Result<State> state_on_net(NestedShell& shell, const Scene& scene, const Watch& watch) {
  const RodMesh& mesh = shell.mesh(0);
  const double spacing = scene.footprint.spacing;
  const Eigen::Matrix2Xd flat = within_boundary(scene.footprint, mesh);
  // blocks that meet with a gap would tear the rods between them
  auto net = scene.blocks ? scene.blocks->closed(flat, 4 * spacing) : points_on(*scene.net, flat);
  if (!net) return tl::unexpected<Error>(net.error());
  lay_tails(scene, mesh, *net);
  net->conservativeResize(3, mesh.nodes());
  net->rightCols(mesh.ghosts) = shell.motion(0).at(1).middleCols(mesh.rod_nodes(), mesh.ghosts);
  const Model& model = shell.model(0);
  State state = flat_state(model, mesh, shell.motion(0), scene.flat);
  move_to(model, columns_of(mesh, model, *net), state);
  shell.motion(0).impose(shell.system(0), 1, state);
  auto rest = rest_near(shell.system(0), state, 0.5 * spacing, watch);
  if (!rest) return fail(rest.error().fault, "next to the net there is " + rest.error().message);
  return rest;
}

}  // namespace gridshell
