#include "engine/solve/arc_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridshell {

namespace {

constexpr int most_corrections = 8;

}  // namespace

ArcFollower::ArcFollower(Linearisation& system, const PinnedMotion& motion,
                         const ArcOptions& options)
    : system_(&system), motion_(motion), options_(options), step_mm_(options.step_mm) {}

double ArcFollower::product(const State& a, double at, const State& b, double bt) const {
  return (a.x.array() * b.x.array()).sum() / double(a.x.cols()) +
         options_.parameter_mm * options_.parameter_mm * at * bt;
}

/// Computes the unit tangent at a point that was just factorised. Its direction is that of the
/// tangent `before`, `before_t`, or, without `before`, the sign of `before_t` along the parameter.
void ArcFollower::take_tangent(ArcPoint& at, const State* before, double before_t) {
  PathPoint& point = at.point;
  motion_.velocity(*system_, point.t, point.state, point.velocity);
  double length = std::sqrt(product(point.velocity, 1, point.velocity, 1));
  const double along = before ? product(point.velocity, 1, *before, before_t) : before_t;
  if (along < 0) length = -length;
  point.velocity.x /= length;
  point.velocity.force /= length;
  turn_t_ = 1 / length;
}

Outcome ArcFollower::start(double t, State state, double direction, const Watch& watch) {
  now_.point.t = t;
  now_.point.state = std::move(state);
  motion_.impose(*system_, t, now_.point.state);
  NewtonOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  const NewtonReport report = newton(*system_, now_.point.state, options, watch);
  if (report.outcome != Outcome::reached) return report.outcome;
  now_.inertia = system_->at(now_.point.state);
  if (!now_.inertia.usable) return Outcome::not_finite;
  take_tangent(now_, nullptr, direction);
  return Outcome::reached;
}

/// Corrects positions and parameter by Newton's method, perpendicular to the tangent at the current
/// point.
bool ArcFollower::corrected(ArcPoint& next, int& iterations, const Watch& watch) {
  PathPoint& point = next.point;
  const State& tangent = now_.point.velocity;
  Eigen::Matrix3Xd dx;
  State with_t;
  for (iterations = 1; iterations <= most_corrections; ++iterations) {
    if (watch.cancelled()) return false;
    motion_.impose(*system_, point.t, point.state);
    next.inertia = system_->at(point.state);
    if (!next.inertia.usable) return false;
    system_->correction(dx);
    motion_.velocity(*system_, point.t, point.state, with_t);
    const State at_fixed_t{dx, {}};
    const double dt =
        -product(at_fixed_t, 0, tangent, turn_t_) / product(with_t, 1, tangent, turn_t_);
    dx += dt * with_t.x;
    const double move = max_column_norm(dx);
    if (!std::isfinite(move) || move > 4 * options_.largest_mm) return false;
    system_->apply(dx, point.state);
    point.t += dt;
    if (move <= options_.tolerance_mm) return true;
  }
  return false;
}

Outcome ArcFollower::step(const Watch& watch) {
  for (; step_mm_ > 0 && step_mm_ >= options_.smallest_mm; step_mm_ /= 2) {
    ArcPoint next;
    next.point.t = now_.point.t + step_mm_ * turn_t_;
    next.point.state = now_.point.state;
    next.point.state.force += step_mm_ * now_.point.velocity.force;
    move_to(system_->model(), now_.point.state.x + step_mm_ * now_.point.velocity.x,
            next.point.state);
    int iterations = 0;
    if (!corrected(next, iterations, watch) ||
        system_->clear_fraction(now_.point.state, next.point.state.x - now_.point.state.x) < 1) {
      if (watch.cancelled()) return Outcome::cancelled;
      continue;
    }
    const State before = std::move(now_.point.velocity);
    const double before_t = turn_t_;
    take_tangent(next, &before, before_t);
    now_ = std::move(next);
    // a step of suitable length takes four corrections
    step_mm_ = std::min(options_.largest_mm, step_mm_ * std::clamp(4.0 / iterations, 0.5, 1.5));
    return Outcome::reached;
  }
  return Outcome::lost;
}

Outcome ArcFollower::leave(const PathPoint& from, const Eigen::Matrix3Xd& mode, double mm,
                           const Watch& watch) {
  now_.point = from;
  motion_.impose(*system_, from.t, now_.point.state);
  if (!system_->at(now_.point.state).usable) return Outcome::not_finite;
  State& along = now_.point.velocity;
  along = State{mode, system_->force_change(mode)};
  const double length = std::sqrt(product(along, 0, along, 0));
  along.x /= length;
  along.force /= length;
  turn_t_ = 0;
  step_mm_ = mm;
  return step(watch);
}

std::optional<double> turning_point(Linearisation& system, const PinnedMotion& motion,
                                    const PathPoint& begin, double direction,
                                    const ArcOptions& options, const Watch& watch) {
  constexpr int most_steps = 40;
  ArcFollower path(system, motion, options);
  if (path.start(begin.t, begin.state, direction, watch) != Outcome::reached) return std::nullopt;
  double farthest = begin.t;
  for (int k = 0; k < most_steps; ++k) {
    if (path.step(watch) != Outcome::reached) return std::nullopt;
    const double t = path.at().point.t;
    if (direction * (t - farthest) < 0) return farthest;
    farthest = t;
  }
  return std::nullopt;
}

}  // namespace gridshell
