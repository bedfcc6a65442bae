#include "engine/solve/nested_shell.h"

#include <utility>

#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/solve/block_factor.h"

namespace gridshell {

LevelCorrection operator-(const LevelCorrection& a, const LevelCorrection& b) {
  return {a.t, a.x - b.x, a.force - b.force};
}

PathInterval interval_at(const NestedPathPoint& before, const NestedPathPoint& after, double t) {
  PathInterval found{&before, &after};
  for (const PathPoint& point : after.way) {
    const bool in_front = after.t > before.t ? point.t < t : point.t > t;
    (in_front ? found.from : found.to) = &point;
    if (!in_front) break;
  }
  return found;
}

NestedShell::NestedShell(const LevelPlan& plan, const PathOptions& options)
    : plan_(plan), options_(options) {}
Result<NestedShell> NestedShell::make(const Footprint& footprint, const ShellRods& rods,
                                      RodModel rung, const BoundaryMotion& motion,
                                      const LevelPlan& plan, const PathOptions& options) {
  NestedShell shell(plan, options);
  shell.boundary_ = motion;
  // contact knows no order
  if (rods.contact.barrier.acts()) shell.plan_.extrapolate = shell.plan_.extrapolate_forces = false;
  const auto numbers = std::make_shared<FactorNumbers>();
  for (int edges : plan.edges_per_segment) {
    auto level = std::make_unique<Level>();
    TRY_DO(level->build(footprint, rods, rung, motion, edges));
    level->system->work_with(options.team);
    level->system->share(numbers);
    level->system->outside.steady = &level->steady;
    level->system->outside.field = &level->field;
    if (!shell.levels_.empty()) {
      const Level& coarser = *shell.levels_.back();
      level->from_coarser =
          std::make_unique<StateTransfer>(coarser.mesh, coarser.model, level->mesh, level->model);
      level->to_coarser.emplace(level->mesh, coarser.mesh);
    }
    shell.levels_.push_back(std::move(level));
  }
  shell.reset_path();
  return shell;
}

void NestedShell::reset_path() {
  PathOptions options = options_;
  options.keeps_way = true;
  path_ = std::make_unique<PathFollower>(*levels_[0]->system, levels_[0]->motion, options);
}

std::vector<PinnedMotion> NestedShell::motions() const {
  std::vector<PinnedMotion> all;
  for (const auto& level : levels_) all.push_back(level->motion);
  return all;
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

State NestedShell::stay(const NestedShell& other, const std::vector<Constraint>& holds) {
  const Level& theirs = *other.levels_.back();
  State first;
  for (auto& level : levels_) {
    State state = StateTransfer(theirs.mesh, theirs.model, level->mesh, level->model)
                      .carry(other.state_.levels.back());
    level->motion = {state.x,
                     Eigen::Matrix3Xd::Zero(3, state.x.cols()),
                     PathLaw::even,
                     {theirs.system->outside.load, 0}};
    level->system->hold(holds);
    if (first.x.size() == 0) first = std::move(state);
  }
  state_.t = 0;
  forget();
  reset_path();
  return first;
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
  place(state.t, state.levels[0]);
  set_corrections(beyond());
  apply_loads();
}

void NestedShell::restore(const NestedState& state, const std::vector<PinnedMotion>& motions,
                          const std::vector<Constraint>& holds) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    levels_[k]->motion = motions[k];
    levels_[k]->system->hold(holds);
  }
  reset_path();
  back_to(state);
}

void NestedShell::forget() {
  for (auto& level : levels_) level->beyond.clear();
}

/// From now on finer levels look for their states where these were.
void NestedShell::set_corrections(const std::vector<LevelCorrection>& beyond) {
  forget();
  for (std::size_t k = 0; k < beyond.size(); ++k) levels_[k + 1]->beyond = {beyond[k]};
}

/// What finer levels add at the current state beside what is expected.
std::vector<LevelCorrection> NestedShell::beyond() const {
  std::vector<LevelCorrection> all;
  LevelCorrection below;
  for (std::size_t k = 1; k < state_.levels.size(); ++k) {
    const Level& level = *levels_[k];
    const LevelCorrection added = correction_of(
        level, state_.t, level.from_coarser->carry(state_.levels[k - 1]), state_.levels[k]);
    all.push_back(added - expected_correction(k, below));
    below = added;
  }
  return all;
}

NestedPathPoint NestedShell::point() const {
  // a cubic from end to end does without few; many take memory
  constexpr std::size_t few = 2, most = 12;
  NestedPathPoint point{followed(), beyond()};
  const std::vector<PathPoint>& way = path_->way();
  const std::size_t kept = way.size() > few ? std::min(way.size(), most) : 0;
  for (std::size_t k = 0; k < kept; ++k) point.way.push_back(way[k * way.size() / kept]);
  return point;
}

NestedReport NestedShell::place(double t, const State& coarse, const Watch& watch) {
  forget();
  path_->allow_unstable(options_.allow_unstable);
  return {path_->start(t, coarse, watch).end, t};
}

NestedReport NestedShell::start(double t, const State& coarse, const Watch& watch) {
  const NestedReport report = place(t, coarse, watch);
  if (report.end != Outcome::reached) return report;
  return certify(t, path_->point(), path_->last(), Prefer::stable, watch);
}

NestedReport NestedShell::advance(double t, const Watch& watch) {
  path_->allow_unstable(options_.allow_unstable);
  const PathReport report = path_->advance(t, watch);
  if (report.end != Outcome::reached) return {report.end, report.t};
  return certify(t, path_->point(), path_->last(), Prefer::first, watch);
}

NestedReport NestedShell::sample(double t, const NestedPathPoint& beside, const Watch& watch,
                                 const NestedPathPoint* across) {
  struct Memory {  // what finer meshes added stays that of the path
    std::vector<std::unique_ptr<Level>>& levels;
    std::vector<std::vector<LevelCorrection>> beyond;
    explicit Memory(std::vector<std::unique_ptr<Level>>& all) : levels(all) {
      for (const auto& level : all) beyond.push_back(level->beyond);
    }
    ~Memory() {
      for (std::size_t k = 0; k < levels.size(); ++k) levels[k]->beyond = std::move(beyond[k]);
    }
  } memory(levels_);
  PathFollower path(*levels_[0]->system, levels_[0]->motion, options_);
  path.allow_unstable(options_.allow_unstable);
  const PathInterval next =
      across ? interval_at(beside, *across, t) : PathInterval{&beside, nullptr};
  path.resume(*next.from, next.to);
  PathReport report = path.advance(t, watch);
  // from the way, which is not at rest, it may not be found
  if (report.end != Outcome::reached && next.from != &beside) {
    path.resume(beside, across);
    report = path.advance(t, watch);
  }
  if (report.end != Outcome::reached) return {report.end, report.t};
  set_corrections(beside.beyond);
  for (std::size_t k = 0; across && k < across->beyond.size(); ++k)
    levels_[k + 1]->beyond.push_back(across->beyond[k]);
  return certify(t, path.point(), path.last(), Prefer::stable, watch);
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
      const PinnedMotion wanted = pinned_motion(level.mesh, *drive.boundary);
      const Eigen::Matrix3Xd there = wanted.at(1);
      for (const EndRotation& turn : wanted.turns)
        level.motion.turns.push_back(
            rotation_between(turn.node, turn.about, x.col(turn.node) - x.col(turn.about),
                             there.col(turn.node) - there.col(turn.about)));
      for (int node = 0; node < level.mesh.nodes(); ++node)
        if (level.model.pinned(node)) level.motion.change.col(node) = there.col(node) - x.col(node);
    }
    for (std::size_t h = 0; h < drive.displacements.size(); ++h)
      level.motion.change.col(drive.holds[h].node) = drive.displacements[h];
    level.system->hold(drive.holds);
  }
  forget();
  reset_path();
}

void NestedShell::actuate(double t, const std::vector<Constraint>& holds, double load_scale) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    // one that only stays somewhere yet has no state: it stands where its motion begins
    const Eigen::Matrix3Xd here = state_.levels.empty() ? level.motion.begin : state_.levels[k].x;
    level.motion = pinned_motion(level.mesh, boundary_);
    level.motion.load.change = load_scale;
    for (const Constraint& hold : holds) level.motion.begin.col(hold.node) = here.col(hold.node);
    level.system->hold(holds);
  }
  state_.t = t;
  forget();
  reset_path();
}

}  // namespace gridshell
