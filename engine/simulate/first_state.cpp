#include "engine/simulate/first_state.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/scene/net_design.h"
#include "engine/scene/rod_ends.h"
#include "engine/simulate/branch_switch.h"
#include "engine/simulate/shell_symmetry.h"
#include "engine/solve/buckling.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {
namespace {

constexpr double least_shortening = 1e-3;  // mean shortening from which rods buckle
constexpr int choosing_edges = 4;          // per segment, on the mesh that chooses the branch

/// The dome of the seed in equilibrium with the bend model; of mirror images the requested one.
Result<State> buckled_dome(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                           double t, const Scene& scene, const Watch& watch) {
  // differences of the diagonals below this do not count
  const double clearly_mm = 5e-5 * scene.footprint.spacing;
  auto first = first_buckled(system, mesh, motion, t, scene.seed, scene.flat, watch);
  const auto lower = [&](const State& state) {
    return scene.seed.diagonal * lower_on_diagonal(mesh, nodes_of(mesh, system.model(), state.x));
  };
  if (!first || lower(*first) > -clearly_mm) return first;
  BuckleSeed other = scene.seed;
  other.diagonal *= -1;
  auto second = first_buckled(system, mesh, motion, t, other, scene.flat, watch);
  Result<State>& found = second && lower(*second) > lower(*first) ? second : first;
  if (lower(*found) > -clearly_mm) return found;
  // where both seeds lead to one state, an image of it may be the requested one
  const Eigen::Matrix3Xd nodes = found->x.leftCols(system.model().nodes);
  for (const MeshSymmetry& symmetry :
       simulate::symmetries_of_shell(scene, mesh, symmetries_of(mesh, motion.at(t)))) {
    State image = start_state(system.model(), symmetry.of(nodes));
    if (!symmetry.turns_over() && lower(image) > clearly_mm) return image;
  }
  return found;
}

/// The drawn shape relaxed to equilibrium with the bend model.
Result<State> drawn_rest(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                         double t, const Scene& scene, const Watch& watch) {
  State state = flat_state(system.model(), mesh, motion, scene.flat);
  motion.impose(system, t, state);
  // the imperfection chooses the side of a saddle, so that it is the same on all meshes
  return find_equilibrium(system, state, 0.5 * scene.footprint.spacing, watch,
                          departure_of(scene, mesh, system.model()));
}

using FindShape = decltype(drawn_rest);

/// The result of `find` on the mesh that chooses the branch, in equilibrium on the coarsest.
Result<State> chosen(FindShape& find, NestedShell& shell, const Scene& scene, const ShellRods& rods,
                     double t, const Watch& watch) {
  const RodMesh& mesh = shell.finest();
  if (scene.solved_model() == RodModel::bend &&
      shell.plan().edges_per_segment.back() == choosing_edges)
    return find(shell.system(), mesh, shell.motion(), t, scene, watch);
  MeshLevel chooser;
  TRY_DO(chooser.build(scene.footprint, rods, RodModel::bend, scene.motion, choosing_edges));
  const auto shape = find(*chooser.system, chooser.mesh, chooser.motion, t, scene, watch);
  shell.system().effort() += chooser.system->effort();
  if (!shape) return shape;
  Eigen::Matrix3Xd nodes;
  MeshTransfer(chooser.mesh, mesh).nodes(nodes_of(chooser.mesh, chooser.model, shape->x), nodes);
  const Model& model = shell.model();
  State state = flat_state(model, mesh, shell.motion(), scene.flat);
  move_to(model, columns_of(mesh, model, nodes), state);
  shell.motion().impose(shell.system(), t, state);
  return find_equilibrium(shell.system(), state, 0.5 * scene.footprint.spacing, watch,
                          departure_of(scene, mesh, model));
}

/// Checks that no joint with a hinge is closed: if its rods are parallel, they have no plane to
/// turn in. Errors: bad_input.
Result<void> check_open(const NestedShell& shell, const Scene& scene, const State& rest) {
  constexpr double least = 1e-4;  // rad
  const auto& hinges = shell.model().hinges;
  const auto tangent = [&](int edge) -> Eigen::Vector3d {
    const ModelEdge& one = shell.model().edges[std::size_t(edge)];
    return (rest.x.col(one.to) - rest.x.col(one.from)).normalized();
  };
  const auto closed = [&](const ModelHinge& hinge) {
    return tangent(hinge.pair.e).cross(tangent(hinge.pair.f)).norm() < least;
  };
  const auto first = std::ranges::find_if(hinges, closed);
  if (first == hinges.end()) return {};
  const int node = shell.model().edges[std::size_t(first->pair.e)].centre;
  const FootprintJoint& at = scene.footprint.joints[std::size_t(shell.finest().joint_of(node))];
  return invalid(
      "joint [{}, {}] and {} others close: their rods become parallel, where a hinge has no plane "
      "to turn in; a weak spring in addition to the hinge keeps them open "
      "(\"law\": \"spring\", \"shear_Nmm\": 0.1, \"twist_Nmm\": 1e9)",
      at.i, at.j, std::ranges::count_if(hinges, closed) / 2 - 1);
}

}  // namespace

double lower_on_diagonal(const RodMesh& mesh, const Eigen::Matrix3Xd& nodes) {
  Eigen::VectorXd weight(mesh.joints);
  for (int k = 0; k < mesh.joints; ++k) weight[k] = -std::pow(mesh.flat.col(k).prod(), 3);
  const double all = weight.cwiseAbs().sum();
  return all > 0 ? weight.dot(nodes.row(2).head(mesh.joints)) / all : 0;
}

Result<State> buckled_state(NestedShell& shell, const Scene& scene, const ShellRods& rods, double t,
                            const Watch& watch) {
  return chosen(buckled_dome, shell, scene, rods, t, watch);
}

bool begins_as_drawn(const Scene& scene, const RodMesh& mesh, const PinnedMotion& motion) {
  if (scene.from_drawing) return true;
  const bool network = scene.footprint.rods.front().number >= 0;
  return !scene.from_net && (scene.rods.loaded() || !scene.load_cases.empty() || network) &&
         !parameter_of_shortening(mesh, motion, least_shortening);
}

Result<State> state_as_drawn(NestedShell& shell, const Scene& scene, const ShellRods& rods,
                             const Watch& watch) {
  // the bend model would ignore section axes and natural shapes of rods
  auto rest = scene.solved_model() == RodModel::twist
                  ? drawn_rest(shell.system(), shell.finest(), shell.motion(), 0, scene, watch)
                  : chosen(drawn_rest, shell, scene, rods, 0, watch);
  const auto is_open = [&](State&& found) {
    return check_open(shell, scene, found).map([&] { return std::move(found); });
  };
  return std::move(rest).and_then(is_open).map_error([](const Error& error) {
    return Error{error.fault, "from the network as drawn: " + error.message};
  });
}

Result<State> state_on_net(NestedShell& shell, const Scene& scene, const Watch& watch) {
  const RodMesh& mesh = shell.finest();
  const double spacing = scene.footprint.spacing;
  const Eigen::Matrix2Xd flat = within_boundary(scene.footprint, mesh);
  // blocks that meet with a gap would tear the rods between them
  TRY(net, scene.blocks ? scene.blocks->closed(flat, 4 * spacing) : points_on(*scene.net, flat));
  set_tails(scene, mesh, *net);
  net->conservativeResize(3, mesh.nodes());
  net->rightCols(mesh.nodes_off_rods()) =
      shell.motion().at(1).middleCols(mesh.rod_nodes(), mesh.nodes_off_rods());
  const Model& model = shell.model();
  State state = flat_state(model, mesh, shell.motion(), scene.flat);
  move_to(model, columns_of(mesh, model, *net), state);
  shell.motion().impose(shell.system(), 1, state);
  auto rest = find_equilibrium(shell.system(), state, 0.5 * spacing, watch);
  if (!rest) return fail(rest.error().fault, "next to the net there is " + rest.error().message);
  return rest;
}

}  // namespace gridshell
