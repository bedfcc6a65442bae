#include "engine/solve/equilibrium_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {

Eigen::Vector3d EndRotation::at(double t) const {
  return (1 + t * stretch) * (Eigen::AngleAxisd(t * angle, axis) * arm);
}

Eigen::Vector3d EndRotation::rate(double t) const {
  const Eigen::Vector3d turned = Eigen::AngleAxisd(t * angle, axis) * arm;
  return stretch * turned + (1 + t * stretch) * angle * axis.cross(turned);
}

EndRotation rotation_between(int node, int about, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to) {
  const Eigen::AngleAxisd way(turn_between(from, to));
  return {node, about, from, way.axis(), way.angle(), to.norm() / from.norm() - 1};
}

Eigen::Matrix3Xd PinnedMotion::at(double t) const {
  Eigen::Matrix3Xd x = begin + progress(t) * change;
  for (const EndRotation& turn : turns) x.col(turn.node) = x.col(turn.about) + turn.at(t);
  return x;
}

Eigen::Matrix3Xd PinnedMotion::rate(double t) const {
  Eigen::Matrix3Xd x = speed(t) * change;
  for (const EndRotation& turn : turns) x.col(turn.node) = x.col(turn.about) + turn.rate(t);
  return x;
}

void PinnedMotion::apply_loads(Linearisation& system, double t) const {
  system.outside.load = factor_at(load, t);
  system.outside.field_factor = factor_at(field, t);
  system.outside.opening = factor_at(opening, t);
}

void PinnedMotion::impose(Linearisation& system, double t, State& state) const {
  apply_loads(system, t);
  const Model& model = system.model();
  const Eigen::Matrix3Xd there = at(t);
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < model.nodes; ++node)
    if (model.pinned(node)) x.col(node) = there.col(node);
  for (const Constraint& hold : system.holds())
    x.col(hold.node) += hold.part(there.col(hold.node) - x.col(hold.node));
  move_to(model, x, state);
}

void PinnedMotion::velocity(Linearisation& system, double t, const State& state,
                            State& velocity) const {
  ExternalLoads growing = system.outside;
  growing.load = speed(t) * load.change;
  growing.field_factor = speed(t) * field.change;
  growing.opening = speed(t) * opening.change;
  system.tangent(rate(t), growing, state, velocity.x);
  velocity.force = system.force_change(velocity.x);
}

PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion) {
  PinnedMotion pinned;
  pinned.begin = pinned.change = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  pinned.begin.middleCols(mesh.joints, mesh.edge_points) = motion.begin;
  pinned.change.middleCols(mesh.joints, mesh.edge_points) = motion.end - motion.begin;
  for (std::size_t k = 0; k < mesh.held_joints.size(); ++k) {
    const Eigen::Vector3d from = motion.begin_joints.col(Eigen::Index(k));
    pinned.begin.col(mesh.held_joints[k]) = from;
    pinned.change.col(mesh.held_joints[k]) = motion.end_joints.col(Eigen::Index(k)) - from;
  }
  // a ghost stays in the held direction from its edge point
  const auto place = [&](int ghost, Eigen::Index end, double side) {
    const double length = side * mesh.ghost_length;
    pinned.begin.col(ghost) = motion.begin.col(end) + length * motion.begin_tangent.col(end);
    pinned.change.col(ghost) = motion.end.col(end) + length * motion.end_tangent.col(end);
    pinned.change.col(ghost) -= pinned.begin.col(ghost);
  };
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    if (mesh.is_ghost(node.front())) place(node.front(), 2 * Eigen::Index(r), -1);
    if (mesh.is_ghost(node.back())) place(node.back(), 2 * Eigen::Index(r) + 1, 1);
  }
  // a spring's support goes where what hangs on it would be held
  for (const MeshSpring& spring : mesh.springs) {
    pinned.begin.col(spring.support) = pinned.begin.col(spring.node);
    pinned.change.col(spring.support) = pinned.change.col(spring.node);
  }
  for (Eigen::Index end = 0; end < Eigen::Index(mesh.far_ends.size()); ++end) {
    const int far_end = mesh.far_ends[std::size_t(end)];
    if (far_end < 0) continue;
    pinned.begin.col(far_end) = motion.begin_far.col(end);
    pinned.turns.push_back(rotation_between(far_end, mesh.joints + int(end),
                                            motion.begin_far.col(end) - motion.begin.col(end),
                                            motion.end_far.col(end) - motion.end.col(end)));
  }
  return pinned;
}

void PathFollower::take_velocity(PathPoint& point) {
  motion_.velocity(system_, point.t, point.state, point.velocity);
}

PathReport PathFollower::start(double t, State state, const Watch& watch) {
  PathReport report;
  // from the same point the same path, whatever was followed before
  has_before_ = false;
  across_ = nullptr;
  step_ = first_step;
  now_ = {t, std::move(state), {}};
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

State between(const Model& model, const PathPoint& a, const PathPoint& b, double t) {
  const double h = b.t - a.t, s = (t - a.t) / h;
  const double to = s * s * (3 - 2 * s), from_slope = h * s * (1 - s) * (1 - s),
               to_slope = -h * s * s * (1 - s);
  const auto cubic = [&](const auto& x, const auto& vx, const auto& y, const auto& vy) {
    return (x + to * (y - x) + from_slope * vx + to_slope * vy).eval();
  };
  State guess = a.state;
  guess.force = cubic(a.state.force, a.velocity.force, b.state.force, b.velocity.force);
  Eigen::Matrix3Xd x = a.state.x + (t - a.t) * a.velocity.x;
  x.leftCols(model.nodes) =
      cubic(a.state.x, a.velocity.x, b.state.x, b.velocity.x).leftCols(model.nodes);
  move_to(model, x, guess);
  return guess;
}

State PathFollower::predict(double t) const {
  const double h = t - now_.t;
  if (across_) {
    State guess = between(system_.model(), now_, *across_, t);
    motion_.impose(system_, t, guess);
    return guess;
  }
  // the change of the tangent since the point before gives the curvature of the path
  const double bend = has_before_ ? 0.5 * h * h / (now_.t - before_.t) : 0.0;
  State guess = now_.state;
  // a start that failed knows no tangent
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
  PathPoint next;
  next.t = t;
  next.state = predict(t);
  const Eigen::Matrix3Xd way = next.state.x - now_.state.x;
  if (system_.clear_share(now_.state, way) < 1) return Outcome::lost;
  const double predicted_move = max_column_norm(way);
  const ContactPairs& contact = system_.model().contact;
  // what begins to press stays behind
  const double share = contact.any() ? 1 : 0.5;
  const double allowed = std::min(options_.largest_move * options_.spacing_mm,
                                  share * predicted_move + 1e-3 * options_.spacing_mm);
  NewtonOptions newton_options;
  newton_options.tolerance_mm =
      converge ? options_.tolerance_mm : options_.target_move * options_.spacing_mm;
  // a prediction that takes more to come to rest may be beyond a fold, next to another branch
  newton_options.most_iterations = 5;
  if (contact.any()) {
    // what begins to press takes some more, and a tangent knows of it within the gap alone
    newton_options.most_iterations = 12;
    newton_options.tolerance_mm =
        std::min(newton_options.tolerance_mm, 0.1 * contact.barrier.gap_mm);
  }
  newton_options.farthest_mm = allowed;
  newton_options.trusted_mm = newton_options.tolerance_mm;
  newton_options.widest_turn = options_.widest_turn;
  State guess = contact.any() ? next.state : State{};
  report = newton(system_, next.state, newton_options, watch);
  if (report.outcome != Outcome::reached && contact.any() && last_.inertia.positive_definite()) {
    // down the energy a barrier is met more surely; it leads no further than a prediction may err
    const MinimiseOptions down{.tolerance_mm = newton_options.tolerance_mm, .most_iterations = 60};
    if (minimise(system_, guess, down, watch).outcome == Outcome::reached &&
        max_column_norm(guess.x - now_.state.x - way) <= allowed) {
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
  // every point is brought to the tolerance, not the last one alone
  bool exact = false;
  while (now_.t != t) {
    if (watch.cancelled()) {
      report.end = Outcome::cancelled;
      return report;
    }
    const double left = t - now_.t;
    // the last two steps are made equal, so that none is tiny
    double h = std::min({step_, options_.largest_step, std::abs(left)});
    if (h < std::abs(left) && 2 * h > std::abs(left)) h = std::abs(left) / 2;
    const double target = h == std::abs(left) ? t : now_.t + std::copysign(h, left);
    const Outcome outcome = step(target, exact || target == t, report.last, watch);
    ++report.steps;
    if (outcome == Outcome::reached) {
      report.t = now_.t;
      // the prediction is off by a term of third order in h
      const double aim = options_.target_move * options_.spacing_mm;
      const double grow = std::cbrt(aim / std::max(report.last.first_move_mm, 1e-3 * aim));
      step_ = std::max(h * std::clamp(grow, 0.4, 2.5), options_.smallest_step);
      continue;
    }
    ++report.halvings;
    step_ = h / 2;
    if (step_ >= options_.smallest_step) continue;
    // with one correction a point next to the path's end may lie beyond it
    if (!exact) {
      exact = true;
      resume(from);
      report.t = from.t;
      step_ = first_step;
      continue;
    }
    report.end = outcome;
    return report;
  }
  return report;
}

namespace {

constexpr int most_corrections = 8;

}  // namespace

PathFollower::PathFollower(Linearisation& system, const PinnedMotion& motion,
                           const PathOptions& options)
    : system_(system), motion_(motion), options_(options) {}

void PathFollower::resume(const PathPoint& point, const PathPoint* across) {
  motion_.apply_loads(system_, point.t);
  now_ = point;
  has_before_ = false;
  across_ = nullptr;
  if (!across || across->velocity.x.size() == 0 || point.velocity.x.size() == 0) return;
  across_ = across;
  step_ = std::abs(across->t - point.t);
}

ArcFollower::ArcFollower(Linearisation& system, const PinnedMotion& motion,
                         const ArcOptions& options)
    : system_(&system), motion_(motion), options_(options), step_mm_(options.step_mm) {}

double ArcFollower::product(const State& a, double at, const State& b, double bt) const {
  return (a.x.array() * b.x.array()).sum() / double(a.x.cols()) +
         options_.parameter_mm * options_.parameter_mm * at * bt;
}

/// Unit tangent at a point that was just factorised, on along `before`.
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

/// Newton on positions and parameter, at right angles to the tangent of the point before.
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
    const State held{dx, {}};
    const double dt = -product(held, 0, tangent, turn_t_) / product(with_t, 1, tangent, turn_t_);
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
  for (; step_mm_ >= options_.smallest_mm; step_mm_ /= 2) {
    ArcPoint next;
    next.point.t = now_.point.t + step_mm_ * turn_t_;
    next.point.state = now_.point.state;
    next.point.state.force += step_mm_ * now_.point.velocity.force;
    move_to(system_->model(), now_.point.state.x + step_mm_ * now_.point.velocity.x,
            next.point.state);
    int iterations = 0;
    if (!corrected(next, iterations, watch) ||
        system_->clear_share(now_.point.state, next.point.state.x - now_.point.state.x) < 1) {
      if (watch.cancelled()) return Outcome::cancelled;
      continue;
    }
    const State before = std::move(now_.point.velocity);
    const double before_t = turn_t_;
    take_tangent(next, &before, before_t);
    now_ = std::move(next);
    // four corrections are what a good step takes
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
