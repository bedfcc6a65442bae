#include "engine/solve/rest.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/solve/drift.h"
#include "engine/solve/minimise.h"

namespace gridshell {

namespace {

/// A direction with a part along any mode: no symmetry of the net leaves it unchanged.
Eigen::Matrix3Xd any_direction(Eigen::Index columns) {
  Eigen::Matrix3Xd any(3, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double column = double(k);
    any.col(k) << std::sin(0.7 + 1.3 * column), std::sin(1.9 + 2.1 * column),
        1 + std::sin(2.3 + 0.9 * column);
  }
  return any;
}

}  // namespace

Eigen::Matrix3Xd softest_mode(Linearisation& system, const Eigen::Matrix3Xd& start,
                              const Watch& watch) {
  double shift = 1e-6;
  while (!system.shifted(shift).positive_definite() && shift < 1e6 && !watch.cancelled())
    shift *= 4;
  Eigen::Matrix3Xd mode = start.size() > 0 ? start : any_direction(system.model().columns());
  for (int k = 0; k < 20; ++k) {
    system.solve(mode);
    mode /= mode.norm();
  }
  return mode;
}

Result<State> rest_below(Linearisation& system, State state, const Watch& watch,
                         const Departure& departure) {
  const NewtonReport down = minimise(system, state, {}, watch);
  if (down.outcome == Outcome::reached) return state;
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for an equilibrium");
  // nothing moves any more, but a mode without stiffness keeps it from being a minimum
  if (down.outcome == Outcome::not_converged && down.last_move_mm < 1e-3) {
    system.at(state, false);
    return settle(system, state, softest_mode(system, departure.start, watch), departure, watch);
  }
  return fail(Fault::no_equilibrium,
              fmt::format("no equilibrium after {} iterations; the last moved a node by {:.2g} mm",
                          down.iterations, down.last_move_mm));
}

Result<State> rest_near(Linearisation& system, const State& state, double farthest_mm,
                        const Watch& watch) {
  State found = state;
  NewtonOptions options;
  options.farthest_mm = farthest_mm;
  options.tolerance_mm = 1e-7;
  const NewtonReport report = newton(system, found, options, watch);
  if (report.outcome == Outcome::reached && system.at(found, false).positive_definite())
    return found;
  return rest_below(system, state, watch);
}

namespace {

/// To rest from beside an unstable state, pushed `along`, whose largest column is 1.
std::optional<State> rest_beside(Linearisation& system, const State& unstable,
                                 const Eigen::Matrix3Xd& along, const Departure& departure,
                                 const Watch& watch) {
  constexpr double most_mm = 1;
  for (double push = departure.amplitude_mm; push <= most_mm && !watch.cancelled(); push *= 4) {
    State state = unstable;
    move_to(system.model(), unstable.x + push * along, state);
    if (drift(system, state, departure.step_mm, watch) != Outcome::reached) continue;
    if (minimise(system, state, {}, watch).outcome == Outcome::reached) return state;
  }
  return std::nullopt;
}

}  // namespace

Result<State> settle(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& mode,
                     const Departure& departure, const Watch& watch) {
  const Eigen::Matrix3Xd unit = mode / largest_column(mode);
  Result<State> best = fail(Fault::no_equilibrium, "no rest found beside an unstable state");
  double lowest = 0;
  for (double way : {1.0, -1.0}) {
    if (departure.side == (way > 0 ? Leave::against : Leave::along)) continue;
    auto state = rest_beside(system, unstable, way * unit, departure, watch);
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for a rest");
    if (!state) continue;
    // of two mirror images it is always the same one, whatever round-off says
    const double found = system.energy_at(*state);
    if (best && found > lowest - 1e-6 * std::abs(lowest)) continue;
    lowest = found;
    best = std::move(*state);
  }
  return best;
}

}  // namespace gridshell
