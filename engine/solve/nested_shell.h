// Equilibria on nested meshes: the coarsest follows the path, finer ones correct, and the
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

/// One certified state on all levels.
struct NestedState {
  double t = 0;
  std::vector<State> levels;     ///< coarse to fine
  Eigen::Matrix3Xd x;            ///< nodes of the finest mesh, extrapolated where planned
  double error_estimate_mm = 0;  ///< of the joints of x; NaN when only one level is solved
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
/// the whole step between the last two.
CertifiedVectors certify_vectors(const std::vector<Eigen::Matrix3Xd>& levels, bool extrapolate,
                                 bool no_order);
/// What a finer mesh adds to the state of the one before it, interpolated: where its state is
/// looked for nearby. A guess, so in single precision.
struct LevelCorrection {
  double t = 0;
  Eigen::Matrix3Xf x = {};     ///< of the nodes
  Eigen::VectorXf force = {};  ///< of the edges

  friend LevelCorrection operator-(const LevelCorrection& a, const LevelCorrection& b);
};

/// A point of the path of the coarsest mesh, and for each finer mesh by how much what it adds
/// differs from a quarter of what the mesh before it adds.
struct NestedPathPoint : PathPoint {
  std::vector<LevelCorrection> beyond = {};  ///< coarse to fine; empty: not known
  /// where the coarsest mesh took many steps from the point before: where they led
  std::vector<PathPoint> way = {};
};

/// Points of the coarsest mesh that lie next to t, in front of it and behind.
struct PathInterval {
  const PathPoint *from, *to;
};
/// Those between two points that follow one another on a branch, themselves among them.
PathInterval interval_at(const NestedPathPoint& before, const NestedPathPoint& after, double t);

/// How far a shell came, and why it ended there: reached, unstable, folded, lost, not_finite,
/// meshes_disagree, cancelled.
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

/// A footprint meshed on several levels with one motion of its boundary.
class NestedShell {
 public:
  /// Errors (bad_input): rods that the rung cannot take.
  static Result<NestedShell> make(const Footprint& footprint, const ShellRods& rods, RodModel rung,
                                  const BoundaryMotion& motion, const LevelPlan& plan,
                                  const PathOptions& options);

  /// From a state of the coarsest level at t, an equilibrium or near one: certifies it on all
  /// levels. Of equilibria beside it a finer level takes the stable one.
  NestedReport start(double t, const State& coarse, const Watch& watch);
  /// The same without a certificate: only the coarsest level is brought to rest, to follow the path
  /// on.
  NestedReport place(double t, const State& coarse, const Watch& watch = unwatched);
  /// Follows the path to t and certifies there. The current state stays the last good one on
  /// failure.
  NestedReport advance(double t, const Watch& watch);
  /// Certifies the state at t, between points of the path that are known, and leaves the path
  /// itself as it is: `beside` is the nearest of them, `across` the next one, beyond t, to which
  /// its branch goes on, by its way. Finer levels choose as in start().
  NestedReport sample(double t, const NestedPathPoint& beside, const Watch& watch,
                      const NestedPathPoint* across = nullptr);

  /// From the current state on the shell is driven so, t = 0 being the current state. A start() at
  /// t = 0 from the coarsest level's state follows.
  void drive(const PrescribedMove& drive);
  /// Back to the motion of the boundary that it was made with, joints held where they are; the
  /// current state stands at t there.
  void actuate(double t, const std::vector<Constraint>& holds, double load_scale);
  /// Stands where another shell of the same footprint stands, everything prescribed held there: no
  /// motion. A start() at t = 0 from the state returned, of the coarsest mesh, follows.
  State stay(const NestedShell& other, const std::vector<Constraint>& holds);
  /// The field that is there, and the one that comes on with the field's growth in a drive.
  void set_fields(const std::vector<NodeAction>& steady, const std::vector<NodeAction>& field);

  const NestedState& state() const { return state_; }
  /// Goes back to a state that it had, on the motion that it is on.
  void back_to(const NestedState& state);
  /// The same with the motions and holds that it had then.
  void restore(const NestedState& state, const std::vector<PinnedMotion>& motions,
               const std::vector<Constraint>& holds);
  /// How far the coarsest mesh came: beyond the current state where an advance() failed.
  const PathPoint& followed() const { return path_->point(); }
  /// The current state's point of the path.
  NestedPathPoint point() const;
  const LevelPlan& plan() const { return plan_; }
  int levels() const { return int(levels_.size()); }
  const RodMesh& mesh(int level) const { return levels_[std::size_t(level)]->mesh; }
  const RodMesh& finest() const { return levels_.back()->mesh; }
  /// The first of the levels, up to the finest, that tell what forces and energies come to.
  int first_of_last_three() const { return std::max(0, levels() - 3); }
  const Model& model(int level) const { return levels_[std::size_t(level)]->model; }
  Linearisation& system(int level) { return *levels_[std::size_t(level)]->system; }
  /// What acts on a level from outside.
  const ExternalLoads& outside(int level) const {
    return levels_[std::size_t(level)]->system->outside;
  }
  const PinnedMotion& motion(int level) const { return levels_[std::size_t(level)]->motion; }
  std::vector<PinnedMotion> motions() const;  ///< one a level
  /// Puts the loads of the current state on all levels.
  void apply_loads();
  /// Energies of a level's state under what acts there.
  Energies energies(int level) const;
  /// Forces and tangents of a level's state under what acts there.
  Assembly forces(int level) const;
  /// Largest prescribed move, mm, while the motion comes all the way.
  double reach_mm() const { return max_column_norm(levels_[0]->motion.change); }
  Effort effort() const;
  /// Gives back the memory of its matrices, most of what it has; whoever goes on takes it again.
  void free_memory();
  /// Whether the path may go on through states with negative pivots (they stay in the report).
  void allow_unstable(bool allow) { options_.allow_unstable = allow; }

 private:
  struct Level : MeshLevel {
    std::unique_ptr<StateTransfer> from_coarser;
    std::optional<MeshTransfer> to_coarser;
    std::vector<NodeAction> steady, field;
    std::vector<LevelCorrection> beyond;  // at the last three states
  };
  /// A state of one level, all that it adds to that of the coarser one, and how it was found.
  struct Refined {
    State state;
    LevelCorrection added;
    NewtonReport report;
  };
  NestedShell(const LevelPlan& plan, const PathOptions& options);
  // of equilibria of a finer level beside the coarser one's state: the first found, which tells
  // where a branch loses its stability, or one that is stable
  enum class Prefer { first, stable };
  void forget();
  void set_corrections(const std::vector<LevelCorrection>& beyond);
  std::vector<LevelCorrection> beyond() const;
  void reset_path();
  NestedReport certify(double t, const PathPoint& coarse, const NewtonReport& last, Prefer prefer,
                       const Watch& watch);
  LevelCorrection expected_correction(std::size_t k, const LevelCorrection& below) const;
  State guess(const Level& level, double t, const State& base, LevelCorrection expected) const;
  std::optional<Refined> refine(std::size_t k, double t, const Refined& coarser, Prefer prefer,
                                const Watch& watch);
  bool correct(Level& level, const State& base, State& state, NewtonReport& report,
               const Watch& watch);
  LevelCorrection correction_of(const Level& level, double t, const State& base,
                                const State& state) const;
  Inertia inertia_of(Level& level, const State& found, const NewtonReport& report) const;
  void finish(const NewtonReport& report);
  void polish(Level& finest, State& found);
  void take_reactions();
  void estimate();

  LevelPlan plan_;
  PathOptions options_;
  BoundaryMotion boundary_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<PathFollower> path_;
  NestedState state_;
};

}  // namespace gridshell
