#include "engine/experiment/snap.h"

#include <algorithm>
#include <cmath>

#include "engine/experiment/frames.h"
#include "engine/measure/gauss.h"
#include "engine/solve/damped_motion.h"
#include "engine/solve/minimise.h"

namespace gridshell::experiment {
namespace {

constexpr int most_frames = 24;
constexpr double nudge = 0.02;       // mm along the softest mode: an unstable rest could stand
constexpr double still_move = 0.01;  // of d: nearer to the rest nothing is seen to move

/// what the coarsest mesh was like at a time
struct Moment {
  double time = 0;
  Eigen::Matrix3Xd x;
};

record::Frame frame_of_moment(const ActuationScene& scene, NestedShell& shell,
                              const MeshTransfer& to_finest, const Moment& moment) {
  const RodMesh& mesh = shell.mesh(0);
  record::Frame frame;
  Eigen::Matrix3Xd x;
  to_finest.nodes(moment.x, x);
  put_shape(scene, shell.mesh(shell.levels() - 1), x,
            cell_curvature(scene.footprint, joint_tangents(scene.footprint, mesh, moment.x)),
            frame);
  frame.energies = energies_of(shell.model(0), moment.x);
  shell.system(0).gradient_at({moment.x, {}});
  frame.residual_N = shell.system(0).residual();
  frame.negative_pivots = -1;
  frame.time_s = moment.time;
  frame.event = "in motion";
  return frame;
}

/// the moments to show: until nothing is seen to move, evenly in time
std::vector<Moment> shown(const std::vector<Moment>& all, double spacing) {
  std::size_t end = all.size();
  while (end > 1 && largest_column(all[end - 1].x - all.back().x) < still_move * spacing) --end;
  std::vector<Moment> few;
  const double until = all[end - 1].time;
  for (std::size_t k = 0; k < end; ++k)
    if (all[k].time >= until * double(few.size() + 1) / most_frames) few.push_back(all[k]);
  return few;
}

}  // namespace

Result<State> snap_in_time(const ActuationScene& scene, NestedShell& shell, double beyond,
                           const Watch& watch, std::vector<record::Frame>& frames) {
  Linearisation& system = shell.system(0);
  const Eigen::VectorXd mass = lumped(shell.mesh(0), scene.mass_t_per_mm);
  if (!(mass.sum() > 0)) return fail(Fault::bad_input, "a snap in time needs the rods' density");
  system.set_load(shell.motion(0).load(shell.followed().t));
  State state = shell.followed().state;
  system.at(state, false);
  const Eigen::Matrix3Xd mode = softest_mode(system);
  shell.motion(0).impose(system, beyond, state.x);
  // to the side on which the energy falls
  const double push = nudge / largest_column(mode);
  const auto energy = [&](double side) {
    const Eigen::Matrix3Xd x = state.x + side * push * mode;
    return energies_of(system.model(), x).total() +
           load_energy(system.model(), x, system.load_factor());
  };
  state.x += (energy(1) <= energy(-1) ? push : -push) * mode;

  DynamicsOptions options;
  options.step_s = scene.snap.step_s;
  options.damping_per_s = scene.snap.damping_per_s;
  options.tolerance_mm = 1e-7;
  DampedMotion moving(system.model(), mass, options, system.prescription(), system.load_factor());
  Motion motion{state.x, Eigen::Matrix3Xd::Zero(3, state.x.cols()), 0};
  std::vector<Moment> moments;
  const auto settled = moving.settle(
      motion, {.still_N = 1e-4, .still_mJ = 1e-7},
      [&](const Motion& now) {
        moments.push_back({now.time, now.x});
      },
      watch);
  if (!settled) return tl::unexpected<Error>(settled.error());
  state.x = motion.x;
  system.gradient_at(state);
  state.force = system.assembly().force;
  if (minimise(system, state, {}, watch).outcome != NewtonOutcome::converged)
    return fail(Fault::no_equilibrium, "the motion did not end near a rest");
  const MeshTransfer to_finest(shell.mesh(0), shell.mesh(shell.levels() - 1));
  for (const Moment& moment : shown(moments, scene.footprint.spacing))
    frames.push_back(frame_of_moment(scene, shell, to_finest, moment));
  return state;
}

}  // namespace gridshell::experiment
