// NestedShell: the equilibrium path of one gridshell on nested meshes. The finest mesh is followed;
// the differences to the coarser ones give the error estimate or are removed by extrapolation
// [Richardson 1911].
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/state.h"
#include "engine/solve/equilibrium_path.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {

/// One certified state on all mesh levels. NestedShell computes it in start(), advance() and
/// sample().
struct NestedState {
  /// Path parameter: sqrt(progress) in an actuation, 0 to 1 in a drive.
  double t = 0;
  /// States of the levels, coarse to fine. A coarser level without an equilibrium near the finer
  /// state has the finer state restricted to its mesh.
  std::vector<State> levels;
  int measured = 0;    ///< the coarsest level in equilibrium whose finer levels all are, too
  Eigen::Matrix3Xd x;  ///< 3 x nodes of the finest mesh, mm, extrapolated where planned
  double error_estimate_mm = 0;  ///< largest error of all columns of x; NaN without a coarser state
  double residual_N = 0;         ///< largest unbalanced force on the finest level
  Inertia inertia;               ///< numbers of pivots by sign of the finest level's Hessian
  double largest_strain = 0;     ///< axial strain of largest magnitude, with its sign
  /// Reactions at the constraints, N, extrapolated where planned, and the largest error.
  std::vector<Eigen::Vector3d> reactions;
  double reaction_error_N = std::numeric_limits<double>::quiet_NaN();
  /// Derivative of the reactions' constrained components by the constrained displacements, N/mm, in
  /// the order of the constraints and their directions, and its largest error.
  Eigen::MatrixXd constraint_stiffness;
  double stiffness_error_N_per_mm = std::numeric_limits<double>::quiet_NaN();
  State velocity;                       ///< derivative of the finest level's state by t
  double step = PathPoint::first_step;  ///< step in t with which the path continues
  /// Lowest eigenvalue of the finest level's Hessian, N/mm^2 (lowest_eigenvalue()), approximate;
  /// NaN if not requested or not stable.
  double lowest_eigenvalue = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xf lowest_mode = {};  ///< its eigenvector, 3 x columns of the finest model
};

/// Vectors computed on nested meshes: those of the finest or, extrapolated, (4 fine - coarse)/3 of
/// the last two.
struct CertifiedVectors {
  /// 3 x as many columns as each level has, in the unit of the levels.
  Eigen::Matrix3Xd value;
  /// largest error of a column, by the observed order of three meshes; NaN on one mesh
  double error = 0;
};

/// Whether meshes show no order of convergence: contact forces show none, since the element on
/// which they act varies with the mesh. `energies`: of the finest mesh, mJ.
bool order_unknown(const Energies& energies);

/// Value and error from `levels`, coarse to fine, of which the last three are used. Without a known
/// order the error is the complete difference of the last two.
CertifiedVectors certify_vectors(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                 bool no_order);

/// Reactions of constrained nodes, N, or energies, mJ, from `levels`. On two meshes of a model
/// whose joints pass moments the error is the complete difference: the moment at a joint bends the
/// legs next to it, and at four edges per segment errors of second to fourth order may cancel
/// there. On three meshes it is at least 0.05 of the last difference.
CertifiedVectors certify_forces(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                const Model& model, const Energies& energies);

/// Least error that is reported of energies, mJ: 0 where joints pass no moments, else
/// 0.04 (4/k)^3 of the bending and torsion energy, for k edges per segment. A moment at a joint
/// leaves errors of second to fourth order, which may cancel in the differences of the meshes but
/// not in the energies: of 120 random networks two differed by 0.0024 (k = 8) and 0.0005 (k = 16)
/// of their energy, by six and eight times the estimate from the differences.
double least_energy_error(const Model& model, const Energies& energies, int edges_per_segment);

/// Difference between a coarser level's state and the finer state restricted to its mesh. It
/// predicts the coarser level's next state, so single precision is enough.
struct MeshDifference {
  /// Path parameter.
  double t = 0;
  Eigen::Matrix3Xf x = {};     ///< 3 x nodes, mm; empty if the level has no state at t
  Eigen::VectorXf force = {};  ///< axial force of the edges, N

  bool known() const { return x.size() > 0; }
};

/// A point on the path of the finest mesh, with the differences of the coarser levels, coarse to
/// fine.
struct NestedPathPoint : PathPoint {
  /// One per coarser level.
  std::vector<MeshDifference> companions = {};
  Inertia inertia = {};  ///< inertia of the finest level's Hessian; not usable if unknown
};

/// Parameter that the path reached and why it ended there: reached, unstable, folded, lost,
/// not_finite, cancelled.
struct NestedReport {
  Outcome end = Outcome::reached;
  double t = 0;
};

/// A motion prescribed from the current state, linear in t from 0 to 1 on every level.
struct PrescribedMove {
  std::vector<Constraint> constraints;  ///< all constrained joints during the motion
  /// displacements of the constrained components, mm, one per constraint
  std::vector<Eigen::Vector3d> displacements = {};
  std::optional<BoundaryMotion> boundary =
      {};                    ///< final positions of the edge points; empty: they do not move
  LoadFactor load{1, 0};     ///< factor of the dead loads
  LoadFactor field{0, 0};    ///< factor of the applied load
  LoadFactor opening{0, 0};  ///< factor of the joint actuation
};

/// A footprint meshed on several levels with one motion of its boundary. The finest mesh is
/// followed. At each certified state the coarser levels are solved, each from the next finer state;
/// they serve the error estimate only.
class NestedShell {
 public:
  /// Builds all levels. Errors (bad_input): rods that the rod model does not support.
  static Result<NestedShell> make(const Footprint& footprint, const ShellRods& rods,
                                  RodModel rod_model, const BoundaryMotion& motion,
                                  const LevelPlan& plan, const PathOptions& options);

  /// Starts from a state of the finest mesh at t, in or near equilibrium: converges, certifies and
  /// estimates the error.
  NestedReport start(double t, const State& fine, const Watch& watch);
  /// Starts the path at t from a state in or near equilibrium, without certificate and error
  /// estimate.
  NestedReport start_path(double t, const State& fine, const Watch& watch = unwatched);
  /// Prolongates a state of the coarsest mesh at t to the finest, mesh by mesh, by Newton's method,
  /// or by minimising the energy if that fails. Errors: no_equilibrium, cancelled.
  Result<State> refined(double t, State coarse, const Watch& watch);
  /// Follows the path to t and certifies that state. On failure the current state is the last
  /// certified one.
  NestedReport advance(double t, const Watch& watch);
  /// Certifies the state at t between known points of the path; the path does not change. `nearest`
  /// is the nearest point, `across` the next one on the other side of t on the same branch.
  NestedReport sample(double t, const NestedPathPoint& nearest, const Watch& watch,
                      const NestedPathPoint* across = nullptr);

  /// Starts a prescribed motion from the current state, which is at t = 0. The caller then calls
  /// start() at t = 0 with the finest level's state.
  void drive(const PrescribedMove& drive);
  /// Returns to the motion of the boundary given to make(), with `constraints` fixed at their
  /// positions. The current state is at t there.
  void actuate(double t, const std::vector<Constraint>& constraints, double load_scale);
  /// Transfers the state of another shell of the same footprint, with all that is prescribed fixed.
  /// Returns the state of the finest mesh; the caller then calls start() at t = 0 with it.
  State stay(const NestedShell& other, const std::vector<Constraint>& constraints);
  /// Sets the applied load and its increment in a drive, N on each node.
  void set_fields(const std::vector<NodeAction>& steady, const std::vector<NodeAction>& field);

  const NestedState& state() const { return state_; }
  /// Restores an earlier state of the current motion.
  void back_to(const NestedState& state);
  /// Restores an earlier state with its motions and constraints.
  void restore(const NestedState& state, const std::vector<PinnedMotion>& motions,
               const std::vector<Constraint>& constraints);
  /// Point that the path follower reached; it is past the current state if advance() failed.
  const PathPoint& followed() const { return path_->point(); }
  /// The current state as a point of the path.
  NestedPathPoint point() const;
  const LevelPlan& plan() const { return plan_; }
  /// From now on a path continues whatever its error estimate is: its end is never `too_coarse`.
  void allow_any_error() { plan_.allowed_mm = std::numeric_limits<double>::infinity(); }
  int levels() const { return int(levels_.size()); }
  int last() const { return levels() - 1; }  ///< index of the finest level
  /// Whether positions, forces and energies of the current state are extrapolated.
  bool extrapolates() const { return plan_.extrapolate && state_.measured < last(); }
  const RodMesh& mesh(int level) const { return levels_[std::size_t(level)]->mesh; }
  const RodMesh& finest() const { return levels_.back()->mesh; }
  /// Index of the first of the levels that forces and energies are computed from, at most three, of
  /// at least four edges per segment: on two, errors of forces do not show their order yet.
  int first_of_last_three() const;
  const Model& model(int level) const { return levels_[std::size_t(level)]->model; }
  const Model& model() const { return levels_.back()->model; }
  Linearisation& system(int level) { return *levels_[std::size_t(level)]->system; }
  Linearisation& system() { return *levels_.back()->system; }
  /// The loads on a level.
  const ExternalLoads& outside(int level) const {
    return levels_[std::size_t(level)]->system->outside;
  }
  const PinnedMotion& motion(int level) const { return levels_[std::size_t(level)]->motion; }
  const PinnedMotion& motion() const { return levels_.back()->motion; }
  std::vector<PinnedMotion> motions() const;  ///< one per level
  /// Applies the loads of the current state to all levels.
  void apply_loads();
  /// Energies of a level's state under its loads, mJ.
  Energies energies(int level) const;
  /// Forces (N) and tangents of a level's state under its loads.
  Assembly forces(int level) const;
  /// Largest prescribed displacement, mm, of the complete motion.
  double reach_mm() const { return max_column_norm(levels_.back()->motion.change); }
  Effort effort() const;
  /// Frees the memory of the matrices, most of what the shell uses; the next use allocates it
  /// again.
  void free_memory();
  /// Whether the lowest eigenvalue of a stable state is larger than its error by the mesh, which is
  /// (coarse - fine)/3 with the companion's. Needs lowest_eigenvalue; true without a companion.
  bool stability_confirmed(const Watch& watch);
  /// Sets whether certified states compute their lowest eigenvalue; that of the current state, if
  /// it is stable, is computed at once.
  void watch_stability(bool watches, const Watch& watch = unwatched);
  /// Sets whether the path continues through states with negative pivots, which the report counts.
  void allow_unstable(bool allow) { options_.allow_unstable = allow; }

 private:
  struct Level : MeshLevel {
    std::unique_ptr<StateTransfer> from_finer, from_coarser;
    std::vector<NodeAction> steady, field;
    std::vector<MeshDifference> differences;  // at the last three states
  };
  /// Reactions and tangent stiffness at a level's constraints.
  struct ConstraintForces {
    Eigen::Matrix3Xd force;
    Eigen::MatrixXd stiffness;
  };
  NestedShell(const LevelPlan& plan, const PathOptions& options);
  void forget();
  void remember(const std::vector<MeshDifference>& differences);
  void reset_path();
  NestedReport certify(const PathFollower& path, const Watch& watch, const Inertia& known = {});
  void measure(const Watch& watch, const NestedState& before);
  bool measure_on(std::size_t level, const State& base, const NestedState& before,
                  const Watch& watch);
  State predicted(const Level& level, double t, const State& base) const;
  State clear_of_contact(Level& level, const State& before, State requested) const;
  bool correct(Level& level, const State& base, State& state, NewtonReport& report,
               const Watch& watch);
  static MeshDifference difference(const Level& level, double t, const State& base,
                                   const State& state);
  std::vector<MeshDifference> differences() const;
  bool vouches(const NewtonReport& report) const;
  Inertia inertia_of(Level& level, const State& found, const NewtonReport& report) const;
  void polish(Level& finest, State& found, const NewtonReport& last);
  void refine_velocity(Level& finest, const State& found);
  ConstraintForces constraint_forces(Level& level, const State& state) const;
  void take_reactions(const std::vector<ConstraintForces>& levels);
  void estimate(const Energies& energies);

  LevelPlan plan_;
  PathOptions options_;
  BoundaryMotion boundary_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<PathFollower> path_;
  NestedState state_;
  bool watches_stability_ = false;
};

}  // namespace gridshell
