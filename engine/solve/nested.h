// Equilibria on nested meshes: the coarsest follows the path, finer ones correct, and the
// differences between them give the error or, extrapolated, remove most of it [Richardson 1911].
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/path.h"

namespace gridshell {

/// Where the edge points are as the boundary moves, straight and evenly: column 2r is the begin, 2r
/// + 1 the end of rod r.
struct BoundaryMotion {
  Eigen::Matrix3Xd begin, end;  ///< 3 x edge points, mm
  /// unit tangents there, along the rod as its positions grow; needed where a direction is held
  Eigen::Matrix3Xd begin_tangent = {}, end_tangent = {};
};

/// The motion of a mesh's pinned nodes: its edge points and, beyond those whose direction is held,
/// their ghosts.
PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion);

/// Which meshes are solved and how they are used.
struct LevelPlan {
  std::vector<int> edges_per_segment;  ///< coarse to fine, each twice the one before
  bool extrapolate = false;  ///< over the last two (needs three, the third for the estimate)
};

/// The cheapest plan worth trying for a tolerance of the largest joint error, relative to the
/// length scale: the error of k edges falls as 1/k^2, extrapolated as 1/k^4, and is about 3e-3 at
/// four edges for shells of the paper's kind. The estimate says afterwards whether it held; `finer`
/// is what to try then.
LevelPlan plan_levels(double tolerance);

/// What a plan leaves of the largest joint error, over the length scale, as a rule: for plans
/// before a run.
double expected_error(const LevelPlan& plan);

/// The next plan: extrapolation, or one level more. Empty when the finest mesh would pass 128
/// edges.
std::optional<LevelPlan> finer(const LevelPlan& plan);

/// One certified state on all levels.
struct NestedState {
  double t = 0;
  std::vector<State> levels;     ///< coarse to fine
  Eigen::Matrix3Xd x;            ///< on the finest mesh, extrapolated where planned
  double error_estimate_mm = 0;  ///< of the joints of x; NaN when only one level is solved
  double residual_N = 0;         ///< of the finest level's equilibrium
  Inertia inertia;               ///< of the finest level's Hessian
  double largest_strain = 0;
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< on a pushed joint, extrapolated as x, N
  /// how the reaction grows with the prescribed components (zero in the others), N/mm
  Eigen::Matrix3d push_stiffness = Eigen::Matrix3d::Zero();
};

/// Why a state could not be certified.
enum class NestedEnd { reached, unstable, folded, lost, not_finite, levels_disagree, cancelled };

struct NestedReport {
  NestedEnd end = NestedEnd::reached;
  double t = 0;
};

/// A footprint meshed on several levels with one motion of its boundary.
class NestedShell {
 public:
  NestedShell(const Footprint& footprint, const ShellRods& rods, const BoundaryMotion& motion,
              const LevelPlan& plan, const PathOptions& options);

  /// From a state of the coarsest level at t, an equilibrium or near one: certifies it on all
  /// levels.
  NestedReport start(double t, const State& coarse, const Watch& watch);
  /// The same without a certificate: only the coarsest level is brought to rest, to follow the path
  /// on.
  NestedReport place(double t, const State& coarse);
  /// Follows the path to t and certifies there. The current state stays the last good one on
  /// failure.
  NestedReport advance(double t, const Watch& watch);

  /// From the current state on the boundary stays and a joint is pushed: t = 0 is the current
  /// state, at t = 1 its prescribed components have moved by `displacement`, on every level from
  /// where that level's joint is. A start() at t = 0 follows.
  void push_joint(const Prescription& prescription, const Eigen::Vector3d& displacement);

  const NestedState& state() const { return state_; }
  /// How far the coarsest mesh came: beyond the current state where an advance() failed.
  const PathPoint& followed() const { return path_->point(); }
  const LevelPlan& plan() const { return plan_; }
  int levels() const { return int(levels_.size()); }
  const RodMesh& mesh(int level) const { return levels_[level]->mesh; }
  const Model& model(int level) const { return levels_[level]->model; }
  Linearisation& system(int level) { return *levels_[level]->system; }
  const PinnedMotion& motion(int level) const { return levels_[level]->motion; }
  Effort effort() const;
  /// Whether the path may go on through states with negative pivots (they stay in the report).
  void allow_unstable(bool allow) { options_.allow_unstable = allow; }

 private:
  struct Level {
    RodMesh mesh;
    Model model;
    PinnedMotion motion;
    std::unique_ptr<Linearisation> system;
    std::optional<MeshTransfer> from_coarser, to_coarser;
    // what this level adds to the interpolated coarser one, at the last states
    std::vector<double> added_t;
    std::vector<State> added;
  };
  NestedReport certify(double t, const Watch& watch);
  bool correct(Level& level, const State& coarser, State& state, NewtonReport& report);
  void remember(Level& level, double t, const State& base, const State& state);
  State carried(const Level& level, const State& coarser) const;
  void finish(const NewtonReport& report);
  void take_reaction();

  LevelPlan plan_;
  PathOptions options_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<PathFollower> path_;
  NestedState state_;
};

}  // namespace gridshell
