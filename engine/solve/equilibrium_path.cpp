#include "engine/solve/equilibrium_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {
namespace {

// fraction of the largest axial force; a larger error of the last correction strains the rods
constexpr double certified_misfit = 1e-5;

}  // namespace

PathFollower::PathFollower(Linearisation& system, const PinnedMotion& motion,
                           const PathOptions& options)
    : system_(system), motion_(motion), options_(options) {}

void PathFollower::resume(const PathPoint& point, const PathPoint* across) {
  motion_.apply_loads(system_, point.t);
  now_ = point;
  last_ = {};
  has_before_ = false;
  across_ = nullptr;
  if (!across || across->velocity.x.size() == 0 || point.velocity.x.size() == 0) return;
  across_ = across;
  now_.step = std::abs(across->t - point.t);
}

void PathFollower::take_velocity(PathPoint& point) {
  motion_.velocity(system_, point.t, point.state, point.velocity);
}

PathReport PathFollower::start(double t, State state, const Watch& watch) {
  PathReport report;
  // the path depends on its start alone, not on what was followed before
  has_before_ = false;
  across_ = nullptr;
  now_ = {t, std::move(state)};
  NewtonOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.widest_turn = options_.widest_turn;
  motion_.apply_loads(system_, t);
  report.last = newton(system_, now_.state, options, watch);
  report.t = t;
  last_ = report.last;
  report.end = report.last.outcome;
  if (report.end == Outcome::not_converged) report.end = Outcome::lost;
  if (report.end == Outcome::reached && !options_.allow_unstable &&
      !report.last.inertia.positive_definite())
    report.end = Outcome::unstable;
  if (report.end == Outcome::reached) take_velocity(now_);
  return report;
}

State between(const Model& model, std::span<const PathPoint* const> points, double t) {
  std::vector<double> known;
  for (const PathPoint* point : points) known.push_back(point->t);
  const Eigen::MatrixX2d weights = slope_weights(known, t);
  const PathPoint& first = *points.front();
  State guess = first.state;
  guess.force.setZero();
  Eigen::Matrix3Xd x = first.state.x + (t - first.t) * first.velocity.x;
  auto nodes = x.leftCols(model.nodes);
  nodes.setZero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const State &state = points[k]->state, &velocity = points[k]->velocity;
    const double of_value = weights(Eigen::Index(k), 0), of_slope = weights(Eigen::Index(k), 1);
    nodes += of_value * state.x.leftCols(model.nodes) + of_slope * velocity.x.leftCols(model.nodes);
    guess.force += of_value * state.force + of_slope * velocity.force;
  }
  move_to(model, x, guess);
  return guess;
}

State PathFollower::predict(double t) const {
  const double h = t - now_.t;
  if (across_) {
    const PathPoint* ends[] = {&now_, across_};
    State guess = between(system_.model(), ends, t);
    motion_.impose(system_, t, guess);
    return guess;
  }
  // the change of the tangent since the point before gives the curvature of the path
  const double bend = has_before_ ? 0.5 * h * h / (now_.t - before_.t) : 0.0;
  State guess = now_.state;
  // after a failed start there is no tangent
  if (now_.velocity.x.size() == 0) {
    motion_.impose(system_, t, guess);
    return guess;
  }
  guess.force += h * now_.velocity.force;
  Eigen::Matrix3Xd x = guess.x + h * now_.velocity.x;
  if (has_before_) {
    x += bend * (now_.velocity.x - before_.velocity.x);
    guess.force += bend * (now_.velocity.force - before_.velocity.force);
  }
  move_to(system_.model(), x, guess);
  motion_.impose(system_, t, guess);
  return guess;
}

Outcome PathFollower::step(double t, bool converge, NewtonReport& report, const Watch& watch) {
  PathPoint next{t, predict(t)};
  const Eigen::Matrix3Xd change = next.state.x - now_.state.x;
  if (system_.clear_fraction(now_.state, change) < 1) return Outcome::lost;
  const double predicted_move = max_column_norm(change);
  const ContactPairs& contact = system_.model().contact;
  // rods that begin to touch move less than predicted
  const double fraction = contact.any() ? 1 : 0.5;
  const double allowed = std::min(options_.largest_move * options_.spacing_mm,
                                  fraction * predicted_move + 1e-3 * options_.spacing_mm);
  NewtonOptions newton_options;
  newton_options.tolerance_mm =
      converge ? options_.tolerance_mm : options_.target_move * options_.spacing_mm;
  // a prediction that needs more iterations may be past a fold, next to another branch
  newton_options.most_iterations = 5;
  if (contact.any()) {
    // rods that begin to touch need more iterations: the tangent contains contact only within the
    // gap
    newton_options.most_iterations = 12;
    newton_options.tolerance_mm =
        std::min(newton_options.tolerance_mm, 0.1 * contact.barrier.gap_mm);
  }
  newton_options.farthest_mm = allowed;
  newton_options.trusted_mm = newton_options.tolerance_mm;
  if (converge) newton_options.trusted_misfit = certified_misfit;
  newton_options.widest_turn = options_.widest_turn;
  State guess = contact.any() ? next.state : State{};
  report = newton(system_, next.state, newton_options, watch);
  if (report.outcome != Outcome::reached && contact.any() && last_.inertia.positive_definite()) {
    // descending in energy is more robust near a barrier; it moves no further than a prediction may
    // err
    const MinimiseOptions down{.tolerance_mm = newton_options.tolerance_mm, .most_iterations = 60};
    if (minimise(system_, guess, down, watch).outcome == Outcome::reached &&
        max_column_norm(guess.x - now_.state.x - change) <= allowed) {
      next.state = std::move(guess);
      report = newton(system_, next.state, newton_options, watch);
    }
  }
  if (report.outcome != Outcome::reached)
    return report.outcome == Outcome::not_converged ? Outcome::lost : report.outcome;
  if (!options_.allow_unstable && !report.inertia.positive_definite()) return Outcome::unstable;
  take_velocity(next);
  last_ = report;
  before_ = std::move(now_);
  has_before_ = before_.velocity.x.size() > 0;
  now_ = std::move(next);
  across_ = nullptr;
  return Outcome::reached;
}

PathReport PathFollower::advance(double t, const Watch& watch) {
  PathReport report;
  report.t = now_.t;
  const PathPoint from = now_;
  // every point is iterated to the tolerance, not only the last one
  bool exact = false;
  while (now_.t != t) {
    if (watch.cancelled()) {
      report.end = Outcome::cancelled;
      return report;
    }
    const double left = t - now_.t;
    // the last two steps are made equal, so that none is tiny
    double h = std::min({now_.step, options_.largest_step, std::abs(left)});
    if (h < std::abs(left) && 2 * h > std::abs(left)) h = std::abs(left) / 2;
    const double target = h == std::abs(left) ? t : now_.t + std::copysign(h, left);
    const Outcome outcome = step(target, exact || target == t, report.last, watch);
    if (outcome == Outcome::reached) {
      report.t = now_.t;
      // the error of the prediction is of third order in h
      const double aim = options_.target_move * options_.spacing_mm;
      const double grow = std::cbrt(aim / std::max(report.last.first_move_mm, 1e-3 * aim));
      now_.step = std::max(h * std::clamp(grow, 0.4, 2.5), options_.smallest_step);
      continue;
    }
    now_.step = h / 2;
    if (now_.step >= options_.smallest_step) continue;
    // points that are corrected only once may be past the end of the path: follow it again exactly
    if (!exact) {
      exact = true;
      resume(from);
      report.t = from.t;
      now_.step = PathPoint::first_step;
      continue;
    }
    report.end = outcome;
    return report;
  }
  return report;
}

}  // namespace gridshell
