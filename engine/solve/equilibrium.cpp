#include "engine/solve/equilibrium.h"
#include "engine/elastic/model.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace gridshell {
namespace {

constexpr int most_steps = 1000;
constexpr double smallest_shift = 1e-9, largest_shift = 1e8;  // N/mm, times ShellScale::stiffness

/// Factors by which the shift changes: first 2, then each the square of the last, at most `most`,
/// until reset.
class ShiftGrowth {
 public:
  explicit ShiftGrowth(double most) : most_(most) {}
  double next() { return std::exchange(factor_, std::min(factor_ * factor_, most_)); }
  void reset() { factor_ = 2; }

 private:
  double most_, factor_ = 2;
};

/// Steepest descent of the energy: the variables of its iteration.
class GradientFlow {
 public:
  GradientFlow(Linearisation& system, State& state, double step_mm, const Watch& watch)
      : system_(system), state_(state), step_mm_(step_mm), watch_(watch) {
    system.stop_at_negative(system.constraints().empty());
  }
  ~GradientFlow() { system_.stop_at_negative(false); }
  GradientFlow(const GradientFlow&) = delete;
  GradientFlow& operator=(const GradientFlow&) = delete;

  /// Takes one step. Returns whether it was a short step without shift; empty if no shift gives a
  /// step.
  std::optional<bool> step() {
    bool at_once = true;
    ShiftGrowth up{16};
    for (Inertia inertia = system_.at(state_, true, shift_);; inertia = system_.shifted(shift_)) {
      if (inertia.positive_definite()) {
        system_.correction(dx_);
        const double move = max_column_norm(dx_);
        if (!std::isfinite(move)) return std::nullopt;
        if (move <= longest * step_mm_) return go(std::min(1.0, step_mm_ / move), at_once);
      }
      at_once = false;
      shift_ = std::max(up.next() * shift_, smallest_shift * system_.scale.stiffness);
      if (shift_ > largest_shift * system_.scale.stiffness || watch_.cancelled())
        return std::nullopt;
    }
  }

 private:
  // over step_mm_: a correction above `longest` is computed again with a larger shift; one below
  // `near` shows that an equilibrium is near
  static constexpr double longest = 2, near = 0.1;

  bool go(double fraction, bool at_once) {
    ++system_.effort().newton_iterations;
    fraction = std::min(fraction, system_.clear_fraction(state_, dx_));
    system_.apply(dx_, state_, fraction);
    const bool newton = shift_ == 0 && max_column_norm(dx_) < near * step_mm_;
    // the shift decreases as long as steps succeed at once
    if (at_once && fraction == 1) {
      shift_ /= down_.next();
      if (shift_ < smallest_shift) shift_ = 0;
    } else {
      down_.reset();
    }
    return newton;
  }

  Linearisation& system_;
  State& state_;
  const double step_mm_;
  const Watch& watch_;
  double shift_ = 0;
  ShiftGrowth down_{256};
  Eigen::Matrix3Xd dx_;
};

}  // namespace

Outcome gradient_flow(Linearisation& system, State& state, double step_mm, const Watch& watch,
                      const std::function<bool(const State&)>& seen) {
  GradientFlow flow(system, state, step_mm, watch);
  for (int step = 0; step < most_steps; ++step) {
    if (watch.cancelled()) return Outcome::cancelled;
    const std::optional<bool> arrived = flow.step();
    if (!arrived) return watch.cancelled() ? Outcome::cancelled : Outcome::not_finite;
    if (*arrived || (seen && seen(state))) return Outcome::reached;
  }
  return Outcome::not_converged;
}

namespace {

/// Newton's minimisation: the variables of its iteration.
class Descent {
 public:
  Descent(Linearisation& system, State& state, const MinimiseOptions& options, const Watch& watch)
      : system_(system), state_(state), options_(options), watch_(watch) {
    system.stop_at_negative(system.constraints().empty());
    for (const ModelEdge& edge : system.model().edges)
      near_mm_ += 0.1 * edge.rest_length / double(system.model().edges.size());
  }

  ~Descent() { system_.stop_at_negative(false); }
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;

  /// Factorises the mixed form at the state, weakened or shifted until it is positive definite.
  Inertia factorise(double last_move_mm) {
    return options_.rough ? from_what_served(last_move_mm) : from_the_form_itself();
  }

  /// Whether the last matrix was the mixed form itself, neither weakened nor shifted.
  bool exact() const { return weakening_ == 0 && shift_ == 0; }

  /// Moves along dx by a step at which the energy decreases. Returns false if contact allows none.
  bool go(const Eigen::Matrix3Xd& dx) {
    const double begin = energy_at(state_), slope = product(system_.assembly().gradient, dx);
    const Eigen::VectorXd force = system_.assembly().force, change = system_.force_change(dx);
    const auto falls = [&](double step) {
      return energy_at(trial_) <= begin + 1e-4 * step * slope + 1e-14 * std::abs(begin);
    };
    const auto clear = [&] {  // restoring lengths has moved nodes in other directions than dx
      return system_.clear_fraction(state_, trial_.x - state_.x) == 1;
    };
    double step = system_.clear_fraction(state_, dx);
    if (!(step > 1e-10)) return false;
    for (; step > 1e-10; step /= 2) {
      trial_ = state_;
      move_to(system_.model(), state_.x + step * dx, trial_);
      if (falls(step)) break;
      system_.restore_lengths(force + step * change, trial_);
      if (falls(step) && clear()) break;
    }
    if (!(step > 1e-10)) {  // none: the trial may have passed rods through one another
      trial_ = state_;
      move_to(system_.model(), state_.x + step * dx, trial_);
    }
    std::swap(state_, trial_);
    state_.force = force + step * change;
    return true;
  }

 private:
  static constexpr double least_weakening = 0.015, least_shift = 1e-4;  // fraction; N/mm, scaled

  /// Every step tries no shift and a quarter of the last weakening first, then more weakening, then
  /// a shift.
  Inertia from_the_form_itself() {
    const double shift = shift_ / 4;
    shift_ = 0;
    weakening_ = weakening_ < 0.01 ? 0 : weakening_ / 4;
    for (;;) {
      const Inertia inertia = assemble();
      if (inertia.positive_definite()) return inertia;
      if (weakening_ >= 1 || watch_.cancelled()) break;
      weakening_ = weakening_ == 0 ? 0.1 : 1.0;
    }
    shift_ = shift;
    return shifted(1e-6);
  }

  /// Tries less shift or weakening than the last step used; after a failure the weakening of the
  /// last step is used for some steps.
  Inertia from_what_served(double last_move_mm) {
    const double served = weakening_;
    if (shift_ > 0)
      shift_ = shift_ > least_shift * system_.scale.stiffness ? shift_ / 8 : 0;
    else if (--wait_ <= 0 || last_move_mm < near_mm_)
      weakening_ = weakening_ > least_weakening ? weakening_ / 4 : 0;
    Inertia inertia = assemble();
    if (inertia.positive_definite()) {
      if (weakening_ < served) patience_ = 1;
      return inertia;
    }
    if (weakening_ < served) wait_ = patience_ = std::min(2 * patience_, 8);
    while (weakening_ < 1) {
      const double more = std::clamp(4 * weakening_, 4 * least_weakening, 1.0);
      weakening_ = weakening_ < served ? served : more;
      inertia = assemble();
      if (inertia.positive_definite() || watch_.cancelled()) return inertia;
    }
    return shifted(least_shift);
  }

  /// Multiplies the last shift by four until the matrix is positive definite.
  Inertia shifted(double least) {
    Inertia inertia;
    do {
      shift_ = std::max(4 * shift_, least * system_.scale.stiffness);
      inertia = system_.shifted(shift_);
    } while (!inertia.positive_definite() && shift_ < largest_shift * system_.scale.stiffness &&
             !watch_.cancelled());
    return inertia;
  }

  Inertia assemble() {
    State weakened = state_;
    auto axial = weakened.force.head(Eigen::Index(system_.model().edges.size()));
    axial = axial.cwiseMax((1 - weakening_) * axial).eval();
    return system_.at(weakened, true, shift_, options_.EA_scale);
  }

  double energy_at(const State& state) const {
    Energies energies = energies_of(system_.model(), state, system_.outside);
    energies[Term::stretch] *= options_.EA_scale;
    return energies.total();
  }

  Linearisation& system_;
  State& state_;
  const MinimiseOptions& options_;
  const Watch& watch_;
  State trial_;
  double weakening_ = 0, shift_ = 0;
  int wait_ = 0, patience_ = 1;  // steps before less weakening is tried again
  double near_mm_ = 0;           // corrections below this are near the end
};

/// Whether the energy's Hessian is positive definite up to round-off: a rod between two pins may
/// rotate about the line through them without any force.
bool is_minimum(Linearisation& system, const State& state, double EA_scale) {
  constexpr double round_off = 1e-12;
  const double largest = system.at(state, false, 0, EA_scale).largest_pivot;
  return system.shifted(round_off * largest).positive_definite();
}

/// minimise(), with up to `longest` times the iterations of the options: a rod that winds up takes
/// many short steps, and as long as they pay, more are allowed.
NewtonReport minimise_for(int longest, Linearisation& system, State& state,
                          const MinimiseOptions& options, const Watch& watch) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  Descent descent(system, state, options, watch);
  double move = std::numeric_limits<double>::infinity();
  constexpr double pays = 0.05;  // part of the energy's fall that is in the second half
  double first = 0, half = 0;    // energies at the start and after half of the allowed iterations
  int allowed = options.most_iterations;
  for (report.iterations = 1; report.iterations <= allowed; ++report.iterations) {
    if (watch.cancelled()) {
      report.outcome = Outcome::cancelled;
      return report;
    }
    report.inertia = descent.factorise(move);
    const double energy = system.assembly().energies.total();
    if (report.iterations == 1) first = energy;
    if (report.iterations == allowed / 2) half = energy;
    if (report.iterations == allowed && half - energy > pays * (first - energy) &&
        allowed < longest * options.most_iterations)
      allowed *= 2;
    ++system.effort().newton_iterations;
    const bool usable = report.inertia.positive_definite();
    if (usable) system.correction(dx);
    move = usable ? max_column_norm(dx) : std::numeric_limits<double>::infinity();
    if (!std::isfinite(move)) {
      report.outcome = watch.cancelled() ? Outcome::cancelled : Outcome::not_finite;
      return report;
    }
    if (report.iterations == 1) report.first_move_mm = move;
    report.last_move_mm = move;
    if (move > options.tolerance_mm) {
      if (descent.go(dx)) continue;
      report.outcome = Outcome::lost;
      return report;
    }
    system.apply(dx, state);
    if (!system.assembly().overlap &&
        (descent.exact() || is_minimum(system, state, options.EA_scale)))
      report.outcome = Outcome::reached;
    return report;
  }
  report.iterations = allowed;
  return report;
}

}  // namespace

NewtonReport minimise(Linearisation& system, State& state, const MinimiseOptions& options,
                      const Watch& watch) {
  return minimise_for(1, system, state, options, watch);
}

Result<State> minimise_from(Linearisation& system, State state, const Watch& watch,
                            const BranchSwitch& departure) {
  constexpr int longest = 16;
  const NewtonReport down =
      minimise_for(longest, system, state, {.tolerance_mm = 1e-5 * system.scale.length}, watch);
  if (down.outcome == Outcome::reached) return state;
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped while looking for an equilibrium");
  if (down.outcome == Outcome::lost)
    return fail(Fault::no_equilibrium,
                "no equilibrium can be reached without rods passing through each other");
  // the corrections have converged, but not to a minimum: the state is a saddle
  if (down.outcome == Outcome::not_converged && down.last_move_mm < 1e-3 * system.scale.length) {
    system.at(state, false);
    return leave_saddle(system, state, softest_mode(system, departure.start, watch), departure,
                        watch);
  }
  return fail(Fault::no_equilibrium,
              fmt::format("no equilibrium after {} iterations; the last moved a node by {:.2g} mm",
                          down.iterations, down.last_move_mm));
}

Result<State> find_equilibrium(Linearisation& system, const State& state, double farthest_mm,
                               const Watch& watch, const BranchSwitch& departure) {
  State found = state;
  NewtonOptions options;
  options.farthest_mm = farthest_mm;
  options.tolerance_mm = 1e-7 * system.scale.length;
  const NewtonReport report = newton(system, found, options, watch);
  if (report.outcome == Outcome::reached) {
    if (system.at(found, false).positive_definite()) return found;
    // in a descent from `state` round-off would choose the side of this saddle
    if (departure.start.size() > 0 && !is_minimum(system, found, 1)) {
      auto rest = leave_saddle(system, found, softest_mode(system, departure.start, watch),
                               departure, watch);
      if (rest || watch.cancelled()) return rest;
    }
  }
  return minimise_from(system, state, watch, departure);
}

}  // namespace gridshell
