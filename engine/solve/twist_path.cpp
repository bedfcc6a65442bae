#include "engine/solve/twist_path.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

TwistPath::TwistPath(const TwistModel& model, const PinnedMotion& motion,
                     const PathOptions& options)
    : model_(model), motion_(motion), options_(options), solver_(model) {}

double TwistPath::largest_strain() const {
  double largest = 0;
  for (const TwistEdge& edge : model_.edges) {
    if (edge.EA == 0) continue;
    const double length = (state_.x.col(edge.to) - state_.x.col(edge.from)).norm();
    largest = std::max(largest, std::abs(length / edge.rest_length - 1));
  }
  return largest;
}

void TwistPath::accept(double t, TwistState state, const NewtonReport& report) {
  before_t_ = t_;
  before_velocity_ = velocity_;
  has_before_ = velocity_.size() > 0;
  t_ = t;
  state_ = std::move(state);
  report_ = report;
  velocity_ = solver_.velocity(state_, motion_.velocity(t), motion_.load_velocity(t));
}

bool TwistPath::start(double t, const Eigen::Matrix3Xd& flat, const Eigen::Matrix3Xd& x,
                      const Watch& watch) {
  TwistState state = start_twist_state(model_, flat);
  Eigen::Matrix3Xd there = x;
  const Eigen::Matrix3Xd held = motion_.at(t);
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.fixed[3 * node]) there.col(node) = held.col(node);
  move_to(model_, there, state.angle, state);
  state.load = motion_.load(t);
  return rest(t, std::move(state), watch);
}

/// Comes to rest at t, a path that begins anew there.
bool TwistPath::rest(double t, TwistState state, const Watch& watch) {
  TwistOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.widest_turn = options_.widest_turn;
  const NewtonReport report = solver_.rest(state, options, watch);
  if (report.outcome != NewtonOutcome::converged) return false;
  velocity_.resize(0);
  accept(t, std::move(state), report);
  return true;
}

TwistState TwistPath::predicted(double t) const {
  const double h = t - t_;
  Eigen::VectorXd way = h * velocity_;
  if (has_before_ && t_ != before_t_)
    way += 0.5 * h * h / (t_ - before_t_) * (velocity_ - before_velocity_);
  TwistState state = state_;
  Eigen::Matrix3Xd x = state_.x + Eigen::Map<const Eigen::Matrix3Xd>(way.data(), 3, model_.nodes);
  const Eigen::Matrix3Xd held = motion_.at(t);
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.fixed[3 * node]) x.col(node) = held.col(node);
  move_to(model_, x, state_.angle + way.tail(state_.angle.size()), state);
  state.load = motion_.load(t);
  return state;
}

bool TwistPath::step(double t) {
  TwistState state = predicted(t);
  const Eigen::Matrix3Xd guess = state.x;
  const double allowed =
      std::min(options_.largest_move * options_.spacing_mm,
               0.5 * largest_column(guess - state_.x) + 1e-3 * options_.spacing_mm);
  TwistOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.most_iterations = 25;
  options.saddles = unstable_;
  options.widest_turn = options_.widest_turn;
  const NewtonReport report = solver_.rest(state, options, Watch());
  finite_ = report.outcome != NewtonOutcome::not_finite;
  if (report.outcome != NewtonOutcome::converged) return false;
  const double correction = largest_column(state.x - guess);
  if (correction > allowed) return false;
  accept(t, std::move(state), report);
  // the prediction is off by a term of third order in the step
  const double aim = options_.target_move * options_.spacing_mm;
  const double grow = std::cbrt(aim / std::max(correction, 1e-3 * aim));
  step_ = std::max(std::abs(t_ - before_t_) * std::clamp(grow, 0.4, 2.5), options_.smallest_step);
  return true;
}

TwistPathEnd TwistPath::advance(double t, const Watch& watch) {
  while (t_ != t) {
    if (watch.cancelled()) return TwistPathEnd::cancelled;
    const double left = t - t_;
    double h = std::min({step_, options_.largest_step, std::abs(left)});
    if (h < std::abs(left) && 2 * h > std::abs(left)) h = std::abs(left) / 2;
    if (step(h == std::abs(left) ? t : t_ + std::copysign(h, left))) continue;
    step_ = h / 2;
    if (step_ < options_.smallest_step)
      return finite_ ? TwistPathEnd::jumped : TwistPathEnd::not_finite;
  }
  return TwistPathEnd::reached;
}

bool TwistPath::resume(double t, const Watch& watch) {
  const double there = t_ + std::copysign(std::min(1e-3, std::abs(t - t_)), t - t_);
  TwistState state = predicted(there);
  // off the path along its softest mode: an unstable equilibrium could stand
  const Eigen::VectorXd mode = solver_.softest_mode(state_);
  solver_.apply(mode, 0.1 / mode.head(3 * model_.nodes).cwiseAbs().maxCoeff(), state);
  if (!rest(there, std::move(state), watch)) return false;
  step_ = 1e-3;
  return true;
}

}  // namespace gridshell
