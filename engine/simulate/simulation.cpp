#include "engine/simulate/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/simulate/first_state.h"
#include "engine/simulate/frames.h"
#include "engine/solve/buckling.h"

namespace gridshell {
namespace {

constexpr double stiffness_growth = 100;  // a push that is so much stiffer than at its start ends

PathOptions options_for(const Scene& scene, Team* team) {
  PathOptions options;
  options.spacing_mm = scene.footprint.spacing;
  // far below the errors of the meshes, so that it does not change the differences between them
  const double finest = 5e-9 * options.spacing_mm;
  options.tolerance_mm =
      std::clamp(1e-3 * scene.tolerance * scene.length_scale_mm, finest, 1e3 * finest);
  // rods in contact are stiff: an error of that size in a distance would change their forces
  if (scene.rods.contact.barrier.acts()) options.tolerance_mm = finest;
  options.team = team;
  return options;
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const Scene> scene, RunContext context)
    : scene_(std::move(scene)), context_(std::move(context)) {}

record::Contacts Simulation::contacts() const { return search_->in(nodes()); }

std::optional<Event> Simulation::exceeded_limit() const { return exceeded(limits()); }

Result<Simulation> Simulation::open(std::shared_ptr<const Scene> scene, const LevelPlan& plan,
                                    const RunContext& context) {
  Simulation simulation(std::move(scene), context);
  simulation.set_progress(0);
  TRY(shell, simulation.build(plan));
  simulation.use(std::move(*shell));
  return simulation;
}

/// Returns the shell of rods() on the meshes of a plan; it is built only once.
Result<std::shared_ptr<NestedShell>> Simulation::build(const LevelPlan& plan) {
  for (const auto& built : built_)
    if (built->plan() == plan) return built;
  TRY(shell, NestedShell::make(scene_->footprint, rods(), scene_->solved_model(), scene_->motion,
                               plan, options_for(*scene_, context_.team.get())));
  return built_.emplace_back(std::make_shared<NestedShell>(std::move(*shell)));
}

void Simulation::use(std::shared_ptr<NestedShell> shell) {
  if (shell_) {
    shell_->free_memory();
    spent_ += shell_->effort();
  }
  shell_ = std::move(shell);
  spent_ = spent_ - shell_->effort();  // its earlier effort is counted already, or another's
  search_.emplace(simulate::parts_of(*scene_, shell_->finest()));
}

// ---- reports ----

Certificate Simulation::certificate() const {
  const NestedState& state = shell_->state();
  return {state.residual_N, state.inertia.negative_pivots, state.error_estimate_mm,
          state.largest_strain};
}

Simulation::CallBegin Simulation::call_begin() const { return {effort(), seconds_now()}; }

Report Simulation::report(Outcome end, double t, const CallBegin& begin) const {
  Report report;
  report.end = end;
  report.t = t;
  report.certificate = certificate();
  report.effort = effort() - begin.effort;
  report.seconds = seconds_now() - begin.seconds;
  return report;
}

void Simulation::put_push(record::Frame& frame) const {
  if (constraints_.empty()) return;
  const Constraint& constraint = constraints_.back();
  const auto origin = constraint_origins.find(constraint.node);
  if (origin == constraint_origins.end()) return;
  const Eigen::Vector3d moved = constraint.part(nodes().col(constraint.node) - origin->second);
  frame.depth_mm = moved.norm();
  // a joint of the step `hold` is `nearest_mm` from its origin, to rounding
  const bool any = frame.depth_mm > 0.5 * nearest_mm;
  frame.force_N = any ? constraint.part(force(constraints_.size() - 1)).dot(moved.normalized()) : 0;
  put_push_errors(frame);
}

void Simulation::put_push_errors(record::Frame& frame) const {
  const NestedState& state = shell_->state();
  frame.push_error_N = state.reaction_error_N;
  // the stiffness is that of the last constraint, with the others fixed
  const Eigen::Index entries = state.constraint_stiffness.rows(),
                     own = constraints_.back().directions.cols();
  const Eigen::VectorXd along =
      along_.size() == entries ? Eigen::VectorXd(along_.tail(own)) : Eigen::VectorXd();
  if (along.size() == 0 || along.isZero(0)) return;
  const Eigen::VectorXd direction = along.normalized();
  frame.stiffness_N_per_mm =
      direction.dot(state.constraint_stiffness.bottomRightCorner(own, own) * direction);
  // the state's error is that of one entry of the matrix
  frame.stiffness_error_N_per_mm =
      std::pow(direction.lpNorm<1>(), 2) * state.stiffness_error_N_per_mm;
}

Energies Simulation::energies() const {
  const int last = shell_->last();
  const Energies fine = shell_->energies(last);
  return shell_->extrapolates() ? extrapolated(fine, shell_->energies(last - 1)) : fine;
}

bool Simulation::locked() const { return locked_past(scene_->max_strain); }

bool Simulation::locked_past(double strain) const {
  if (std::abs(shell_->state().largest_strain) > strain) return true;
  if (actuating_ || constraints_.empty() || !(first_stiffness_ > 0)) return false;
  return push_stiffness() > stiffness_growth * first_stiffness_;
}

double Simulation::bending_strain() const {
  const int last = shell_->levels() - 1;
  const Eigen::VectorXd strain =
      bending_strain_of(shell_->model(last), shell_->state().levels.back());
  return strain.size() > 0 ? strain.maxCoeff() : 0;
}

std::pair<double, std::string> Simulation::strained() const {
  const double bent =
      scene_->max_bending_strain > 0 ? bending_strain() / scene_->max_bending_strain : 0;
  const double used =
      scene_->max_utilisation > 0 ? simulate::utilisation_of(*this) / scene_->max_utilisation : 0;
  if (bent >= used)
    return {bent, fmt::format("max_bending_strain = {:.4g}", scene_->max_bending_strain)};
  return {used, fmt::format("max_utilisation = {:.4g}", scene_->max_utilisation)};
}

Simulation::Limits Simulation::limits() const {
  constexpr double none = std::numeric_limits<double>::infinity();
  Limits limits{scene_->max_strain, scene_->limits_strength() ? 1 : none, {}};
  std::ranges::fill(limits.gap_mm, scene_->stops_at_contact ? 0 : -none);
  return limits;
}

/// Limits for a state that already exceeds those of the scene: its own measures.
Simulation::Limits Simulation::limits_here() const {
  Limits here = limits();
  here.strain = std::max(here.strain, std::abs(shell_->state().largest_strain));
  if (scene_->limits_strength()) here.strained = std::max(here.strained, strained().first);
  if (scene_->stops_at_contact)
    for (const record::Contact& contact : contacts().interpenetrations) {
      double& gap = here.gap_mm[std::size_t(contact.kind)];
      gap = std::min(gap, contact.gap_mm);
    }
  return here;
}

std::optional<Event> Simulation::exceeded(const Limits& limits) const {
  Event met{Event::Kind::locked, shell_->state().t, {}, {}};
  if (locked_past(limits.strain)) return met;
  met.kind = Event::Kind::overbent;
  if (scene_->limits_strength()) {
    auto [fraction, by] = strained();
    met.what = std::move(by);
    if (fraction > limits.strained) return met;
  }
  if (!scene_->stops_at_contact) return std::nullopt;
  met.kind = Event::Kind::contact;
  for (const record::Contact& contact : contacts().interpenetrations)
    if (contact.gap_mm < limits.gap_mm[std::size_t(contact.kind)]) {
      met.what = simulate::text_of(contact, scene_->footprint);
      return met;
    }
  return std::nullopt;
}

double Simulation::push_stiffness() const {
  return along_.dot(shell_->state().constraint_stiffness * along_);
}

// ---- first state ----

Report Simulation::begin_flat() {
  const CallBegin begin = call_begin();
  begin_unloaded();
  NestedState flat;
  for (int k = 0; k < shell_->levels(); ++k) {
    Linearisation& system = shell_->system(k);
    flat.levels.push_back(
        flat_state(shell_->model(k), shell_->mesh(k), shell_->motion(k), scene_->flat));
    shell_->motion(k).apply_loads(system, 0);
    if (k + 1 < shell_->levels()) continue;
    flat.inertia = system.at(flat.levels.back(), false);
    flat.residual_N = system.residual();
    flat.x = nodes_of(shell_->mesh(k), shell_->model(k), flat.levels.back().x);
  }
  shell_->restore(flat, shell_->motions(), {});
  set_progress(0);
  return report(Outcome::reached, 0, begin);
}

Result<Report> Simulation::begin_buckled(double shortening, const Watch& watch) {
  const CallBegin begin = call_begin();
  begin_unloaded();
  TRY(t, parameter_of_shortening(shell_->finest(), shell_->motion(), shortening));
  TRY(first, buckled_state(*shell_, *scene_, rods(), *t, watch));
  const Report there = begin_at(*t, *first, watch);
  return report(there.end, there.t, begin);
}

Result<Report> Simulation::begin_on_net(const Watch& watch) {
  begin_unloaded();
  TRY(rest, state_on_net(*shell_, *scene_, watch));
  return begin_at(1, *rest, watch);
}

Result<Report> Simulation::begin_as_drawn(const Watch& watch) {
  begin_unloaded();
  TRY(rest, state_as_drawn(*shell_, *scene_, rods(), watch));
  return begin_at(0, *rest, watch);
}

Report Simulation::begin_refined(double t, const State& coarse, const Watch& watch) {
  begin_unloaded();
  shell_->actuate(t, {}, load_scale_);
  const auto fine = shell_->refined(t, coarse, watch);
  if (fine) return begin_at(t, *fine, watch);
  return report(watch.cancelled() ? Outcome::cancelled : Outcome::not_converged, t, call_begin());
}

Report Simulation::begin_at(double t, const State& fine, const Watch& watch) {
  const CallBegin begin = call_begin();
  begin_unloaded();
  shell_->actuate(t, {}, load_scale_);
  const NestedReport nested = shell_->start(t, fine, watch);
  if (nested.end == Outcome::reached) set_progress(progress_at(t));
  return report(nested.end, nested.t, begin);
}

/// Removes what earlier commands left: a first state has the scene's own supports and loads alone.
void Simulation::begin_unloaded() {
  actuating_ = true;
  constraints_.clear();
  constraint_origins.clear();
  cases.clear();
  load_scale_ = 1;
  apply_field({});
  shell_->actuate(0, {}, load_scale_);
}

/// Sets the progress of the scene's motion and clears displacements of edge points.
void Simulation::set_progress(double progress) {
  progress_ = progress;
  dragged_.setZero(3, scene_->motion.begin.cols());
}

// ---- save and restore ----

/// Replaces meshes or rods and finds the equilibrium with them. If there is none, the old ones
/// remain. `nearby`: the equilibrium with new rods is searched for near the current state.
Result<Outcome> Simulation::replace_meshes(const LevelPlan& plan, bool nearby, const Watch& watch) {
  // during a joint actuation the meshes cannot change
  if (!nearby && shell_->outside(shell_->last()).opening != 0) return Outcome::too_coarse;
  TRY(built, build(plan));
  if (*built == shell_) return Outcome::reached;
  const std::shared_ptr<NestedShell> before = shell_;
  use(*built);
  shell_->set_fields(field_, {});
  const double t = actuating_ ? before->state().t : 0;
  State state = shell_->stay(*before, constraints_);
  if (actuating_) shell_->actuate(t, constraints_, load_scale_);
  // prescribed joints move to their extrapolated positions, those of all meshes
  shell_->motion().impose(shell_->system(), t, state);
  if (nearby)
    if (auto rest =
            find_equilibrium(shell_->system(), state, 0.5 * scene_->footprint.spacing, watch))
      state = std::move(*rest);
  // a state that is not stable need not be stable on the new meshes
  shell_->allow_unstable(before->state().inertia.negative_pivots > 0);
  Outcome end = shell_->start(t, state, watch).end;
  shell_->allow_unstable(false);
  if (watch.cancelled()) end = Outcome::cancelled;
  if (end != Outcome::reached) use(before);
  return end;
}

Checkpoint Simulation::save() const {
  return {shell_->state(),  shell_,    rods_,      shell_->motions(), constraints_,       field_,
          load_scale_,      progress_, actuating_, dragged_,          constraint_origins, cases,
          first_stiffness_, along_};
}

void Simulation::restore(const Checkpoint& kept) {
  if (kept.shell != shell_) {
    if (kept.rods.has_value() || rods_.has_value()) built_ = {kept.shell};
    rods_ = kept.rods;
    use(kept.shell);
  }
  constraints_ = kept.constraints;
  load_scale_ = kept.load_scale;
  progress_ = kept.progress;
  actuating_ = kept.actuating;
  dragged_ = kept.dragged;
  constraint_origins = kept.constraint_origins;
  cases = kept.cases;
  first_stiffness_ = kept.first_stiffness;
  along_ = kept.along;
  apply_field(kept.field);
  shell_->restore(kept.state, kept.motions, kept.constraints);
}

}  // namespace gridshell
