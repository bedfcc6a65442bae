#include "engine/study/multilevel_relaxation.h"

#include <algorithm>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/solve/buckling.h"

namespace gridshell {
namespace {

constexpr double coarse_mm = 0.03;  // tolerance on coarse meshes
constexpr int most_coarse = 200;    // most iterations on each coarse mesh
constexpr double push_off = 0.1;    // displacement from an unstable equilibrium, in d

/// Makes the positions symmetric: their mean over the images under the group.
void confine(const Model& model, const RodMesh& mesh, const std::vector<MeshSymmetry>& group,
             State& state) {
  const Eigen::Matrix3Xd nodes = nodes_of(mesh, model, state.x);
  Eigen::Matrix3Xd x = state.x;
  const Eigen::Matrix3Xd columns = columns_of(mesh, model, symmetric_part(nodes, group));
  x.leftCols(model.nodes) = columns.leftCols(model.nodes);
  move_to(model, x, state);
}

/// Minimises the energy by the fast method; if that does not converge, by the slow one.
Result<State> rest_from_rough(Linearisation& system, State state, const Watch& watch) {
  if (minimise(system, state, {.rough = true}, watch).outcome == Outcome::reached) return state;
  return minimise_from(system, std::move(state), watch);
}

std::vector<MeshSymmetry> members(const std::vector<MeshSymmetry>& all,
                                  const std::vector<int>& group) {
  std::vector<MeshSymmetry> found;
  for (const MeshSymmetry& symmetry : all)
    if (std::ranges::find(group, symmetry.index) != group.end()) found.push_back(symmetry);
  return found;
}

}  // namespace

MultilevelRelaxation::MultilevelRelaxation(const FlatFrame& flat, double spacing_mm)
    : flat_(flat), spacing_mm_(spacing_mm) {}

Result<MultilevelRelaxation> MultilevelRelaxation::make(const Footprint& footprint,
                                                        const ShellRods& rods, RodModel rod_model,
                                                        const BoundaryMotion& motion,
                                                        const FlatFrame& flat, int edges) {
  MultilevelRelaxation cascade(flat, footprint.spacing);
  for (int k = 1; k <= edges; k *= 2) {
    auto level = std::make_unique<Level>();
    TRY_DO(level->build(footprint, rods, rod_model, motion, k));
    level->symmetries = symmetries_of(level->mesh, level->motion.at(1));
    if (k > 1) {
      const Level& coarser = *cascade.levels_.back();
      level->from_coarser =
          std::make_unique<StateTransfer>(coarser.mesh, coarser.model, level->mesh, level->model);
    }
    cascade.levels_.push_back(std::move(level));
  }
  return cascade;
}

Eigen::Matrix3Xd MultilevelRelaxation::stretched_flat(double t) const {
  const RodMesh& mesh = levels_.front()->mesh;
  const auto with_one = [](const Eigen::Matrix2Xd& flat) {
    Eigen::MatrixXd rows(flat.cols(), 3);
    rows << flat.transpose(), Eigen::VectorXd::Ones(flat.cols());
    return rows;
  };
  std::vector<int> on_boundary = mesh.fixed_joints;
  for (int end = 0; end < mesh.edge_points; ++end)
    if (mesh.end_of(end) != RodEnd::joined) on_boundary.push_back(mesh.joints + end);
  const Eigen::Matrix3Xd moved = levels_.front()->motion.at(t);
  Eigen::Matrix3Xd ends(3, on_boundary.size());
  Eigen::Matrix2Xd flat(2, on_boundary.size());
  for (std::size_t k = 0; k < on_boundary.size(); ++k) {
    ends.col(Eigen::Index(k)) = moved.col(on_boundary[k]);
    flat.col(Eigen::Index(k)) = mesh.flat.col(on_boundary[k]);
    // the affine map is that of the plane; heights above it are added to its image
    if (mesh.height.size() > 0) ends(2, Eigen::Index(k)) -= mesh.height[on_boundary[k]];
  }
  const Eigen::MatrixXd affine = least_squares(with_one(flat), ends.transpose());
  Eigen::Matrix3Xd nodes = (with_one(mesh.flat) * affine).transpose();
  if (mesh.height.size() > 0) nodes.row(2) += mesh.height;
  return nodes;
}

/// The state from which a level starts: the given nodes, or on a finer level the result of the
/// coarser one.
State MultilevelRelaxation::begin_of(const Level& level, double t, const Eigen::Matrix3Xd& nodes,
                                     const State& coarser) const {
  State state = level.from_coarser ? level.from_coarser->carry(coarser)
                                   : flat_state(level.model, level.mesh, level.motion, flat_);
  if (!level.from_coarser) move_to(level.model, columns_of(level.mesh, level.model, nodes), state);
  level.motion.impose(*level.system, t, state);
  return state;
}

Result<State> MultilevelRelaxation::rest(double t, const Eigen::Matrix3Xd& nodes,
                                         const Watch& watch) {
  State state;
  for (auto& level : levels_) {
    state = begin_of(*level, t, nodes, state);
    if (level == levels_.back()) break;
    // the outcome on a coarse mesh does not matter: its result is smoother in any case
    minimise(*level->system, state,
             {.tolerance_mm = coarse_mm, .most_iterations = most_coarse, .rough = true}, watch);
  }
  return rest_from_rough(*levels_.back()->system, std::move(state), watch);
}

Result<State> MultilevelRelaxation::rest_under(const std::vector<NodeAction>& forces, double t,
                                               State state, const Watch& watch) {
  Level& finest = *levels_.back();
  finest.motion.impose(*finest.system, t, state);
  const SetForScope applied(finest.system->outside.steady, &forces);
  return rest_from_rough(*finest.system, std::move(state), watch);
}

/// Newton's method, in full steps, to the equilibrium nearby, stable or not. Returns false and
/// leaves the state as it is if there is none.
bool MultilevelRelaxation::step_to_equilibrium(Level& level, State& state,
                                               const Watch& watch) const {
  State found = state;
  NewtonOptions options;
  options.farthest_mm = 0.25 * spacing_mm_;
  if (newton(*level.system, found, options, watch).outcome != Outcome::reached) return false;
  state = std::move(found);
  return true;
}

/// Minimises the energy among states with the symmetries of the group. Round-off grows along modes
/// that break a symmetry, so the state is made symmetric again every few iterations.
void MultilevelRelaxation::down(Level& level, const std::vector<MeshSymmetry>& group, State& state,
                                const Watch& watch) const {
  constexpr int steps = 10, most_rounds = 20;
  for (int round = 0; round < most_rounds && !watch.cancelled(); ++round) {
    confine(level.model, level.mesh, group, state);
    if (step_to_equilibrium(level, state, watch)) break;
    const NewtonReport report =
        minimise(*level.system, state,
                 {.tolerance_mm = coarse_mm, .most_iterations = steps, .rough = true}, watch);
    if (report.outcome == Outcome::not_finite) break;
  }
  confine(level.model, level.mesh, group, state);
}

Result<State> MultilevelRelaxation::rest_confined(double t, const Eigen::Matrix3Xd& nodes,
                                                  const std::vector<int>& group,
                                                  const Watch& watch) {
  State state;
  for (auto& level : levels_) {
    state = begin_of(*level, t, nodes, state);
    down(*level, members(level->symmetries, group), state, watch);
  }
  Level& finest = *levels_.back();
  step_to_equilibrium(finest, state, watch);
  if (finest.system->at(state, false).positive_definite()) return state;
  return let_go(finest, std::move(state), watch);
}

/// Descends from an unstable equilibrium along its lowest mode; the Hessian of the level's system
/// is that of this state. Any state it reaches will do, so the slow method of leave_saddle() is not
/// needed.
Result<State> MultilevelRelaxation::let_go(Level& level, State state, const Watch& watch) const {
  Eigen::Matrix3Xd mode = softest_mode(*level.system, {}, watch);
  mode *= push_off * spacing_mm_ / max_column_norm(mode);
  move_to(level.model, state.x + mode, state);
  return rest_from_rough(*level.system, std::move(state), watch);
}

}  // namespace gridshell
