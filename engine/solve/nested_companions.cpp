// How the coarser levels, the companions, follow the finest one: the state of a companion differs
// from the finer state, restricted to its mesh, by a difference that is predicted along the path.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {
namespace {

// largest sum of the weights of an extrapolation, by size: three states one step apart, continued
// by one step, have 7, and so have two states continued by three steps
constexpr double most_weight = 8;

Eigen::VectorXd weights_of(std::span<const MeshDifference> known, double t) {
  std::vector<double> parameters;
  for (const MeshDifference& difference : known) parameters.push_back(difference.t);
  return polynomial_weights(parameters, t);
}

}  // namespace

MeshDifference NestedShell::difference(const Level& level, double t, const State& base,
                                       const State& state) {
  // StateTransfer::carry() makes new frames, and angles are relative to them: only nodes are saved
  MeshDifference found{t, (state.x - base.x).cast<float>(),
                       (state.force - base.force).cast<float>()};
  found.x.rightCols(level.model.columns() - level.model.nodes).setZero();
  return found;
}

bool NestedShell::correct(Level& level, const State& base, State& state, NewtonReport& report,
                          const Watch& watch) {
  NewtonOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.widest_turn = options_.widest_turn;
  options.trusted_mm = options_.tolerance_mm;
  report = newton(*level.system, state, options, watch);
  if (report.outcome != Outcome::reached) return false;
  // a companion that moves a node by half a cell went to another state
  const int nodes = level.model.nodes;
  return max_column_norm(state.x.leftCols(nodes) - base.x.leftCols(nodes)) <
         0.5 * options_.spacing_mm;
}

/// Prediction of a companion's state at t: `base` and the difference, extrapolated along the path
/// by the polynomial through the last states; through fewer of them if the weights of the
/// polynomial sum to more than `most_weight`.
State NestedShell::predicted(const Level& level, double t, const State& base) const {
  // the last states without a gap
  std::span<const MeshDifference> known = level.differences;
  while (!known.empty() && !known.back().known()) known = known.first(known.size() - 1);
  for (std::size_t k = known.size(); k-- > 0;) {
    if (known[k].known()) continue;
    known = known.subspan(k + 1);
    break;
  }
  if (known.empty()) return base;
  Eigen::VectorXd weights = weights_of(known, t);
  while (known.size() > 1 && !(weights.cwiseAbs().sum() < most_weight)) {
    known = known.subspan(1);
    weights = weights_of(known, t);
  }
  State state = base;
  Eigen::Matrix3Xd x = base.x;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const double weight = weights[Eigen::Index(k)];
    x += weight * known[k].x.cast<double>();
    state.force += weight * known[k].force.cast<double>();
  }
  move_to(level.model, x, state);
  return state;
}

/// With contact modelled: the companion's last state, moved towards the requested one as far as
/// rods do not pass through one another. On the companion's longer edges rods of the requested
/// state may intersect.
State NestedShell::clear_of_contact(Level& level, const State& before, State requested) const {
  if (!level.model.contact.any() || before.x.cols() != requested.x.cols()) return requested;
  State clear = before;
  level.motion.impose(*level.system, state_.t, clear);
  const Eigen::Matrix3Xd move = requested.x - clear.x;
  move_to(level.model, clear.x + level.system->clear_fraction(clear, move) * move, clear);
  return clear;
}

/// Solves for a companion's equilibrium near the finer state, whose restriction is `base`. Newton's
/// method starts from the predicted state, if one is known, then from the restriction, and at the
/// first state of a path then from where a descent of the energy ends. A companion may be unstable
/// where the finer mesh is stable, as coarse meshes lose stability earlier. Returns false if no
/// equilibrium was found.
bool NestedShell::measure_on(std::size_t k, const State& base, const NestedState& before,
                             const Watch& watch) {
  enum class From { difference, restricted, down };
  Level& level = *levels_[k];
  const bool known = std::ranges::any_of(level.differences, &MeshDifference::known);
  for (const From from : {From::difference, From::restricted, From::down}) {
    if (from == From::difference && !known) continue;
    // the descent takes long: it is tried only at the first state of a path
    if (from == From::down && !level.differences.empty()) continue;
    State trial = from == From::difference ? predicted(level, state_.t, base) : base;
    if (k < before.levels.size())
      trial = clear_of_contact(level, before.levels[k], std::move(trial));
    level.motion.impose(*level.system, state_.t, trial);
    if (from == From::down) minimise(*level.system, trial, {.most_iterations = 60}, watch);
    NewtonReport report;
    if (watch.cancelled()) return false;
    if (!correct(level, base, trial, report, watch)) continue;
    // a rod that turns freely about the line through its ends takes its angle from the finer mesh:
    // the difference of the angles is no error
    if (!level.turning.empty()) {
      State turned = trial;
      if (turn_towards(base.x, level.turning, level.model, turned) > options_.tolerance_mm &&
          correct(level, base, turned, report, watch))
        trial = std::move(turned);
    }
    // its remaining residual would be a part of the differences between the meshes
    polish(level, trial, report);
    state_.levels[k] = std::move(trial);
    return true;
  }
  return false;
}

/// Solves the companions, finer ones first, until one has no equilibrium near the finer state.
void NestedShell::measure(const Watch& watch, const NestedState& before) {
  const bool constrained = !system().constraints().empty();
  std::vector<ConstraintForces> forces;
  if (constrained) forces.push_back(constraint_forces(*levels_.back(), state_.levels.back()));
  state_.measured = last();
  for (auto k = std::size_t(last()); k-- > 0;) {
    Level& level = *levels_[k];
    State base = level.from_finer->carry(state_.levels[k + 1]);
    level.motion.impose(*level.system, state_.t, base);
    MeshDifference found{state_.t};
    if (state_.measured == int(k) + 1 && measure_on(k, base, before, watch)) {
      state_.measured = int(k);
      found = difference(level, state_.t, base, state_.levels[k]);
      if (constrained && first_of_last_three() == int(k))
        forces.insert(forces.begin(), constraint_forces(level, state_.levels[k]));
    } else {
      state_.levels[k] = std::move(base);
    }
    level.differences.push_back(std::move(found));
    if (level.differences.size() > 3) level.differences.erase(level.differences.begin());
  }
  if (constrained) take_reactions(forces);
}

}  // namespace gridshell
