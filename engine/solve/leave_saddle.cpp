// Descent from an unstable state along its lowest mode to the equilibrium near it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {

Eigen::Matrix3Xd generic_direction(Eigen::Index columns) {
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
  Eigen::Matrix3Xd mode = start.size() > 0 ? start : generic_direction(system.model().columns());
  for (int k = 0; k < 20; ++k) {
    system.solve(mode);
    mode /= mode.norm();
  }
  return mode;
}

namespace {

State pushed(const Model& model, const State& state, const Eigen::Matrix3Xd& by) {
  State moved = state;
  move_to(model, state.x + clear_fraction(model, state.x, by) * by, moved);
  return moved;
}

/// Whether one descent is enough: the other would end in the same state or in its mirror image.
bool sides_equivalent(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& push,
                      const BranchSwitch& departure) {
  if (departure.side != BranchSide::lower) return false;
  const Model& model = system.model();
  const State along = pushed(model, unstable, push), against = pushed(model, unstable, -push);
  const auto slope_at = [&](const State& state) {
    system.gradient_at(state);
    return system.assembly().gradient;
  };
  const Eigen::Matrix3Xd slope = slope_at(along);
  // near a state that is no equilibrium, as past a fold, both sides may descend in the same
  // direction
  const double here = product(slope, push), there = product(slope_at(against), push);
  if (std::abs(here - there) < 0.1 * std::abs(here + there)) return true;

  // a symmetry must map one side to the other and the gradients, too, hence all that the energy
  // consists of (rods, loads, applied load)
  constexpr double same_mm = 1e-5, same_slope = 1e-6;
  const int nodes = model.nodes;
  if (model.has_spins() || !system.constraints().empty()) return false;
  return std::ranges::any_of(departure.symmetries, [&](const MeshSymmetry& symmetry) {
    if (distance_under(symmetry, against.x, along.x.leftCols(nodes)) > same_mm) return false;
    State image = against;
    image.x.leftCols(nodes) = symmetry.of(along.x.leftCols(nodes));
    MeshSymmetry turn = symmetry;
    turn.centre.setZero();
    return distance_under(turn, slope_at(image), slope.leftCols(nodes)) <=
           same_slope * max_column_norm(slope);
  });
}

/// Nodes of the states that a descent passes, in order; single precision distinguishes them well
/// enough.
using WayDown = std::vector<Eigen::Matrix3Xf>;

/// Whether a descent that has reached `x` meets the descent `other`: is within `near_mm` of the
/// line between two of its successive states. `at` is the index of the first of the two; it only
/// increases from call to call, since both descend.
bool comes_upon(const WayDown& other, const Eigen::Matrix3Xd& x, double near_mm, std::size_t& at) {
  for (; at + 1 < other.size(); ++at) {
    const Eigen::Matrix3Xf along = other[at + 1] - other[at], from = x.cast<float>() - other[at];
    const float fraction = from.cwiseProduct(along).sum() / along.squaredNorm();
    if (fraction > 1) continue;
    return fraction >= 0 && (from - fraction * along).colwise().norm().maxCoeff() < near_mm;
  }
  return false;
}

/// The equilibrium reached from an unstable state perturbed along `along`, whose largest column is
/// 1; empty if there is none. `passed` stores the descent, which ends where it meets `other` (null:
/// nowhere).
std::optional<State> equilibrium_near(Linearisation& system, const State& unstable,
                                      const Eigen::Matrix3Xd& along, const BranchSwitch& departure,
                                      WayDown* passed, const WayDown* other, const Watch& watch) {
  const double near_mm = 0.02 * departure.step_mm,
               most_mm = std::max(2 * departure.step_mm, departure.amplitude_mm);
  for (double push = departure.amplitude_mm; push <= most_mm && !watch.cancelled(); push *= 4) {
    State state = pushed(system.model(), unstable, push * along);
    if (passed) *passed = {state.x.cast<float>()};
    std::size_t at = 0;
    bool met = false;
    const auto seen = [&](const State& now) {
      if (passed) passed->push_back(now.x.cast<float>());
      return met = other && comes_upon(*other, now.x, near_mm, at);
    };
    if (gradient_flow(system, state, departure.step_mm, watch, seen) != Outcome::reached) continue;
    if (met) break;
    if (minimise(system, state, {}, watch).outcome == Outcome::reached) return state;
  }
  return std::nullopt;
}

}  // namespace

Result<State> leave_saddle(Linearisation& system, const State& unstable,
                           const Eigen::Matrix3Xd& mode, const BranchSwitch& departure,
                           const Watch& watch) {
  const Eigen::Matrix3Xd unit = mode / max_column_norm(mode);
  const bool one = sides_equivalent(system, unstable, departure.amplitude_mm * unit, departure);
  Result<State> best = fail(Fault::no_equilibrium, "no equilibrium found near an unstable state");
  double lowest = 0;
  const bool both = departure.side == BranchSide::lower && !one;
  WayDown first;
  for (double sign : {1.0, -1.0}) {
    if (departure.side == (sign > 0 ? BranchSide::against : BranchSide::along)) continue;
    const bool second = best.has_value();
    auto state =
        equilibrium_near(system, unstable, sign * unit, departure,
                         both && !second ? &first : nullptr, second ? &first : nullptr, watch);
    if (watch.cancelled())
      return fail(Fault::cancelled, "stopped while searching for an equilibrium");
    if (!state) continue;
    if (one) return *state;
    // the choice between two mirror images must not depend on round-off
    const double found = system.energy_at(*state);
    if (best && found > lowest - 1e-6 * std::abs(lowest)) continue;
    lowest = found;
    best = std::move(*state);
  }
  return best;
}

}  // namespace gridshell
