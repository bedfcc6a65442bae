#include "engine/solve/rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/solve/drift.h"
#include "engine/solve/minimise.h"

namespace gridshell {

Eigen::Matrix3Xd any_direction(Eigen::Index columns) {
  Eigen::Matrix3Xd any(3, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double column = double(k);
    any.col(k) << std::sin(0.7 + 1.3 * column), std::sin(1.9 + 2.1 * column),
        1 + std::sin(2.3 + 0.9 * column);
  }
  return any / std::sqrt(6.0);
}

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

State pushed(const Model& model, const State& state, const Eigen::Matrix3Xd& by) {
  State moved = state;
  move_to(model, state.x + by, moved);
  return moved;
}

/// Whether one way down is enough, as the other is known from it.
bool sides_are_one(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& push,
                   const Departure& departure) {
  if (departure.side != Leave::lower) return false;
  const Model& model = system.model();
  const State along = pushed(model, unstable, push), against = pushed(model, unstable, -push);
  const auto slope_at = [&](const State& state) {
    system.gradient_at(state);
    return system.assembly().gradient;
  };
  const Eigen::Matrix3Xd slope = slope_at(along);
  // beside a state that is no equilibrium, as beyond a fold, the slope leads to one side from both
  const double here = product(slope, push), there = product(slope_at(against), push);
  if (std::abs(here - there) < 0.1 * std::abs(here + there)) return true;

  // a symmetry that takes one side to the other and, of all that the energy is made of (rods,
  // loads, field), the slope there with it
  constexpr double same_mm = 1e-5, same_slope = 1e-6;
  const int nodes = model.nodes;
  if (model.has_spins() || !system.holds().empty()) return false;
  return std::ranges::any_of(departure.symmetries, [&](const MeshSymmetry& symmetry) {
    if (distance_under(symmetry, against.x, along.x.leftCols(nodes)) > same_mm) return false;
    State image = against;
    image.x.leftCols(nodes) = symmetry.of(along.x.leftCols(nodes));
    MeshSymmetry turn = symmetry;
    turn.centre.setZero();
    return distance_under(turn, slope_at(image), slope.leftCols(nodes)) <=
           same_slope * largest_column(slope);
  });
}

/// To rest from beside an unstable state, pushed `along`, whose largest column is 1.
std::optional<State> rest_beside(Linearisation& system, const State& unstable,
                                 const Eigen::Matrix3Xd& along, const Departure& departure,
                                 const Watch& watch) {
  constexpr double most_mm = 1;
  for (double push = departure.amplitude_mm; push <= most_mm && !watch.cancelled(); push *= 4) {
    State state = pushed(system.model(), unstable, push * along);
    if (drift(system, state, departure.step_mm, watch) != Outcome::reached) continue;
    if (minimise(system, state, {}, watch).outcome == Outcome::reached) return state;
  }
  return std::nullopt;
}

}  // namespace

Result<State> settle(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& mode,
                     const Departure& departure, const Watch& watch) {
  const Eigen::Matrix3Xd unit = mode / largest_column(mode);
  const bool one = sides_are_one(system, unstable, departure.amplitude_mm * unit, departure);
  Result<State> best = fail(Fault::no_equilibrium, "no rest found beside an unstable state");
  double lowest = 0;
  for (double way : {1.0, -1.0}) {
    if (departure.side == (way > 0 ? Leave::against : Leave::along)) continue;
    auto state = rest_beside(system, unstable, way * unit, departure, watch);
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for a rest");
    if (!state) continue;
    if (one) return *state;
    // of two mirror images it is always the same one, whatever round-off says
    const double found = system.energy_at(*state);
    if (best && found > lowest - 1e-6 * std::abs(lowest)) continue;
    lowest = found;
    best = std::move(*state);
  }
  return best;
}

}  // namespace gridshell
