#include "engine/simulate/branch_switch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/solve/newton.h"
#include "engine/solve/turning_rods.h"

namespace gridshell {
namespace {

constexpr double still_mm = 0.01;  // perturbation of an unstable equilibrium before a snap in time

/// Adds random sine waves to `direction`, along rods that turn freely or that buckle between fixed
/// joints. They are drawn rod by rod, so that they are equal on every mesh.
void add_waves(const Scene& scene, const RodMesh& mesh, std::mt19937& random,
               Eigen::Matrix3Xd& direction) {
  constexpr int waves = 3;
  const Footprint& footprint = scene.footprint;
  const std::set<int> fixed(footprint.fixed_joints.begin(), footprint.fixed_joints.end());
  const auto turning = turning_rods(footprint, scene.rods, scene.motion, scene.solved_model());
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    const bool turns = std::ranges::find(turning, r, &TurningRod::rod) != turning.end();
    if (!turns && !std::ranges::all_of(footprint.rods[r].joints,
                                       [&](int joint) { return fixed.contains(joint); }))
      continue;
    const std::vector<int>& nodes = mesh.rods[r];
    for (int wave = 1; wave <= waves; ++wave)
      for (int axis = 0; axis < 3; ++axis) {
        const double amplitude = symmetric_uniform(random);
        for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
          direction(axis, nodes[k]) +=
              amplitude * std::sin(wave * std::numbers::pi * double(k) / double(nodes.size() - 1));
      }
  }
}

/// The state perturbed to the side of `mode` that the branch switch takes; of equivalent sides, the
/// one on which the energy decreases.
State perturbed_along_mode(Linearisation& system, const State& state, const Eigen::Matrix3Xd& mode,
                           BranchSide side) {
  const double push = 2 * still_mm / max_column_norm(mode);
  State along = state, against = state;
  move_to(system.model(), state.x + push * mode, along);
  move_to(system.model(), state.x - push * mode, against);
  if (side == BranchSide::along) return along;
  if (side == BranchSide::against) return against;
  return system.energy_at(along) <= system.energy_at(against) ? along : against;
}

BranchSwitch departure_for(Event::Kind kind, const Scene& scene, const NestedShell& shell) {
  BranchSwitch departure = departure_of(scene, shell.finest(), shell.model());
  // at a limit point there is one direction
  if (kind != Event::Kind::stability_lost) departure.side = BranchSide::lower;
  return departure;
}

/// The unstable equilibrium on the same branch, a little past the loss of stability; none if
/// Newton's method does not find one. A perturbation of this equilibrium stays on its side. That of
/// a state out of equilibrium is undone by the first corrections, and round-off chooses the side.
std::optional<State> unstable_branch(Linearisation& system, State state, double farthest_mm,
                                     const Watch& watch) {
  NewtonOptions options;
  options.farthest_mm = farthest_mm;
  if (newton(system, state, options, watch).outcome != Outcome::reached) return std::nullopt;
  const Inertia inertia = system.at(state, false);
  if (!inertia.usable || inertia.positive_definite()) return std::nullopt;
  return state;
}

/// The last state of a path, extrapolated to the boundary at `there` by the path's velocity. The
/// stiffness is shifted by the least amount that displaces no node by more than `farthest_mm`; if
/// no shift does, only prescribed components move. A boundary that moves alone would strain the
/// legs, with thousands of times the energy of the snap, and the descent would release that energy.
State extrapolated_state(Linearisation& system, const PinnedMotion& motion, const PathPoint& last,
                         double there, double farthest_mm, const Watch& watch) {
  constexpr double least_shift = 1e-9, largest_shift = 1e4;  // N/mm
  const double change = there - last.t;
  State state = last.state;
  motion.apply_loads(system, last.t);
  Inertia inertia = system.at(last.state);
  for (double shift = least_shift; shift <= largest_shift && !watch.cancelled(); shift *= 16) {
    if (inertia.positive_definite()) {
      State velocity;
      motion.velocity(system, last.t, last.state, velocity);
      if (std::abs(change) * max_column_norm(velocity.x) <= farthest_mm) {
        const Eigen::Matrix3Xd move = change * velocity.x;
        const double fraction = system.clear_fraction(last.state, move);
        move_to(system.model(), last.state.x + fraction * move, state);
        state.force += fraction * change * velocity.force;
        break;
      }
    }
    inertia = system.shifted(shift);
  }
  motion.impose(system, there, state);
  return state;
}

}  // namespace

BranchSwitch departure_of(const Scene& scene, const RodMesh& mesh, const Model& model) {
  const Imperfection& imperfection = scene.imperfection;
  BranchSwitch departure;
  departure.step_mm = 0.025 * scene.footprint.spacing;
  if (!imperfection.chooses()) return departure;
  departure.amplitude_mm = imperfection.size_mm;
  departure.side = BranchSide::along;
  if (imperfection.soft_mode && imperfection.seed % 2 == 0) departure.side = BranchSide::against;
  std::mt19937 random{imperfection.soft_mode ? 0u : std::uint32_t(imperfection.seed)};
  departure.start = Eigen::Matrix3Xd::Zero(3, model.columns());
  for (int joint = 0; joint < mesh.joints; ++joint)
    for (int axis = 0; axis < 3; ++axis) departure.start(axis, joint) = symmetric_uniform(random);
  add_waves(scene, mesh, random, departure.start);
  // a path from a drawing in the plane leaves it to the side of the seed, like one from the flat
  if (scene.from_drawing && !scene.footprint.in_space())
    departure.start.row(2) = scene.seed.up * departure.start.row(2).cwiseAbs();
  return departure;
}

Result<State> rest_after_bifurcation(NestedShell& shell, const Scene& scene, const PathPoint& last,
                                     Event::Kind kind, double there,
                                     std::vector<TimedState>& moments, const Watch& watch) {
  Linearisation& system = shell.system();
  const PinnedMotion& motion = shell.motion();
  BranchSwitch departure = departure_for(kind, scene, shell);
  departure.symmetries = symmetries_of(shell.finest(), motion.at(there));
  // the mode that lost stability first: past the event there may be several unstable modes
  motion.apply_loads(system, last.t);
  system.at(last.state, false);
  const Eigen::Matrix3Xd mode = softest_mode(system, departure.start, watch);
  State state =
      extrapolated_state(system, motion, last, there, 0.2 * scene.footprint.spacing, watch);
  if (system.clear_fraction(last.state, state.x - last.state.x) < 1)
    return fail(Fault::no_equilibrium, "rods would go through one another");
  if (kind == Event::Kind::stability_lost)
    state = unstable_branch(system, state, 0.1 * scene.footprint.spacing, watch).value_or(state);
  if (!scene.snap.requested) return leave_saddle(system, state, mode, departure, watch);
  auto moved = rest_in_time(
      shell, scene, perturbed_along_mode(system, state, mode, departure.side),
      {.still_N = 1e-4, .still_mJ = 1e-7},
      [&](const MovingState& now) {
        moments.push_back({now.time, now.state});
      },
      watch);
  if (!moved) return moved;
  if (minimise(system, *moved, {}, watch).outcome != Outcome::reached)
    return fail(Fault::no_equilibrium, "the motion did not end near an equilibrium");
  return moved;
}

bool on_branch_from(NestedShell& shell, const Scene& scene, const PathPoint& last, double there,
                    const State& rest, const Watch& watch) {
  // fraction of the interval of t; a quarter of the distance is expected to remain there
  constexpr double fraction = 1.0 / 16;
  const double near = last.t + fraction * (there - last.t);
  // where two modes lose stability, a branch may be unstable next to the other
  PathFollower back(shell.system(), shell.motion(),
                    {.spacing_mm = scene.footprint.spacing, .allow_unstable = true});
  if (back.start(there, rest, watch).end != Outcome::reached) return false;
  // a second mode may end the path early, near the bifurcation: its last state is compared
  back.advance(near, watch);
  const auto distance = [&](const State& state, double t) {
    Eigen::Matrix3Xd predicted = last.state.x;
    // the velocity is not known at the start of a path
    if (last.velocity.x.size() > 0) predicted += (t - last.t) * last.velocity.x;
    return max_column_norm((state.x - predicted).leftCols(shell.model().nodes));
  };
  const double found = distance(back.point().state, back.point().t);
  return found < 2 * std::sqrt(fraction) * distance(rest, there);
}

Result<State> rest_in_time(NestedShell& shell, const Scene& scene, const State& from,
                           const RestOptions& rest,
                           const std::function<void(const MovingState&)>& seen,
                           const Watch& watch) {
  Linearisation& system = shell.system();
  TRY(mass, lumped_mass(system.model(), scene.mass_t_per_mm, scene.joint_masses()));
  DynamicsOptions options;
  options.step_s = scene.snap.step_s;
  options.damping_per_s = scene.snap.damping_per_s;
  options.tolerance_mm = 1e-7;
  DampedMotion damped(system.model(), *mass, options, system.outside, system.constraints());
  MovingState moving = MovingState::at_rest(from);
  TRY_DO(damped.settle(moving, rest, seen, watch));
  system.gradient_at(moving.state);
  moving.state.force = system.assembly().force;
  return moving.state;
}

}  // namespace gridshell
