// How a state of the coarsest mesh is certified: finer meshes correct it, and what they add tells
// the error.
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

// what the estimates are multiplied by, so that they stay on the safe side of the true error.
// Measured on random circles (tests/engine/simulate/test_actuation.cpp): the plain estimate is
// within 10 % of the error, the extrapolated one falls short by up to 1.7 where the meshes are not
// quite in the asymptotic range
constexpr double margin = 1.25, margin_extrapolated = 2.2;
// of forces and energies on two meshes, of which one sign or the other may win
constexpr double margin_of_two = 1.4;

// largest sum of the weights of an extrapolation, by size: three states one step apart, gone on by
// one step, have 7, and so have two states gone on by three steps
constexpr double most_weight = 8;

// of a stiffness, whose factorisation stands one correction before the state: measured up to 2e-4
constexpr double stale_stiffness = 1e-3;

/// What extrapolation at second order leaves where three meshes show another: with steps between
/// them whose sizes have the ratio r, r = 4 at second order, |step| (1/(r - 1) - 1/3). Within
/// `near` of second order the difference is that of the next order, which is estimated by itself.
double left_by_order(const Eigen::Matrix3Xd& step, const Eigen::Matrix3Xd& before) {
  constexpr double near = 0.1;
  const double size = step.norm();
  if (size == 0) return 0;
  const double ratio = before.norm() / size;
  if (std::abs(ratio - 4) < 4 * near) return 0;
  if (ratio <= 1) return max_column_norm(step);
  return std::min(std::abs(1 / (ratio - 1) - 1.0 / 3), 1.0) * max_column_norm(step);
}

/// What extrapolation at second order leaves of a part of first order, as where joints resist the
/// spins of laths: of errors a + b of the finest mesh, b the first order's, steps are 3a + b and
/// 12a + 2b, and 2b/3 is left.
double left_of_first_order(const Eigen::Matrix3Xd& step, const Eigen::Matrix3Xd& before) {
  return max_column_norm((4 * step - before) / 3);
}

Eigen::VectorXd weights_of(std::span<const LevelCorrection> known, double t) {
  std::vector<double> at;
  for (const LevelCorrection& one : known) at.push_back(one.t);
  return polynomial_weights(at, t);
}

/// Nodes of a finer mesh on the edges of a coarser one: as these, they do not go through one
/// another.
Eigen::Matrix3Xd on_edges(const RodMesh& coarse, const Eigen::Matrix3Xd& x, const RodMesh& fine,
                          Eigen::Matrix3Xd nodes) {
  for (std::size_t r = 0; r < fine.rods.size(); ++r) {
    const std::vector<double>& s = coarse.position[r];
    std::size_t k = 1;
    for (std::size_t n = 0; n < fine.rods[r].size(); ++n) {
      const double at = fine.position[r][n];
      while (k + 1 < s.size() && s[k] < at) ++k;
      const double share = (at - s[k - 1]) / (s[k] - s[k - 1]);
      nodes.col(fine.rods[r][n]) =
          (1 - share) * x.col(coarse.rods[r][k - 1]) + share * x.col(coarse.rods[r][k]);
    }
  }
  return nodes;
}

}  // namespace

LevelCorrection NestedShell::correction_of(const Level& level, double t, const State& base,
                                           const State& state) const {
  // angles are counted from frames that each carry makes anew: only nodes are remembered
  LevelCorrection added{t, (state.x - base.x).cast<float>(),
                        (state.force - base.force).cast<float>()};
  added.x.rightCols(level.model.columns() - level.model.nodes).setZero();
  return added;
}

/// What an error of second order has level k add: a quarter of what the level below added.
LevelCorrection NestedShell::expected_correction(std::size_t k,
                                                 const LevelCorrection& below) const {
  const Level& level = *levels_[k];
  LevelCorrection quarter{below.t, Eigen::Matrix3Xf::Zero(3, level.model.columns()),
                          Eigen::VectorXf::Zero(Eigen::Index(level.model.edges.size()))};
  if (below.x.size() == 0) return quarter;
  const Level& coarser = *levels_[k - 1];
  const MeshTransfer& from = level.from_coarser->meshes();
  Eigen::Matrix3Xd nodes;
  Eigen::VectorXd force;
  from.nodes(nodes_of(coarser.mesh, coarser.model, below.x.cast<double>()), nodes);
  from.edges(below.force.cast<double>(), force);
  quarter.x = (columns_of(level.mesh, level.model, nodes) / 4).cast<float>();
  quarter.force = (force / 4).cast<float>();
  return quarter;
}

bool NestedShell::correct(Level& level, const State& base, State& state, NewtonReport& report,
                          const Watch& watch) {
  NewtonOptions options;
  options.tolerance_mm = options_.tolerance_mm;
  options.widest_turn = options_.widest_turn;
  options.trusted_mm = options_.tolerance_mm;
  // what a correction leaves strains the rods: a force that is seen beside the finest state
  if (&level == levels_.back().get()) options.trusted_misfit = 1e-5;
  report = newton(*level.system, state, options, watch);
  if (report.outcome != Outcome::reached) return false;
  // a finer mesh moves no node by a cell, or it went to another state
  const int nodes = level.model.nodes;
  return max_column_norm(state.x.leftCols(nodes) - base.x.leftCols(nodes)) <
         0.5 * options_.spacing_mm;
}

/// What the mesh added beside the quarter that is expected carries on along the path, by the
/// polynomial through the last states; fewer of them where it would make too much of their
/// differences.
State NestedShell::guess(const Level& level, double t, const State& base,
                         LevelCorrection expected) const {
  std::span<const LevelCorrection> known = level.beyond;
  Eigen::VectorXd weights = weights_of(known, t);
  while (known.size() > 1 && !(weights.cwiseAbs().sum() < most_weight)) {
    known = known.subspan(1);
    weights = weights_of(known, t);
  }
  for (std::size_t k = 0; k < known.size(); ++k) {
    expected.x += float(weights[Eigen::Index(k)]) * known[k].x;
    expected.force += float(weights[Eigen::Index(k)]) * known[k].force;
  }
  State state = base;
  state.force += expected.force.cast<double>();
  move_to(level.model, base.x + expected.x.cast<double>(), state);
  return state;
}

/// A level's state beside that of the coarser one. Up to three tries: Newton from the guess, Newton
/// from the coarser state, and down the energy from there; the first counts that finds a state
/// nearby, of the kind that is preferred if there is one.
std::optional<NestedShell::Refined> NestedShell::refine(std::size_t k, double t,
                                                        const Refined& coarser, Prefer prefer,
                                                        const Watch& watch) {
  enum class From { remembered, coarser, down };
  Level& level = *levels_[k];
  const State base = level.from_coarser->carry(coarser.state);
  const LevelCorrection expected = expected_correction(k, coarser.added);
  std::optional<Refined> found;
  for (const From from : {From::remembered, From::coarser, From::down}) {
    State trial = from == From::remembered ? guess(level, t, base, expected) : base;
    if (level.model.contact.any()) {
      const Level& below = *levels_[k - 1];
      State clear = base;
      move_to(level.model,
              columns_of(level.mesh, level.model,
                         on_edges(below.mesh, nodes_of(below.mesh, below.model, coarser.state.x),
                                  level.mesh, nodes_of(level.mesh, level.model, base.x))),
              clear);
      const Eigen::Matrix3Xd way = trial.x - clear.x;
      move_to(level.model, clear.x + level.system->clear_share(clear, way) * way, trial);
    }
    level.motion.impose(*level.system, t, trial);
    if (from == From::down) minimise(*level.system, trial, {.most_iterations = 60}, watch);
    NewtonReport tried;
    if (watch.cancelled()) return {};
    if (!correct(level, base, trial, tried, watch)) continue;
    const bool stable =
        prefer == Prefer::stable && inertia_of(level, trial, tried).positive_definite();
    if (found && !stable) continue;
    found = Refined{std::move(trial), {}, tried};
    if (stable || prefer == Prefer::first) break;
  }
  if (!found) return {};
  found->added = correction_of(level, t, base, found->state);
  level.beyond.push_back(found->added - expected);
  if (level.beyond.size() > 3) level.beyond.erase(level.beyond.begin());
  return found;
}

NestedReport NestedShell::certify(double t, const PathPoint& coarse, const NewtonReport& last,
                                  Prefer prefer, const Watch& watch) {
  // where states that are not stable are wanted too, none is preferred
  if (options_.allow_unstable) prefer = Prefer::first;
  NestedState next;
  next.t = t;
  Refined at{coarse.state, {}, last};
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    auto finer = refine(k, t, at, prefer, watch);
    if (watch.cancelled()) return {Outcome::cancelled, state_.t};
    if (!finer) return {Outcome::meshes_disagree, state_.t};
    next.levels.push_back(std::exchange(at, std::move(*finer)).state);
  }
  next.levels.push_back(std::move(at.state));
  NestedState before = std::exchange(state_, std::move(next));
  finish(at.report);
  if (state_.inertia.positive_definite()) return {Outcome::reached, t};
  if (state_.inertia.usable && options_.allow_unstable) return {Outcome::reached, t};
  // what is not certified takes no certified state's place
  const Outcome end = state_.inertia.usable ? Outcome::unstable : Outcome::not_finite;
  state_ = std::move(before);
  return {end, state_.t};
}

/// At the end of a path, and where a force is measured, the residual goes down to what round-off
/// leaves: corrections are cheap. The assembly ends at the state found.
void NestedShell::polish(Level& finest, State& found) {
  Linearisation& system = *finest.system;
  system.gradient_at(found);
  if (state_.t < 1 && system.holds().empty()) return;
  Eigen::Matrix3Xd dx;
  for (int k = 0; k < 4 && state_.inertia.usable; ++k) {
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

/// The factorisation of the last correction is the state's own but for that correction; where it
/// moved the state too far to vouch for it, the energy's Hessian there is factorised anew.
Inertia NestedShell::inertia_of(Level& level, const State& found,
                                const NewtonReport& report) const {
  constexpr double same_state = 1e-3;  // of d
  const bool near = report.factored_move_mm <= same_state * options_.spacing_mm;
  if (near && report.inertia.positive_definite()) return report.inertia;
  return level.system->at(found, false);
}

/// Certificate of the finest level, error estimate, extrapolation.
void NestedShell::finish(const NewtonReport& report) {
  Level& finest = *levels_.back();
  State& found = state_.levels.back();
  state_.inertia = inertia_of(finest, found, report);
  polish(finest, found);
  state_.residual_N = finest.system->residual();
  state_.largest_strain = finest.system->assembly().largest_strain;
  if (!finest.system->holds().empty()) take_reactions();
  estimate();
}

void NestedShell::estimate() {
  const std::size_t last = levels_.size() - 1;
  const Level& finest = *levels_[last];
  const auto nodes = [&](std::size_t k) {
    return nodes_of(levels_[k]->mesh, levels_[k]->model, state_.levels[k].x);
  };
  state_.x = nodes(last);
  state_.error_estimate_mm = std::numeric_limits<double>::quiet_NaN();
  if (last == 0) return;

  const Eigen::Matrix3Xd coarser = nodes(last - 1);
  const int joints = finest.mesh.joints;
  const Eigen::Matrix3Xd step = state_.x.leftCols(joints) - coarser.leftCols(joints);
  const bool two = !plan_.extrapolate || last < 2;  // are looked at
  if (order_unknown(finest.model, finest.system->assembly().energies, two ? 2 : 3)) {
    state_.error_estimate_mm = margin * max_column_norm(step) + options_.tolerance_mm;
    return;
  }
  if (two) {
    state_.error_estimate_mm = margin * max_column_norm(step) / 3 + options_.tolerance_mm;
    return;
  }
  // (4 fine - coarse)/3 of these two meshes less that of the two before
  const Eigen::Matrix3Xd before = coarser.leftCols(joints) - nodes(last - 2).leftCols(joints);
  state_.error_estimate_mm =
      std::max(margin_extrapolated * max_column_norm((4 * step - before) / 3) / 15,
               margin * left_by_order(step, before)) +
      options_.tolerance_mm;  // corrections stop there
  if (!finest.model.joint_spins.empty())
    state_.error_estimate_mm =
        std::max(state_.error_estimate_mm, left_of_first_order(step, before));
  // the correction is known at the coarser nodes; between them it is interpolated
  Eigen::Matrix3Xd on_coarser, correction;
  finest.to_coarser->nodes(state_.x, on_coarser);
  finest.from_coarser->meshes().nodes((on_coarser - coarser) / 3, correction);
  state_.x += correction;
}

bool order_unknown(const Model& model, const Energies& energies, std::size_t meshes) {
  return energies[Term::contact] > 0 || (meshes == 2 && !model.joint_spins.empty());
}

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

CertifiedVectors certify_vectors(const Model& model, const std::vector<Eigen::Matrix3Xd>& levels,
                                 bool extrapolate, bool no_order) {
  CertifiedVectors found = certify_vectors(levels, extrapolate, no_order);
  if (levels.size() == 3 && !model.joint_spins.empty())
    found.error =
        std::max(found.error, left_of_first_order(levels[2] - levels[1], levels[1] - levels[0]));
  return found;
}

/// What each level says of its held joints. The stiffness is that of its last factorisation, which
/// on finer meshes stands a correction away.
void NestedShell::take_reactions() {
  Linearisation& finest = *levels_.back()->system;
  const std::vector<Constraint>& holds = finest.holds();
  std::vector<Eigen::Matrix3Xd> forces, stiffness;
  for (std::size_t k = std::size_t(first_of_last_three()); k < levels_.size(); ++k) {
    Linearisation& system = *levels_[k]->system;
    if (&system != &finest) {
      system.outside.load = finest.outside.load;
      system.outside.field_factor = finest.outside.field_factor;
      system.outside.opening = finest.outside.opening;
      // the path's own factorisation may stand a load step away
      if (k == 0)
        system.at(state_.levels[k], false);
      else
        system.gradient_at(state_.levels[k]);
    }
    Eigen::Matrix3Xd& on = forces.emplace_back(3, Eigen::Index(holds.size()));
    for (std::size_t h = 0; h < holds.size(); ++h)
      on.col(Eigen::Index(h)) = system.reaction(holds[h]);
    state_.held_stiffness = system.held_stiffness();
    const auto entries = state_.held_stiffness.reshaped().transpose();
    stiffness.emplace_back(Eigen::Matrix3Xd::Zero(3, entries.cols())).row(0) = entries;
  }
  const bool no_order =
      order_unknown(levels_.back()->model, finest.assembly().energies, forces.size());
  const CertifiedVectors force = certify_vectors(levels_.back()->model, forces,
                                                 plan_.extrapolate_forces, no_order),
                         growth = certify_vectors(stiffness, plan_.extrapolate_forces, no_order);
  state_.reactions.clear();
  for (const auto& on : force.value.colwise()) state_.reactions.emplace_back(on);
  state_.reaction_error_N = force.error;
  state_.held_stiffness.reshaped() = growth.value.row(0).transpose();
  state_.stiffness_error_N_per_mm = growth.error + stale_stiffness * max_column_norm(growth.value);
}

}  // namespace gridshell
