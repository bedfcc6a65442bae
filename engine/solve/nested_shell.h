// Equilibria on one mesh that is followed, and on coarser companions that measure it: the
// differences between them give the error or, extrapolated, remove most of it [Richardson 1911].
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

/// One certified state of the mesh that is followed, the finest, and of its companions.
struct NestedState {
  double t = 0;
  /// coarse to fine, one a mesh; of a companion that has no equilibrium beside the finer state that
  /// state restricted to its mesh
  std::vector<State> levels;
  int measured = 0;              ///< the coarsest level in equilibrium, as all finer ones are
  Eigen::Matrix3Xd x;            ///< nodes of the finest mesh, extrapolated where planned
  double error_estimate_mm = 0;  ///< largest, of all nodes of x; NaN without a companion's state
  double residual_N = 0;         ///< of the finest level's equilibrium
  Inertia inertia;               ///< of the finest level's Hessian
  double largest_strain = 0;     ///< by size, with its sign
  /// on held joints, N, extrapolated where planned of forces, and the error of the largest
  std::vector<Eigen::Vector3d> reactions;
  double reaction_error_N = std::numeric_limits<double>::quiet_NaN();
  /// how the reactions' held components grow with these, in the order of holds and their
  /// directions, N/mm; likewise
  Eigen::MatrixXd held_stiffness;
  double stiffness_error_N_per_mm = std::numeric_limits<double>::quiet_NaN();
  State velocity;                       ///< of the finest level on its path, by t
  double step = PathPoint::first_step;  ///< with which its path continues, in t
  /// of the finest level, N/mm^2 (lowest_eigenvalue()), roughly; NaN: not asked for, or not stable
  double lowest_eigenvalue = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xf lowest_mode = {};  ///< over all columns, with it
};

/// Vectors that nested meshes know: those of the finest or, extrapolated, (4 fine - coarse)/3 of
/// the last two.
struct CertifiedVectors {
  Eigen::Matrix3Xd value;
  double error = 0;  ///< of the largest, by the order that three meshes show; NaN on one mesh
};

/// Whether meshes tell no order of convergence: none do where rods press on one another, as where
/// on its edges a mesh presses is chance. `energies`: of the finest.
bool order_unknown(const Energies& energies);

/// `levels`: coarse to fine, of which the last three count. Where no order is known the error is
/// the complete step between the last two.
CertifiedVectors certify_vectors(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                 bool no_order);

/// By how much a companion's state differs from the finer one restricted to its mesh. It predicts
/// the companion's next state, so single precision serves.
struct MeshDifference {
  double t = 0;
  Eigen::Matrix3Xf x = {};     ///< of the nodes; empty: the companion has no state there
  Eigen::VectorXf force = {};  ///< of the edges
};

/// A point of the path of the finest mesh, with its companions' differences, coarse to fine.
struct NestedPathPoint : PathPoint {
  std::vector<MeshDifference> companions = {};
  Inertia inertia = {};  ///< of the finest level's Hessian; not usable: not known
};

/// How far a shell came, and why it ended there: reached, unstable, folded, lost, not_finite,
/// cancelled.
struct NestedReport {
  Outcome end = Outcome::reached;
  double t = 0;
};

/// What moves from a state on, evenly from t = 0 to 1, on every level from where that level is.
struct PrescribedMove {
  std::vector<Constraint> holds;  ///< joints that are held from here on, all of them
  std::vector<Eigen::Vector3d> displacements = {};  ///< of the held components, one a hold
  std::optional<BoundaryMotion> boundary =
      {};                    ///< where the edge points go (its end); else they stay
  LoadFactor load{1, 0};     ///< of the dead loads
  LoadFactor field{0, 0};    ///< and of the field
  LoadFactor opening{0, 0};  ///< and of the joints that are opened
};

/// A footprint meshed on several levels with one motion of its boundary. The finest mesh is
/// followed; at each certified state its companions are solved, each from the next finer state, and
/// decide nothing.
class NestedShell {
 public:
  /// Errors (bad_input): rods that the rod model cannot take.
  static Result<NestedShell> make(const Footprint& footprint, const ShellRods& rods, RodModel rung,
                                  const BoundaryMotion& motion, const LevelPlan& plan,
                                  const PathOptions& options);

  /// From a state of the finest mesh at t, an equilibrium or near one: converges, certifies and
  /// measures it.
  NestedReport start(double t, const State& fine, const Watch& watch);
  /// The same without certificate and companions, to follow the path from there.
  NestedReport place(double t, const State& fine, const Watch& watch = unwatched);
  /// A state of the coarsest mesh at t brought to the finest, mesh by mesh: Newton's corrections,
  /// else down the energy. Errors: no_equilibrium, cancelled.
  Result<State> refined(double t, State coarse, const Watch& watch);
  /// Follows the path to t and certifies there. The current state stays the last good one on
  /// failure.
  NestedReport advance(double t, const Watch& watch);
  /// Certifies the state at t, between points of the path that are known, and leaves the path
  /// itself as it is: `beside` is the nearest of them, `across` the next one, past t, on the same
  /// branch.
  NestedReport sample(double t, const NestedPathPoint& beside, const Watch& watch,
                      const NestedPathPoint* across = nullptr);

  /// From the current state on the shell is driven so, t = 0 being the current state. A start() at
  /// t = 0 from the finest level's state follows.
  void drive(const PrescribedMove& drive);
  /// Back to the motion of the boundary that it was made with, joints held where they are; the
  /// current state is at t there.
  void actuate(double t, const std::vector<Constraint>& holds, double load_scale);
  /// Takes the state of another shell of the same footprint, everything prescribed held there: no
  /// motion. A start() at t = 0 from the state returned, of the finest mesh, follows.
  State stay(const NestedShell& other, const std::vector<Constraint>& holds);
  /// The applied load that is there, and its increment in a drive.
  void set_fields(const std::vector<NodeAction>& steady, const std::vector<NodeAction>& field);

  const NestedState& state() const { return state_; }
  /// Goes back to a state that it had, on the motion that it is on.
  void back_to(const NestedState& state);
  /// The same with the motions and holds that it had then.
  void restore(const NestedState& state, const std::vector<PinnedMotion>& motions,
               const std::vector<Constraint>& holds);
  /// How far the path came: past the current state where an advance() failed.
  const PathPoint& followed() const { return path_->point(); }
  /// The current state's point of the path.
  NestedPathPoint point() const;
  const LevelPlan& plan() const { return plan_; }
  int levels() const { return int(levels_.size()); }
  int last() const { return levels() - 1; }  ///< the level that is followed
  /// Whether the current state is extrapolated, and whether its forces and energies are.
  bool extrapolates() const { return plan_.extrapolate && state_.measured + 2 <= last(); }
  bool extrapolates_forces() const { return plan_.extrapolate_forces && state_.measured < last(); }
  const RodMesh& mesh(int level) const { return levels_[std::size_t(level)]->mesh; }
  const RodMesh& finest() const { return levels_.back()->mesh; }
  /// The first of the levels, up to the finest, that tell what forces and energies come to.
  int first_of_last_three() const { return std::max(state_.measured, levels() - 3); }
  const Model& model(int level) const { return levels_[std::size_t(level)]->model; }
  const Model& model() const { return levels_.back()->model; }
  Linearisation& system(int level) { return *levels_[std::size_t(level)]->system; }
  Linearisation& system() { return *levels_.back()->system; }
  /// What acts on a level from outside.
  const ExternalLoads& outside(int level) const {
    return levels_[std::size_t(level)]->system->outside;
  }
  const PinnedMotion& motion(int level) const { return levels_[std::size_t(level)]->motion; }
  const PinnedMotion& motion() const { return levels_.back()->motion; }
  std::vector<PinnedMotion> motions() const;  ///< one a level
  /// Puts the loads of the current state on all levels.
  void apply_loads();
  /// Energies of a level's state under what acts there.
  Energies energies(int level) const;
  /// Forces and tangents of a level's state under what acts there.
  Assembly forces(int level) const;
  /// Largest prescribed move, mm, while the motion comes all the way.
  double reach_mm() const { return max_column_norm(levels_.back()->motion.change); }
  Effort effort() const;
  /// Gives back the memory of its matrices, most of what it has; the next use takes it again.
  void free_memory();
  /// Whether certified states know their lowest eigenvalue.
  void watch_stability(bool watches) { watches_stability_ = watches; }
  /// Whether the path may go on through states with negative pivots (they stay in the report).
  void allow_unstable(bool allow) { options_.allow_unstable = allow; }

 private:
  struct Level : MeshLevel {
    std::unique_ptr<StateTransfer> from_finer, from_coarser;
    std::vector<NodeAction> steady, field;
    std::vector<MeshDifference> differences;  // at the last three states
  };
  /// What a level says of its held joints.
  struct HeldForces {
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
  State clear_of_contact(Level& level, const State& before, State wanted) const;
  bool correct(Level& level, const State& base, State& state, NewtonReport& report,
               const Watch& watch);
  static MeshDifference difference(const Level& level, double t, const State& base,
                                   const State& state);
  std::vector<MeshDifference> differences() const;
  bool vouches(const NewtonReport& report) const;
  Inertia inertia_of(Level& level, const State& found, const NewtonReport& report) const;
  void polish(Level& finest, State& found, const NewtonReport& last);
  void refine_velocity(Level& finest, const State& found);
  HeldForces held_forces(Level& level, const State& state) const;
  void take_reactions(const std::vector<HeldForces>& levels);
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
