// How a state of the finest mesh is certified: residual, stability, error.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {
namespace {

// factors on the estimates, so that they are rarely below the true error. Measured on random
// circles (tests/engine/simulate/test_actuation.cpp): the plain estimate is within 10 % of the
// error; the extrapolated one is too small by a factor of up to 1.7 where the meshes are not quite
// in the asymptotic range
constexpr double margin = 1.25, margin_extrapolated = 2.2;
// factor for forces and energies on two meshes: their errors have parts of both signs, which may
// cancel in the difference
constexpr double margin_of_two = 1.4;

// relative error of a stiffness by the factorisation one correction before the state: measured up
// to 2e-4
constexpr double stale_stiffness = 1e-3;

/// Error that extrapolation at second order leaves where three meshes show another order, mm. With
/// `before` the difference of the two coarser meshes, `step` that of the two finer ones and r the
/// ratio of their sizes (4 at second order) it is |step| |1/(r - 1) - 1/3|, at most |step|. It is 0
/// if r is within the fraction `near` of 4: the remaining error is of the next order, which is
/// estimated separately.
double left_by_order(const Eigen::Matrix3Xd& step, const Eigen::Matrix3Xd& before) {
  constexpr double near = 0.1;
  const double size = step.norm();
  if (size == 0) return 0;
  const double ratio = before.norm() / size;
  if (std::abs(ratio - 4) < 4 * near) return 0;
  if (ratio <= 1) return max_column_norm(step);
  return std::min(std::abs(1 / (ratio - 1) - 1.0 / 3), 1.0) * max_column_norm(step);
}

constexpr double roughly = 0.02;  // relative accuracy of the lowest eigenvalue: its trend is used

/// Whether moments act between the rods of a joint.
bool passes_moments(const Model& model) {
  return !model.hinges.empty() || !model.followers.empty() ||
         !std::get<std::vector<Pair<JointSpin>>>(model.pairs).empty();
}

/// Length of rod lumped at each node, mm.
Eigen::VectorXd unit_length(const RodMesh& mesh) {
  return lumped(mesh, std::vector<double>(mesh.rods.size(), 1.0));
}

}  // namespace

void NestedShell::watch_stability(bool watches, const Watch& watch) {
  watches_stability_ = watches;
  if (!watches || !state_.inertia.positive_definite() || !std::isnan(state_.lowest_eigenvalue))
    return;
  Level& finest = *levels_.back();
  state_.lowest_eigenvalue = lowest_eigenvalue(*finest.system, state_.levels.back(),
                                               unit_length(finest.mesh), watch, roughly);
}

bool NestedShell::stability_confirmed(const Watch& watch) {
  const int companion = last() - 1;
  if (companion < 0 || state_.measured > companion || !state_.inertia.positive_definite())
    return true;
  Level& level = *levels_[std::size_t(companion)];
  const State& state = state_.levels[std::size_t(companion)];
  level.motion.apply_loads(*level.system, state_.t);
  const double coarse =
      lowest_eigenvalue(*level.system, state, unit_length(level.mesh), watch, roughly);
  // a coarse eigenvalue below the fine one confirms stability, as finer meshes have larger ones; so
  // does NaN, that of an unstable coarse mesh
  return !(state_.lowest_eigenvalue < margin * (coarse - state_.lowest_eigenvalue) / 3);
}

NestedReport NestedShell::certify(const PathFollower& path, const Watch& watch,
                                  const Inertia& known) {
  const PathPoint& point = path.point();
  NestedState before = std::exchange(state_, {});
  const auto refused = [&](Outcome end) {
    // the last certified state remains
    state_ = std::move(before);
    return NestedReport{end, state_.t};
  };
  state_.t = point.t;
  state_.levels.resize(levels_.size());
  state_.levels.back() = point.state;
  state_.velocity = point.velocity;
  state_.step = point.step;
  Level& finest = *levels_.back();
  State& found = state_.levels.back();
  const bool again = !known.usable && !vouches(path.last());
  state_.inertia = known.usable ? known : inertia_of(finest, found, path.last());
  if (!state_.inertia.usable) return refused(Outcome::not_finite);
  if (!state_.inertia.positive_definite() && !options_.allow_unstable)
    return refused(Outcome::unstable);
  polish(finest, found, path.last());
  if (!known.usable && state_.velocity.x.size() > 0) {
    if (again)
      finest.motion.velocity(*finest.system, state_.t, found, state_.velocity);
    else
      refine_velocity(finest, found);
  }
  state_.residual_N = finest.system->residual();
  state_.largest_strain = finest.system->assembly().largest_strain;
  const Energies energies = finest.system->assembly().energies;
  if (watches_stability_ && state_.inertia.positive_definite()) {
    Eigen::Matrix3Xd mode = before.lowest_mode.cast<double>();
    state_.lowest_eigenvalue =
        lowest_eigenvalue(*finest.system, unit_length(finest.mesh), mode, watch, roughly);
    state_.lowest_mode = mode.cast<float>();
  }
  measure(watch, before);
  if (watch.cancelled()) return refused(Outcome::cancelled);
  estimate(energies);
  return {Outcome::reached, state_.t};
}

/// Reduces the residual by further corrections with the factorisation at hand. At the end of a
/// path, and where a force is measured, it is reduced to round-off. Elsewhere one correction is
/// made, if the last one was above the tolerance (a direction of low stiffness may need another of
/// its size) or if axial forces and strains disagree by more than `misfit`. The assembly is then
/// that of the state found.
void NestedShell::polish(Level& finest, State& found, const NewtonReport& last) {
  constexpr double misfit = 1e-5;  // fraction of the largest axial force
  Linearisation& system = *finest.system;
  system.gradient_at(found);
  const bool to_the_end = state_.t >= 1 || !system.constraints().empty(),
             trusted = last.last_move_mm > options_.tolerance_mm;
  if (!to_the_end && !trusted && system.forces_agree(found, misfit)) return;
  const int most = to_the_end ? 4 : 1;
  Eigen::Matrix3Xd dx;
  for (int k = 0; k < most && state_.inertia.usable; ++k) {
    const double residual = system.residual();
    if (residual < 1e-9) return;
    State trial = found;
    if (k < 2)
      system.residual_at(trial);
    else
      system.at(trial);
    system.correction(dx);
    system.apply(dx, trial);
    system.gradient_at(trial);
    if (!(system.residual() < residual)) {
      system.gradient_at(found);
      return;
    }
    found = std::move(trial);
  }
}

/// Computes the path's tangent at the state itself, by a central difference: the known velocity is
/// that of the factorisation, one correction before the state. The states before and after,
/// predicted by that velocity, are corrected once. The assembly is then that of the state.
void NestedShell::refine_velocity(Level& finest, const State& found) {
  constexpr double offset = 2e-4;  // step of the difference, in t
  Linearisation& system = *finest.system;
  const State velocity = state_.velocity;
  state_.velocity.x.setZero();
  state_.velocity.force.setZero();
  Eigen::Matrix3Xd dx;
  for (const double sign : {-1.0, 1.0}) {
    State neighbour = found;
    neighbour.force += sign * offset * velocity.force;
    move_to(finest.model, found.x + sign * offset * velocity.x, neighbour);
    finest.motion.impose(system, state_.t + sign * offset, neighbour);
    system.residual_at(neighbour);
    system.correction(dx);
    system.apply(dx, neighbour);
    state_.velocity.x += sign / (2 * offset) * neighbour.x;
    state_.velocity.force += sign / (2 * offset) * neighbour.force;
  }
  finest.motion.apply_loads(system, state_.t);
  system.gradient_at(found);
}

/// Whether the factorisation of the last correction, one correction before the state, is near
/// enough to it to decide whether it is stable.
bool NestedShell::vouches(const NewtonReport& report) const {
  constexpr double same_state = 1e-3;  // in units of d
  return report.factored_move_mm <= same_state * options_.spacing_mm &&
         report.inertia.positive_definite();
}

/// The inertia of the last correction's factorisation, or of the energy's Hessian at the state,
/// factorised again.
Inertia NestedShell::inertia_of(Level& level, const State& found,
                                const NewtonReport& report) const {
  if (vouches(report)) return report.inertia;
  Inertia inertia = level.system->at(found, false);
  // the sign of a pivot along a direction without stiffness depends on the remaining residual
  if (inertia.usable && !inertia.positive_definite() && level.system->neutral_shift() > 0) {
    State exact = found;
    if (newton(*level.system, exact, {.tolerance_mm = 1e-3 * options_.tolerance_mm}, unwatched)
            .outcome == Outcome::reached)
      inertia = level.system->at(exact, false);
  }
  return inertia;
}

/// Computes the largest error of all nodes from the differences of the meshes at their common
/// nodes, and extrapolates the positions if that is planned.
void NestedShell::estimate(const Energies& energies) {
  const auto last = std::size_t(this->last());
  const Level& finest = *levels_.back();
  const auto nodes = [&](std::size_t k) {
    return nodes_of(levels_[k]->mesh, levels_[k]->model, state_.levels[k].x);
  };
  // nodes of the finer level less those of level k, at the nodes that both levels have
  const auto step_to = [&](std::size_t k, const Eigen::Matrix3Xd& finer) -> Eigen::Matrix3Xd {
    Eigen::Matrix3Xd on_coarser;
    levels_[k]->from_finer->meshes().nodes(finer, on_coarser);
    return on_coarser - nodes(k);
  };
  const auto largest = [](const RodMesh& mesh, const Eigen::Matrix3Xd& x) {
    return max_column_norm(x.leftCols(mesh.rod_nodes()));
  };
  state_.x = nodes(last);
  state_.error_estimate_mm = std::numeric_limits<double>::quiet_NaN();
  if (state_.measured == int(last)) return;

  const RodMesh& companion = levels_[last - 1]->mesh;
  const Eigen::Matrix3Xd step = step_to(last - 1, state_.x);
  const bool no_order = order_unknown(energies);
  // the tolerance is added, as Newton's method stops there
  state_.error_estimate_mm =
      margin * largest(companion, step) / (no_order ? 1 : 3) + options_.tolerance_mm;
  if (no_order || !extrapolates()) return;
  // the correction is known at the companion's nodes; between them it is interpolated
  Eigen::Matrix3Xd correction;
  finest.from_coarser->meshes().nodes(step / 3, correction);
  state_.x += correction;
  // without a third mesh the error that remains is not known, only that of the finest mesh
  if (state_.measured + 2 > int(last)) return;
  // the extrapolated positions (4 fine - coarse)/3 of the two finer meshes less those of the two
  // coarser ones, at the nodes of all three
  const Eigen::Index shared = levels_[last - 2]->mesh.rod_nodes();
  Eigen::Matrix3Xd restricted;
  levels_[last - 2]->from_finer->meshes().nodes(step, restricted);
  const Eigen::Matrix3Xd now = restricted.leftCols(shared),
                         before = step_to(last - 2, nodes(last - 1)).leftCols(shared);
  state_.error_estimate_mm =
      std::max(margin_extrapolated * max_column_norm((4 * now - before) / 3) / 15,
               margin * left_by_order(now, before)) +
      options_.tolerance_mm;
}

bool order_unknown(const Energies& energies) { return energies[Term::contact] > 0; }

CertifiedVectors certify_vectors(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                 bool no_order) {
  const std::size_t last = levels.size() - 1;
  CertifiedVectors found{levels[last], std::numeric_limits<double>::quiet_NaN()};
  if (last == 0) return found;
  const Eigen::Matrix3Xd step = levels[last] - levels[last - 1];
  if (extrapolate) found.value = (4 * levels[last] - levels[last - 1]) / 3;
  found.error = (last == 1 ? margin_of_two : margin) * max_column_norm(step) / (no_order ? 1 : 3);
  if (last == 1 || no_order) return found;
  const Eigen::Matrix3Xd before = levels[last - 1] - levels[last - 2];
  const double by_order = margin * left_by_order(step, before);
  found.error =
      extrapolate
          ? std::max(margin_extrapolated * max_column_norm((4 * step - before) / 3) / 15, by_order)
          : found.error + by_order;
  return found;
}

CertifiedVectors certify_forces(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                const Model& model, const Energies& energies) {
  CertifiedVectors found = certify_vectors(levels, extrapolate, order_unknown(energies));
  // of a difference what errors of several orders may hide; of 480 random networks two forces were
  // off by 0.08 and 0.11 of it, 4.5 times the estimate
  constexpr double hidden_on_three = 0.08;
  if (passes_moments(model) && levels.size() > 1)
    found.error = std::max(found.error, (levels.size() == 2 ? 1 : hidden_on_three) *
                                            max_column_norm(levels.end()[-1] - levels.end()[-2]));
  return found;
}

double least_energy_error(const Model& model, const Energies& energies, int edges_per_segment) {
  const bool clamped = std::ranges::any_of(
      model.rods, [](const Model::Rod& rod) { return rod.ghost_begin >= 0 || rod.ghost_end >= 0; });
  if (!passes_moments(model) && !clamped) return 0;
  return 0.04 * std::pow(4.0 / edges_per_segment, 3) *
         (energies[Term::bend] + energies[Term::twist]);
}

/// Forces at the prescribed joints of a level, and their stiffness by its last factorisation, which
/// is one correction before the state.
NestedShell::ConstraintForces NestedShell::constraint_forces(Level& level,
                                                             const State& state) const {
  Linearisation& system = *level.system;
  system.gradient_at(state);
  const std::vector<Constraint>& constraints = system.constraints();
  ConstraintForces found{Eigen::Matrix3Xd(3, Eigen::Index(constraints.size())), {}};
  for (std::size_t k = 0; k < constraints.size(); ++k)
    found.force.col(Eigen::Index(k)) = system.reaction(constraints[k]);
  found.stiffness = system.constraint_stiffness();
  return found;
}

/// Sets reactions and their stiffness, with errors, from those of `levels`, coarse to fine.
void NestedShell::take_reactions(const std::vector<ConstraintForces>& levels) {
  std::vector<Eigen::Matrix3Xd> forces, stiffness;
  for (const ConstraintForces& level : levels) {
    forces.push_back(level.force);
    const auto entries = level.stiffness.reshaped().transpose();
    stiffness.emplace_back(Eigen::Matrix3Xd::Zero(3, entries.cols())).row(0) = entries;
  }
  const Level& finest = *levels_.back();
  const bool extrapolate = extrapolates();
  const Energies& energies = finest.system->assembly().energies;
  const CertifiedVectors force = certify_forces(forces, extrapolate, finest.model, energies),
                         tangent = certify_vectors(stiffness, extrapolate, order_unknown(energies));
  state_.reactions.clear();
  for (const auto& reaction : force.value.colwise()) state_.reactions.emplace_back(reaction);
  state_.reaction_error_N = force.error;
  state_.constraint_stiffness = levels.back().stiffness;
  state_.constraint_stiffness.reshaped() = tangent.value.row(0).transpose();
  state_.stiffness_error_N_per_mm =
      tangent.error + stale_stiffness * max_column_norm(tangent.value);
}

}  // namespace gridshell
