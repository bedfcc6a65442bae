#include "engine/solve/nested.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/minimise.h"

namespace gridshell {
namespace {

// what the estimates are multiplied by, so that they stay on the safe side of the true error.
// Measured on random circles (tests/bench/bench_engine_estimate): the plain estimate is within 10 %
// of the error, the extrapolated one falls short by up to 1.7 where the meshes are not quite in the
// asymptotic range
constexpr double margin = 1.25, margin_extrapolated = 2.2;

NestedEnd end_of(PathEnd end) {
  switch (end) {
    case PathEnd::reached:
      return NestedEnd::reached;
    case PathEnd::unstable:
      return NestedEnd::unstable;
    case PathEnd::folded:
      return NestedEnd::folded;
    case PathEnd::not_finite:
      return NestedEnd::not_finite;
    case PathEnd::cancelled:
      return NestedEnd::cancelled;
    case PathEnd::lost:
      break;
  }
  return NestedEnd::lost;
}

}  // namespace

PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion) {
  PinnedMotion pinned;
  pinned.begin = pinned.change = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  pinned.begin.middleCols(mesh.joints, mesh.edge_points) = motion.begin;
  pinned.change.middleCols(mesh.joints, mesh.edge_points) = motion.end - motion.begin;
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
  return pinned;
}

double expected_error(const LevelPlan& plan) {
  // measured on circles, caps and hemispheres
  constexpr double plain_of_four = 3e-3, extrapolated_of_sixteen = 7.5e-6;
  const double edges = plan.edges_per_segment.back();
  return plan.extrapolate ? extrapolated_of_sixteen * std::pow(16 / edges, 4)
                          : plain_of_four * std::pow(4 / edges, 2);
}

LevelPlan plan_levels(double tolerance) {
  LevelPlan plan{{4, 8}, false};
  if (tolerance >= margin * expected_error(plan)) return plan;
  plan = {{4, 8, 16}, true};
  while (expected_error(plan) > tolerance)
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  return plan;
}

std::optional<LevelPlan> finer(const LevelPlan& plan) {
  LevelPlan next = plan;
  const int finest = 2 * plan.edges_per_segment.back();
  if (finest > 128) return std::nullopt;
  next.edges_per_segment.push_back(finest);
  next.extrapolate = next.edges_per_segment.size() > 2;
  return next;
}

NestedShell::NestedShell(const Footprint& footprint, const ShellRods& rods,
                         const BoundaryMotion& motion, const LevelPlan& plan,
                         const PathOptions& options)
    : plan_(plan), options_(options) {
  for (int edges : plan.edges_per_segment) {
    auto level = std::make_unique<Level>();
    level->mesh = mesh_rods(footprint, edges);
    level->model = build_model(level->mesh, rods);
    level->motion = pinned_motion(level->mesh, motion);
    level->system = std::make_unique<Linearisation>(level->model);
    if (!levels_.empty()) {
      level->from_coarser.emplace(levels_.back()->mesh, level->mesh);
      level->to_coarser.emplace(level->mesh, levels_.back()->mesh);
    }
    levels_.push_back(std::move(level));
  }
  path_ = std::make_unique<PathFollower>(*levels_[0]->system, levels_[0]->motion, options_);
}

Effort NestedShell::effort() const {
  Effort sum;
  for (const auto& level : levels_) sum += level->system->effort();
  return sum;
}

NestedReport NestedShell::place(double t, const State& coarse) {
  for (auto& level : levels_) level->added.clear(), level->added_t.clear();
  path_->allow_unstable(options_.allow_unstable);
  return {end_of(path_->start(t, coarse).end), t};
}

NestedReport NestedShell::start(double t, const State& coarse, const Watch& watch) {
  const NestedReport report = place(t, coarse);
  return report.end == NestedEnd::reached ? certify(t, watch) : report;
}

NestedReport NestedShell::advance(double t, const Watch& watch) {
  path_->allow_unstable(options_.allow_unstable);
  const PathReport report = path_->advance(t, watch);
  if (report.end != PathEnd::reached) return {end_of(report.end), report.t};
  return certify(t, watch);
}

void NestedShell::push_joint(const Prescription& prescription,
                             const Eigen::Vector3d& displacement) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    const double load = level.system->load_factor();
    level.motion = {state_.levels[k].x, Eigen::Matrix3Xd::Zero(3, level.model.nodes), Pace::even,
                    load, 0};
    level.motion.change.col(prescription.node) = displacement;
    level.system->prescribe(prescription);
  }
  path_ = std::make_unique<PathFollower>(*levels_[0]->system, levels_[0]->motion, options_);
}

State NestedShell::carried(const Level& level, const State& coarser) const {
  State state;
  level.from_coarser->nodes(coarser.x, state.x);
  level.from_coarser->edges(coarser.force, state.force);
  return state;
}

void NestedShell::remember(Level& level, double t, const State& base, const State& state) {
  State added{state.x - base.x, state.force - base.force};
  level.added.push_back(std::move(added));
  level.added_t.push_back(t);
  if (level.added.size() > 2) {
    level.added.erase(level.added.begin());
    level.added_t.erase(level.added_t.begin());
  }
}

bool NestedShell::correct(Level& level, const State& coarser, State& state, NewtonReport& report) {
  NewtonOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.widest_turn = options_.widest_turn;
  report = newton(*level.system, state, options);
  if (report.outcome != NewtonOutcome::converged) return false;
  // a finer mesh moves the joints by less than a cell, or it went to another state
  const int joints = level.mesh.joints;
  return largest_column(state.x.leftCols(joints) - coarser.x.leftCols(joints)) <
         0.5 * options_.spacing_mm;
}

NestedReport NestedShell::certify(double t, const Watch& watch) {
  NestedState next;
  next.t = t;
  next.levels.push_back(path_->point().state);
  NewtonReport report = path_->last();
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    if (watch.cancelled()) return {NestedEnd::cancelled, state_.t};
    Level& level = *levels_[k];
    const State& coarser = next.levels.back();
    const State base = carried(level, coarser);
    State guess = base;
    // what the finer mesh added at the last states carries on along the path; for the first one it
    // is a quarter of what the level below added, the error being of second order
    const std::size_t known = level.added.size();
    if (known == 0 && k > 1) {
      const State quarter = carried(level, levels_[k - 1]->added.back());
      guess.x += quarter.x / 4;
      guess.force += quarter.force / 4;
    }
    if (known > 0) {
      const double ahead =
          known < 2 ? 0 : (t - level.added_t[1]) / (level.added_t[1] - level.added_t[0]);
      const State& last = level.added.back();
      guess.x += last.x;
      guess.force += last.force;
      if (std::abs(ahead) > 0 && std::abs(ahead) < 3) {
        guess.x += ahead * (last.x - level.added[0].x);
        guess.force += ahead * (last.force - level.added[0].force);
      }
    }
    level.motion.impose(*level.system, t, guess.x);
    if (!correct(level, coarser, guess, report)) {
      // without the memory of other states
      guess = base;
      level.motion.impose(*level.system, t, guess.x);
      if (!correct(level, coarser, guess, report)) {
        // full steps lead away: down the energy from there, as long as that stays nearby
        guess = base;
        level.motion.impose(*level.system, t, guess.x);
        minimise(*level.system, guess, {.most_iterations = 60}, watch);
        if (!correct(level, coarser, guess, report)) return {NestedEnd::levels_disagree, state_.t};
      }
    }
    remember(level, t, base, guess);
    next.levels.push_back(std::move(guess));
  }
  state_ = std::move(next);
  finish(report);
  if (!state_.inertia.usable) return {NestedEnd::not_finite, t};
  if (!options_.allow_unstable && !state_.inertia.positive_definite())
    return {NestedEnd::unstable, t};
  return {NestedEnd::reached, t};
}

/// Certificate of the finest level, error estimate, extrapolation.
void NestedShell::finish(const NewtonReport& report) {
  const std::size_t last = levels_.size() - 1;
  Level& finest = *levels_[last];
  // the factorisation of the last correction is the state's own but for that correction; where it
  // moved the state too far to vouch for it, the energy's Hessian there is factorised anew
  constexpr double same_state = 1e-3;  // of d
  State& found = state_.levels[last];
  state_.inertia = report.inertia;
  if (report.factored_move_mm > same_state * options_.spacing_mm ||
      !report.inertia.positive_definite())
    state_.inertia = finest.system->at(found, false);
  finest.system->gradient_at(found);
  // at the end of a path, and where a force is measured, the residual goes down to what round-off
  // leaves: corrections are cheap
  const bool polished = state_.t >= 1 || finest.system->prescription().active();
  Eigen::Matrix3Xd polish;
  for (int k = 0; k < 4 && polished && state_.inertia.usable; ++k) {
    const double residual = finest.system->residual();
    if (residual < 1e-9) break;
    State trial = found;
    if (k < 2)
      finest.system->residual_at(trial);
    else
      finest.system->at(trial);
    finest.system->correction(polish);
    finest.system->apply(polish, trial);
    finest.system->gradient_at(trial);
    if (!(finest.system->residual() < residual)) {
      finest.system->gradient_at(found);
      break;
    }
    found = std::move(trial);
  }
  state_.residual_N = finest.system->residual();
  state_.largest_strain = finest.system->assembly().largest_strain;
  if (finest.system->prescription().active()) take_reaction();
  state_.x = state_.levels[last].x;
  state_.error_estimate_mm = std::numeric_limits<double>::quiet_NaN();
  if (last == 0) return;

  const int joints = finest.mesh.joints;
  const auto joints_of = [&](std::size_t k) { return state_.levels[k].x.leftCols(joints); };
  if (!plan_.extrapolate || last < 2) {
    state_.error_estimate_mm = margin * largest_column(joints_of(last) - joints_of(last - 1)) / 3;
    return;
  }
  const auto extrapolated = [&](std::size_t k) -> Eigen::Matrix3Xd {
    return (4 * joints_of(k) - joints_of(k - 1)) / 3;
  };
  state_.error_estimate_mm =
      margin_extrapolated * largest_column(extrapolated(last) - extrapolated(last - 1)) / 15;
  // the correction is known at the coarser nodes; between them it is interpolated
  Eigen::Matrix3Xd on_coarser, correction;
  finest.to_coarser->nodes(state_.x, on_coarser);
  finest.from_coarser->nodes((on_coarser - state_.levels[last - 1].x) / 3, correction);
  state_.x += correction;
}

void NestedShell::take_reaction() {
  const std::size_t last = levels_.size() - 1;
  state_.reaction = levels_[last]->system->reaction();
  const Eigen::Matrix3Xd& held = levels_[last]->system->prescription().directions;
  state_.push_stiffness = held * levels_[last]->system->prescribed_stiffness() * held.transpose();
  if (!plan_.extrapolate) return;
  Linearisation& coarser = *levels_[last - 1]->system;
  coarser.set_load(levels_[last]->system->load_factor());
  coarser.gradient_at(state_.levels[last - 1]);
  state_.reaction = (4 * state_.reaction - coarser.reaction()) / 3;
}

}  // namespace gridshell
