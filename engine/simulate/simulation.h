// Simulation: one gridshell that a user or an experiment actuates, pushes, loads and reads.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/outcome.h"
#include "engine/core/team.h"
#include "engine/record/contacts.h"
#include "engine/record/frame.h"
#include "engine/scene/scene.h"
#include "engine/solve/dynamics.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// The figures that certify a state. Simulation::certificate() computes them from the finest mesh.
struct Certificate {
  double residual_N = 0;         ///< largest unbalanced force on an unconstrained node
  int negative_pivots = 0;       ///< of the Hessian by the free unknowns; 0: stable
  double error_estimate_mm = 0;  ///< largest error of a node's position; NaN on a single mesh
  /// axial strain of largest magnitude, with its sign; below 0 in compression
  double largest_strain = 0;

  bool stable() const { return negative_pivots == 0; }
};

/// An event on the path. Simulation::go() writes it.
struct Event {
  enum class Kind { stability_lost, turned_back, locked, overbent, contact };
  Kind kind = Kind::stability_lost;
  double t = 0;                 ///< path parameter, extrapolated if two meshes have the event
  std::optional<double> error;  ///< error of t; empty if only one mesh has the event
  std::optional<double> to;     ///< path parameter of the next equilibrium; empty if none was found
  /// whether the path continues by a snap; else along a branch that bifurcates there
  bool jump = true;
  bool confirmed = true;  ///< whether the next coarser mesh, if there is one, has the event too
  /// Details: for a contact the parts and the position in space; for a strain limit the limit
  /// exceeded; for locked rods a text if they lock in the equilibrium after a snap, else empty.
  std::string what = {};
  /// Position of the event on one mesh.
  struct Location {
    int edges = 0;  ///< per segment
    /// Path parameter, and the width of the interval in which it was located.
    double t = 0, located = 0;
  } location = {};  ///< on the finest mesh

  /// Sets t and its error by Richardson extrapolation (second order) with the event of another
  /// mesh.
  void extrapolate(const Location& other);

  /// Whether the path ends at this event, in the last state before it.
  bool is_limit() const {
    return kind == Kind::locked || kind == Kind::overbent || kind == Kind::contact;
  }
};

/// Outcome of a path that ended at this kind of limit.
constexpr Outcome outcome_of(Event::Kind limit) {
  if (limit == Event::Kind::contact) return Outcome::contact;
  return limit == Event::Kind::overbent ? Outcome::overbent : Outcome::locked;
}

/// Whether a path that ended with Outcome::locked reached the strain limit, and not 100 times the
/// first stiffness of a push. Its last state is up to a load step before the limit, so 0.9 of the
/// limit count.
inline bool locked_by_strain(double largest_strain, double max_strain) {
  constexpr double near_it = 0.9;
  return std::abs(largest_strain) > near_it * max_strain;
}

/// How a command ended, what it reached and what it cost. After a failure the shell is in the last
/// certified state.
struct [[nodiscard]] Report {
  /// Why it ended: reached, or the reason that it stopped before.
  Outcome end = Outcome::reached;
  double t = 0;               ///< path parameter reached
  Certificate certificate;    ///< certificate of the current state
  std::vector<Event> events;  ///< events on the path of the command, in order
  /// Factorisations, iterations and solves of this command.
  Effort effort;
  /// Wall time, s.
  double seconds = 0;
};

/// A certified state of the path: state and tangent of the finest mesh, differences of the coarser
/// meshes, certificate and contacts. Simulation::go() writes it.
struct LoadStep {
  NestedPathPoint point;
  Certificate certificate;
  /// Interpenetrations of rods, joints and table at this state (contact is not modelled there).
  record::Contacts contacts = {};
  /// Whether two meshes confirm that a stable state is stable on finer meshes, too. It is checked
  /// where the lowest eigenvalue is near zero, else true.
  bool stability_confirmed = true;
};

/// State of the finest mesh at one time of a dynamic snap.
struct TimedState {
  double time = 0;  ///< s, from the start of the snap
  State state;
};

/// Output of Simulation::go(): the certified load steps in order, and the motion of each snap that
/// was computed in time.
struct PathRecord {
  std::vector<LoadStep> load_steps;
  struct Snap {
    std::size_t before = 0;  ///< index of the load step from which the shell snapped
    /// States in the order of time.
    std::vector<TimedState> moments;
  };
  std::vector<Snap> snaps;
};

/// What a path does where its branch ends or loses stability.
struct BifurcationPolicy {
  bool requested = true;  ///< whether another branch is searched for; false: the path ends there
  bool through_unstable = false;  ///< continue through unstable states instead
};

/// A load case that acts on the shell: `factor` times its forces.
struct CaseOnShell {
  /// Name in the preset.
  std::string name;
  /// Forces at factor 1, N.
  std::vector<NodeAction> forces;
  double dead = 0;  ///< factor that it adds to the dead loads
  /// Current load factor.
  double factor = 0;
};

/// A saved simulation. save() and restore() copy states; the meshes are shared, so restore() cannot
/// fail.
struct Checkpoint {
  /// State of all levels.
  NestedState state;
  /// Meshes and matrices that the state belongs to.
  std::shared_ptr<NestedShell> shell;
  /// Rods set by set_rods(); empty: those of the scene.
  std::optional<ShellRods> rods;
  std::vector<PinnedMotion> motions;  ///< one per mesh level
  /// Constrained joints.
  std::vector<Constraint> constraints;
  /// Applied load, N on each joint.
  std::vector<NodeAction> field;
  /// Factor of the dead loads; progress of the actuation, from 0 to 1.
  double load_scale = 1, progress = 0;
  /// Whether the path parameter is that of the actuation, not of a drive.
  bool actuating = true;
  /// Displacements of the edge points in addition to the motion of the scene, mm, 3 x edge points.
  Eigen::Matrix3Xd dragged;
  /// Position of each constrained joint when its constraint was set, mm.
  std::map<int, Eigen::Vector3d> constraint_origins;
  /// Load cases that act, the last one last.
  std::vector<CaseOnShell> cases;
  double first_stiffness = 0;  ///< dF/d(depth) at the start of the push
  Eigen::VectorXd along;       ///< direction of the push among the constrained components, length 1
};

/// Smallest displacement of a joint that counts as a push, mm.
inline constexpr double nearest_mm = 1e-9;

/// Whether a pushed joint may move perpendicular to the push.
enum class Across { free, fixed };

namespace simulate {
class SavedSegments;
}

/// Services of a run, which change no result.
struct RunContext {
  std::shared_ptr<Team> team;  ///< threads for large shells; null: one thread
  /// Saved segments of the path, from which the run continues; null: none (saved_segments.h).
  std::shared_ptr<simulate::SavedSegments> segments;
};

/// A simulation of one scene. It is not thread-safe. A watch may be cancelled from any thread; the
/// simulation then returns within one factorisation. Every call ends: load steps have a smallest
/// length, a path switches branches at most eight times (64 times with contact), and Newton's
/// iterations are limited.
class Simulation {
 public:
  /// Builds meshes, model and solver. Errors (bad_input): rods that the rod model does not support.
  static Result<Simulation> open(std::shared_ptr<const Scene> scene, const LevelPlan& plan,
                                 const RunContext& context = {});

  // ---- first state ----

  /// Starts from the flat footprint.
  Report begin_flat();
  /// Starts from the buckled state of the preset's seed at which the rods' mean relative shortening
  /// is `shortening`. Errors (bad_input, no_equilibrium) as first_buckled().
  Result<Report> begin_buckled(double shortening, const Watch& watch);
  /// Starts from the equilibrium next to the Chebyshev net.
  Result<Report> begin_on_net(const Watch& watch);
  /// Starts from the equilibrium that a network drawn in space relaxes to.
  Result<Report> begin_as_drawn(const Watch& watch);
  /// Starts from a state of the finest mesh at parameter t, in or near equilibrium.
  Report begin_at(double t, const State& fine, const Watch& watch);
  /// Starts from a state of the coarsest mesh, prolongated to the finest.
  Report begin_refined(double t, const State& coarse, const Watch& watch);

  // ---- motion and loads ----

  /// Follows the path to parameter t, past snaps, up to the strain limit of the rods. Load steps
  /// are chosen by the path follower. t is sqrt(progress) in an actuation; in a drive it runs from
  /// 0 to 1.
  Report go(double t, const Watch& watch, const BifurcationPolicy& leaving = {},
            PathRecord* record = nullptr);
  /// Moves the boundary to a progress of the scene's motion. Constrained joints stay fixed.
  Report move_to(double progress, const Watch& watch, PathRecord* record = nullptr);
  /// Moves the edge points on straight lines to their positions at a progress of the scene's motion
  /// plus `dragged`, mm, 3 x edge points.
  Report move_edge_points(double progress, const Eigen::Matrix3Xd& dragged, const Watch& watch);
  /// Constrains a joint until release(), and prepares its push by `displacement`, mm, which go()
  /// then follows.
  Report begin_push(int joint, const Eigen::Vector3d& displacement, Across across,
                    const Watch& watch);
  /// begin_push(), and go() to its end.
  Report push(int joint, const Eigen::Vector3d& displacement, Across across, const Watch& watch,
              PathRecord* record = nullptr);
  /// Releases a joint: its reaction is reduced to zero in equal steps.
  Report release(int joint, const Watch& watch);
  /// Sets the factor of the scene's dead loads, to which load cases add theirs.
  Report load(double factor, const Watch& watch);
  /// Replaces the applied load by `field` (empty: no load) and adds `dead` to the factor of the
  /// dead loads.
  Report set_field(std::vector<NodeAction> field, const Watch& watch, double dead = 0);
  /// Drives the joints to the target angles in rods().bolts->opening, t from 0 to 1.
  Report open_joints(const Watch& watch, PathRecord* record = nullptr);
  /// Minimises the energy from the current state to an equilibrium; from a saddle towards `side`.
  Report rest(const Watch& watch, BranchSide side = BranchSide::lower);
  /// Relaxes in time with the damping of the scene; `seen` is called after each time step.
  Report rest_in_time(const Watch& watch, const std::function<void(const MovingState&)>& seen);
  /// Replaces the rods and finds the equilibrium next to the current state. Errors (bad_input) as
  /// open().
  Result<Report> set_rods(const ShellRods& rods, const Watch& watch);
  /// Transfers the state to finer or coarser meshes. Errors (bad_input) as open().
  Result<Report> remesh(const LevelPlan& plan, const Watch& watch);
  /// Refines the meshes until the error estimate is below `tolerance_mm`, or until no finer plan
  /// exists or fits the memory.
  Report refine(double tolerance_mm, const Watch& watch);

  // ---- save and restore ----

  Checkpoint save() const;
  void restore(const Checkpoint& checkpoint);

  // ---- current state ----

  const Scene& scene() const { return *scene_; }
  NestedShell& shell() { return *shell_; }
  const NestedShell& shell() const { return *shell_; }
  Certificate certificate() const;
  /// Positions of the nodes of the finest mesh, mm, 3 x nodes, extrapolated where planned; joints
  /// first.
  const Eigen::Matrix3Xd& nodes() const { return shell_->state().x; }
  /// Reaction at constraint `k` of constraints(), N.
  Eigen::Vector3d force(std::size_t k) const { return shell_->state().reactions[k]; }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  const std::vector<NodeAction>& field() const { return field_; }
  const ShellRods& rods() const { return rods_ ? *rods_ : scene_->rods; }
  /// Factor of the dead loads, and its increment in a drive.
  LoadFactor steady_load() const;
  /// Progress of the boundary: fraction of the scene's motion, from 0 to 1.
  double progress() const { return progress_; }
  /// Displacements of the edge points in addition to that motion, mm, 3 x edge points.
  const Eigen::Matrix3Xd& dragged() const { return dragged_; }
  /// Writes depth, force and stiffness of the last push into a frame; nothing without a constrained
  /// joint. The depth is the length of the displacement since the constraint was set, along its
  /// constrained directions, mm. The force is the component of the reaction in the direction of
  /// that displacement, N.
  void put_push(record::Frame& frame) const;
  /// Writes the stiffness along the last push, N/mm, its error and the error of the force, N.
  void put_push_errors(record::Frame& frame) const;
  /// Energies by term, mJ, extrapolated where the forces are.
  Energies energies() const;
  Effort effort() const { return spent_ + shell_->effort(); }
  /// Adds the cost of a simulation that was used before this one.
  void charge(const Effort& spent) { spent_ += spent; }
  /// Certifies the state at t next to load step `nearest`; the path does not change. With
  /// `unstable`, or from an unstable load step, any equilibrium is accepted and its stability
  /// reported. `across`: the load step on the other side of t on the same branch.
  Report sample(double t, const LoadStep& nearest, bool unstable, const Watch& watch,
                const LoadStep* across = nullptr);
  /// Certifies the equilibrium at t to which the shell relaxes after it lost the branch of
  /// `before`.
  Report certify_rest_at(double t, const LoadStep& before, const Watch& watch);
  /// Whether the axial strain has reached its limit.
  bool locked() const;
  /// Whether the path parameter is that of the scene's motion, not of a drive.
  bool actuating() const { return actuating_; }
  /// The limit of the scene that the current state exceeds, an event with is_limit(); empty: none.
  std::optional<Event> exceeded_limit() const;
  /// Largest strain of a fibre by bending, dimensionless, on the finest mesh.
  double bending_strain() const;
  /// Interpenetrations in nodes(), the shape that is shown.
  record::Contacts contacts() const;

  /// Position of each constrained joint when its constraint was set, mm.
  std::map<int, Eigen::Vector3d> constraint_origins;
  /// Load cases that act, the last one last.
  std::vector<CaseOnShell> cases;

 private:
  Simulation(std::shared_ptr<const Scene> scene, RunContext context);
  Result<std::shared_ptr<NestedShell>> build(const LevelPlan& plan);
  void use(std::shared_ptr<NestedShell> shell);
  struct CallBegin {
    Effort effort;
    double seconds;
  };
  CallBegin call_begin() const;
  Report report(Outcome end, double t, const CallBegin& begin) const;
  Report drive(const PrescribedMove& drive, std::vector<NodeAction> field, const Watch& watch,
               PathRecord* record = nullptr);
  Outcome start_here(double t, const Checkpoint& before, const Watch& watch);
  void apply_field(std::vector<NodeAction> field);
  void begin_unloaded();
  void set_progress(double progress);
  double load_step() const;
  Result<Outcome> replace_meshes(const LevelPlan& plan, bool nearby, const Watch& watch);
  double push_stiffness() const;
  /// Measures of the limits: the axial strain, bending strain or utilisation over its limit, and
  /// the least gap of each contact kind, mm.
  struct Limits {
    double strain, strained, gap_mm[record::contact_kinds];
  };
  /// Bending strain and utilisation, each over its limit: the larger of the two, and that limit as
  /// text: "max_utilisation = 0.8".
  std::pair<double, std::string> strained() const;
  Limits limits() const;
  Limits limits_here() const;
  bool locked_past(double strain) const;
  std::optional<Event> exceeded(const Limits& limits) const;
  class Walk;

  std::shared_ptr<const Scene> scene_;
  RunContext context_;
  std::optional<ShellRods> rods_;  // replace the rods of the scene
  std::shared_ptr<NestedShell> shell_;
  /// The meshes built for rods(), by edges per segment. A drag alternates between two of them.
  std::vector<std::shared_ptr<NestedShell>> built_;
  std::optional<record::ContactSearch> search_;  // on the finest mesh
  std::vector<Constraint> constraints_;
  std::vector<NodeAction> field_;  // the applied load
  double load_scale_ = 1;          // factor of the scene's dead loads
  double progress_ = 0;
  Eigen::Matrix3Xd dragged_;
  double first_stiffness_ = 0;  // stiffness at the start of the last push, N/mm
  Eigen::VectorXd along_;       // direction of its displacements, in the constrained directions
  bool actuating_ = true;
  Effort spent_;  // on meshes that finer ones replaced
};

}  // namespace gridshell
