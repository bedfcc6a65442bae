#include "engine/solve/buckle.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/solve/minimise.h"

namespace gridshell {
namespace {

constexpr double tilt = 0.8;  // of the dome towards a diagonal; small ones are lost to round-off

Result<State> at_rest(const NewtonReport& report, State state, const Watch& watch) {
  if (report.outcome == NewtonOutcome::converged) return state;
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for an equilibrium");
  return fail(Fault::no_equilibrium,
              fmt::format("no equilibrium after {} iterations; the last moved a node by {:.2g} mm",
                          report.iterations, report.last_move_mm));
}

}  // namespace

double mean_shortening(const RodMesh& mesh, const PinnedMotion& motion, double t) {
  double chords = 0, lengths = 0;
  const auto end = [&](int node) -> Eigen::Vector3d {
    return motion.begin.col(node) + t * t * motion.change.col(node);
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    chords += (end(mesh.rods[r].back()) - end(mesh.rods[r].front())).norm();
    lengths += mesh.position[r].back() - mesh.position[r].front();
  }
  return 1 - chords / lengths;
}

Result<double> parameter_of_shortening(const RodMesh& mesh, const PinnedMotion& motion,
                                       double shortening) {
  double low = 0, high = 1;
  while (mean_shortening(mesh, motion, high) < shortening) {
    high *= 2;
    if (high > 1000)
      return fail(Fault::bad_input,
                  "the actuated boundary does not shorten the rods: nothing would buckle");
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_shortening(mesh, motion, middle) < shortening ? low : high) = middle;
  }
  return high;
}

Result<State> first_buckled(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                            double t, const BuckleSeed& seed, const FlatFrame& flat,
                            const Watch& watch) {
  const Model& model = system.model();
  const double reach2 = mesh.flat.colwise().squaredNorm().maxCoeff();
  const double shortening = mean_shortening(mesh, motion, t);
  system.set_load(motion.load(t));
  const double height = std::sqrt(std::max(shortening, 0.0) * reach2);
  State state;
  state.x.resize(3, model.nodes);
  state.force.setZero(Eigen::Index(model.edges.size()));
  for (int node = 0; node < model.nodes; ++node) {
    const Eigen::Vector2d p = mesh.flat.col(node);
    const double dome = 1 - p.squaredNorm() / reach2;
    const double tilted = 1 - seed.up * seed.diagonal * tilt * p.x() * p.y() / reach2;
    state.x.col(node) = flat.at((1 - shortening) * p);
    state.x(2, node) += seed.up * height * dome * tilted;
    if (model.pinned[node])
      state.x.col(node) = motion.begin.col(node) + t * t * motion.change.col(node);
  }
  NewtonReport report;
  for (double EA_scale : {0.01, 1.0}) {
    MinimiseOptions options;
    options.EA_scale = EA_scale;
    if (EA_scale < 1) options.tolerance_mm = 1e-2;
    report = minimise(system, state, options, watch);
    if (report.outcome == NewtonOutcome::not_finite || watch.cancelled()) break;
  }
  // nothing moves any more, but a mode without stiffness keeps it from being a minimum
  const bool on_saddle =
      report.outcome == NewtonOutcome::not_converged && report.last_move_mm < 1e-3;
  if (on_saddle && !watch.cancelled()) {
    system.at(state, false);
    return settle(system, state, softest_mode(system), watch);
  }
  return at_rest(report, std::move(state), watch);
}

Eigen::Matrix3Xd softest_mode(Linearisation& system) {
  const Model& model = system.model();
  double shift = 1e-6;
  while (!system.shifted(shift).positive_definite() && shift < 1e6) shift *= 4;
  // a start with a part along any mode: no symmetry of the net leaves it unchanged
  Eigen::Matrix3Xd mode(3, model.nodes);
  for (int node = 0; node < model.nodes; ++node)
    mode.col(node) << std::sin(0.7 + 1.3 * node), std::sin(1.9 + 2.1 * node),
        1 + std::sin(2.3 + 0.9 * node);
  for (int k = 0; k < 20; ++k) {
    system.solve(mode);
    mode /= mode.norm();
  }
  return mode;
}

Result<State> settle(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& mode,
                     const Watch& watch) {
  const double push = 0.5 / largest_column(mode);  // mm: far above round-off, far below a cell
  const auto pushed = [&](double side) {
    return State{unstable.x + side * push * mode, unstable.force};
  };
  const auto energy = [&](const State& state) {
    return energies_of(system.model(), state.x).total() +
           load_energy(system.model(), state.x, system.load_factor());
  };
  Result<State> best = fail(Fault::no_equilibrium, "no rest found beside an unstable state");
  double lowest = 0;
  for (double side : {1.0, -1.0}) {
    State state = pushed(side);
    const NewtonReport report = minimise(system, state, {}, watch);
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for a rest");
    if (report.outcome != NewtonOutcome::converged) continue;
    // of two mirror images it is always the same one, whatever round-off says
    const double found = energy(state);
    if (best && found > lowest - 1e-6 * std::abs(lowest)) continue;
    lowest = found;
    best = std::move(state);
  }
  return best;
}

Result<State> leave_branch(Linearisation& system, const PinnedMotion& motion, const PathPoint& last,
                           double beyond, const Watch& watch) {
  system.set_load(motion.load(last.t));
  system.at(last.state, false);
  const Eigen::Matrix3Xd mode = softest_mode(system);
  State state = last.state;
  motion.impose(system, beyond, state.x);
  return settle(system, state, mode, watch);
}

}  // namespace gridshell
