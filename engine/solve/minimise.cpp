#include "engine/solve/minimise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell {
namespace {

/// The way down: what changes between its steps.
class Descent {
 public:
  Descent(Linearisation& system, State& state, const MinimiseOptions& options, const Watch& watch)
      : system_(system), state_(state), options_(options), watch_(watch) {
    system.stop_at_negative(system.holds().empty());
    for (const ModelEdge& edge : system.model().edges)
      near_mm_ += 0.1 * edge.rest_length / double(system.model().edges.size());
  }

  ~Descent() { system_.stop_at_negative(false); }
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;

  /// Factorises the mixed form at the state, or what is near it and positive definite.
  Inertia factorise(double last_move_mm) {
    return options_.rough ? from_what_served(last_move_mm) : from_the_form_itself();
  }

  /// Whether the last matrix was the mixed form as it is.
  bool exact() const { return weakening_ == 0 && shift_ == 0; }

  /// As far along dx as the energy falls.
  void go(const Eigen::Matrix3Xd& dx) {
    const double begin = energy_at(state_), slope = product(system_.assembly().gradient, dx);
    const Eigen::VectorXd force = system_.assembly().force, change = system_.force_change(dx);
    const auto falls = [&](double step) {
      return energy_at(trial_) <= begin + 1e-4 * step * slope + 1e-14 * std::abs(begin);
    };
    double step = 1;
    for (; step > 1e-10; step /= 2) {
      trial_ = state_;
      move_to(system_.model(), state_.x + step * dx, trial_);
      if (falls(step)) break;
      system_.restore_lengths(force + step * change, trial_);
      if (falls(step)) break;
    }
    std::swap(state_, trial_);
    state_.force = force + step * change;
  }

 private:
  static constexpr double least_weakening = 0.015, least_shift = 1e-4;  // of 1, N/mm

  /// The form as it is comes first at every step.
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

  /// Tries a little less shift or weakening than served last; after a failure it keeps to that for
  /// some steps.
  Inertia from_what_served(double last_move_mm) {
    const double served = weakening_;
    if (shift_ > 0)
      shift_ = shift_ > least_shift ? shift_ / 8 : 0;
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
      shift_ = std::max(4 * shift_, least);
      inertia = system_.shifted(shift_);
    } while (!inertia.positive_definite() && shift_ < 1e8 && !watch_.cancelled());
    return inertia;
  }

  Inertia assemble() {
    State weakened = state_;
    weakened.force = state_.force.cwiseMax((1 - weakening_) * state_.force);
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

/// Whether the energy's Hessian is positive definite, but for round-off: a rod between two pins may
/// turn about their line without any force.
bool is_minimum(Linearisation& system, const State& state, double EA_scale) {
  constexpr double round_off = 1e-12;
  const double largest = system.at(state, false, 0, EA_scale).largest_pivot;
  return system.shifted(round_off * largest).positive_definite();
}

}  // namespace

NewtonReport minimise(Linearisation& system, State& state, const MinimiseOptions& options,
                      const Watch& watch) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  Descent descent(system, state, options, watch);
  double move = std::numeric_limits<double>::infinity();
  for (report.iterations = 1; report.iterations <= options.most_iterations; ++report.iterations) {
    if (watch.cancelled()) {
      report.outcome = Outcome::cancelled;
      return report;
    }
    report.inertia = descent.factorise(move);
    ++system.effort().newton_iterations;
    const bool usable = report.inertia.positive_definite();
    if (usable) system.correction(dx);
    move = usable ? largest_column(dx) : std::numeric_limits<double>::infinity();
    if (!std::isfinite(move)) {
      report.outcome = watch.cancelled() ? Outcome::cancelled : Outcome::not_finite;
      return report;
    }
    if (report.iterations == 1) report.first_move_mm = move;
    report.last_move_mm = move;
    if (move > options.tolerance_mm) {
      descent.go(dx);
      continue;
    }
    system.apply(dx, state);
    if (descent.exact() || is_minimum(system, state, options.EA_scale))
      report.outcome = Outcome::reached;
    return report;
  }
  return report;
}

}  // namespace gridshell
