#include "engine/solve/nested_shell.h"

#include <utility>

#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/solve/block_factor.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {

NestedShell::NestedShell(const LevelPlan& plan, const PathOptions& options)
    : plan_(plan), options_(options) {}
Result<NestedShell> NestedShell::make(const Footprint& footprint, const ShellRods& rods,
                                      RodModel rod_model, const BoundaryMotion& motion,
                                      const LevelPlan& plan, const PathOptions& options) {
  NestedShell shell(plan, options);
  shell.boundary_ = motion;
  // errors with contact show no order of convergence
  if (rods.contact.barrier.acts()) shell.plan_.extrapolate = false;
  const auto numbers = std::make_shared<FactorNumbers>();
  for (int edges : plan.edges_per_segment) {
    auto level = std::make_unique<Level>();
    TRY_DO(level->build(footprint, rods, rod_model, motion, edges));
    level->system->work_with(options.team);
    level->system->share(numbers);
    level->system->outside.steady = &level->steady;
    level->system->outside.field = &level->field;
    if (!shell.levels_.empty()) {
      Level& coarser = *shell.levels_.back();
      coarser.from_finer =
          std::make_unique<StateTransfer>(level->mesh, level->model, coarser.mesh, coarser.model);
      level->from_coarser =
          std::make_unique<StateTransfer>(coarser.mesh, coarser.model, level->mesh, level->model);
    }
    shell.levels_.push_back(std::move(level));
  }
  shell.reset_path();
  return shell;
}

void NestedShell::reset_path() {
  const Level& finest = *levels_.back();
  path_ = std::make_unique<PathFollower>(*finest.system, finest.motion, options_);
}

std::vector<PinnedMotion> NestedShell::motions() const {
  std::vector<PinnedMotion> all;
  for (const auto& level : levels_) all.push_back(level->motion);
  return all;
}

int NestedShell::first_of_last_three() const {
  constexpr int least_edges = 4;
  int first = std::max(state_.measured, levels() - 3);
  while (first < last() && mesh(first).edges_per_segment < least_edges) ++first;
  return first;
}

Effort NestedShell::effort() const {
  Effort sum;
  for (const auto& level : levels_) sum += level->system->effort();
  return sum;
}

void NestedShell::free_memory() {
  for (const auto& level : levels_) level->system->free_memory();
}

Energies NestedShell::energies(int level) const {
  const Level& one = *levels_[std::size_t(level)];
  return energies_of(one.model, state_.levels[std::size_t(level)], one.system->outside);
}

Assembly NestedShell::forces(int level) const {
  const Level& one = *levels_[std::size_t(level)];
  Assembly at;
  assemble_gradient(one.model, state_.levels[std::size_t(level)], one.system->outside, at);
  return at;
}

State NestedShell::stay(const NestedShell& other, const std::vector<Constraint>& constraints) {
  const Level& theirs = *other.levels_.back();
  State fine;
  for (auto& level : levels_) {
    State state = StateTransfer(theirs.mesh, theirs.model, level->mesh, level->model)
                      .carry(other.state_.levels.back());
    level->motion = {state.x,
                     Eigen::Matrix3Xd::Zero(3, state.x.cols()),
                     PathLaw::even,
                     {theirs.system->outside.load, 0}};
    // a prescribed joint remains at its extrapolated position: that of one mesh has its mesh error
    for (const Constraint& constraint : constraints)
      level->motion.begin.col(constraint.node) = other.state_.x.col(constraint.node);
    level->system->constrain(constraints);
    fine = std::move(state);
  }
  state_ = {};  // of the last use of these meshes, in which a prescribed joint was elsewhere
  forget();
  reset_path();
  return fine;
}

void NestedShell::set_fields(const std::vector<NodeAction>& steady,
                             const std::vector<NodeAction>& field) {
  for (auto& level : levels_) level->steady = steady, level->field = field;
}

void NestedShell::apply_loads() {
  for (auto& level : levels_) level->motion.apply_loads(*level->system, state_.t);
}

void NestedShell::back_to(const NestedState& state) {
  state_ = state;
  path_->resume({state.t, state.levels.back(), state.velocity, state.step});
  remember(differences());
  apply_loads();
}

void NestedShell::restore(const NestedState& state, const std::vector<PinnedMotion>& motions,
                          const std::vector<Constraint>& constraints) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    levels_[k]->motion = motions[k];
    levels_[k]->system->constrain(constraints);
  }
  reset_path();
  back_to(state);
}

void NestedShell::forget() {
  for (auto& level : levels_) level->differences.clear();
}

/// Sets the differences from which the next states of the companions are predicted.
void NestedShell::remember(const std::vector<MeshDifference>& differences) {
  forget();
  for (std::size_t k = 0; k < differences.size(); ++k) levels_[k]->differences = {differences[k]};
}

/// Differences of the coarser levels at the current state.
std::vector<MeshDifference> NestedShell::differences() const {
  std::vector<MeshDifference> all;
  for (int k = 0; k < last(); ++k) {
    const Level& level = *levels_[std::size_t(k)];
    const std::vector<State>& states = state_.levels;
    all.push_back(k < state_.measured
                      ? MeshDifference{state_.t}
                      : difference(level, state_.t,
                                   level.from_finer->carry(states[std::size_t(k) + 1]),
                                   states[std::size_t(k)]));
  }
  return all;
}

NestedPathPoint NestedShell::point() const {
  return {{state_.t, state_.levels.back(), state_.velocity, state_.step},
          differences(),
          state_.inertia};
}

NestedReport NestedShell::start_path(double t, const State& fine, const Watch& watch) {
  forget();
  path_->allow_unstable(options_.allow_unstable);
  return {path_->start(t, fine, watch).end, t};
}

NestedReport NestedShell::start(double t, const State& fine, const Watch& watch) {
  const NestedReport report = start_path(t, fine, watch);
  return report.end == Outcome::reached ? certify(*path_, watch) : report;
}

Result<State> NestedShell::refined(double t, State coarse, const Watch& watch) {
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    State fine = level.from_coarser->carry(coarse);
    level.motion.impose(*level.system, t, fine);
    TRY(found, find_equilibrium(*level.system, fine, 0.5 * options_.spacing_mm, watch));
    coarse = std::move(*found);
  }
  return coarse;
}

NestedReport NestedShell::advance(double t, const Watch& watch) {
  path_->allow_unstable(options_.allow_unstable);
  const PathReport report = path_->advance(t, watch);
  if (report.end != Outcome::reached) return {report.end, report.t};
  return certify(*path_, watch);
}

NestedReport NestedShell::sample(double t, const NestedPathPoint& nearest, const Watch& watch,
                                 const NestedPathPoint* across) {
  PathFollower path(system(), motion(), options_);
  path.allow_unstable(options_.allow_unstable);
  path.resume(nearest, across);
  const PathReport report = path.advance(t, watch);
  if (report.end != Outcome::reached) return {report.end, report.t};
  remember(nearest.companions);
  for (std::size_t k = 0; across && k < across->companions.size(); ++k)
    levels_[k]->differences.push_back(across->companions[k]);
  // with constraints the stiffness at this state is needed, hence a factorisation
  const bool known = t == nearest.t && system().constraints().empty();
  return certify(path, watch, known ? nearest.inertia : Inertia{});
}

void NestedShell::drive(const PrescribedMove& drive) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    const Eigen::Matrix3Xd& x = state_.levels[k].x;
    level.motion = {x,
                    Eigen::Matrix3Xd::Zero(3, x.cols()),
                    PathLaw::even,
                    drive.load,
                    drive.field,
                    drive.opening};
    if (drive.boundary) {
      const PinnedMotion requested = pinned_motion(level.mesh, *drive.boundary);
      const Eigen::Matrix3Xd there = requested.at(1);
      for (const EndRotation& turn : requested.turns)
        level.motion.turns.push_back(
            rotation_between(turn.node, turn.about, x.col(turn.node) - x.col(turn.about),
                             there.col(turn.node) - there.col(turn.about)));
      for (int node = 0; node < level.mesh.nodes(); ++node)
        if (level.model.pinned(node)) level.motion.change.col(node) = there.col(node) - x.col(node);
    }
    for (std::size_t h = 0; h < drive.displacements.size(); ++h)
      level.motion.change.col(drive.constraints[h].node) = drive.displacements[h];
    level.system->constrain(drive.constraints);
  }
  forget();
  reset_path();
}

void NestedShell::actuate(double t, const std::vector<Constraint>& constraints, double load_scale) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    // a shell without a state yet is at the start of its motion
    const Eigen::Matrix3Xd here = state_.levels.empty() ? level.motion.begin : state_.levels[k].x;
    level.motion = pinned_motion(level.mesh, boundary_);
    level.motion.load.change = load_scale;
    for (const Constraint& constraint : constraints)
      level.motion.begin.col(constraint.node) = here.col(constraint.node);
    level.system->constrain(constraints);
  }
  state_.t = t;
  forget();
  reset_path();
}

}  // namespace gridshell
