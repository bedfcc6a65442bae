#include "engine/solve/drift.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gridshell {
namespace {

constexpr int most_steps = 1000;
constexpr double smallest_shift = 1e-9, largest_shift = 1e8;  // N/mm

/// What shifts are changed by: twofold at first, then the square of the last, until reset.
class Stride {
 public:
  explicit Stride(double most) : most_(most) {}
  double next() { return std::exchange(factor_, std::min(factor_ * factor_, most_)); }
  void reset() { factor_ = 2; }

 private:
  double most_, factor_ = 2;
};

/// The way down: what changes between its steps.
class Drift {
 public:
  Drift(Linearisation& system, State& state, double step_mm, const Watch& watch)
      : system_(system), state_(state), step_mm_(step_mm), watch_(watch) {
    system.stop_at_negative(system.holds().empty());
  }
  ~Drift() { system_.stop_at_negative(false); }
  Drift(const Drift&) = delete;
  Drift& operator=(const Drift&) = delete;

  /// One step; true if it was Newton's own and short. Nothing: no shift serves.
  std::optional<bool> step() {
    bool at_once = true;
    Stride up{16};
    for (Inertia inertia = system_.at(state_, true, shift_);; inertia = system_.shifted(shift_)) {
      if (inertia.positive_definite()) {
        system_.correction(dx_);
        const double move = largest_column(dx_);
        if (!std::isfinite(move)) return std::nullopt;
        if (move <= longest * step_mm_) return go(std::min(1.0, step_mm_ / move), at_once);
      }
      at_once = false;
      shift_ = std::max(up.next() * shift_, smallest_shift);
      if (shift_ > largest_shift || watch_.cancelled()) return std::nullopt;
    }
  }

 private:
  // in steps: what is longer is corrected anew with more shift; a rest is within so much
  static constexpr double longest = 2, near = 0.1;

  bool go(double share, bool at_once) {
    ++system_.effort().newton_iterations;
    const Eigen::VectorXd force = state_.force;
    system_.apply(share * dx_, state_);
    // of an unknown of its own a part of the step is a part of its change
    state_.force += (1 - share) * (force - system_.assembly().force);
    const bool newton = shift_ == 0 && largest_column(dx_) < near * step_mm_;
    // less and less shift as long as that goes well
    if (at_once && share == 1) {
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
  Stride down_{256};
  Eigen::Matrix3Xd dx_;
};

}  // namespace

Outcome drift(Linearisation& system, State& state, double step_mm, const Watch& watch) {
  Drift drift(system, state, step_mm, watch);
  for (int step = 0; step < most_steps; ++step) {
    if (watch.cancelled()) return Outcome::cancelled;
    const std::optional<bool> arrived = drift.step();
    if (!arrived) return watch.cancelled() ? Outcome::cancelled : Outcome::not_finite;
    if (*arrived) return Outcome::reached;
  }
  return Outcome::not_converged;
}

}  // namespace gridshell
