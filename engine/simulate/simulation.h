// What a step of a simulation says: how it ended, what it certified, what happened on its way.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/outcome.h"
#include "engine/record/contacts.h"
#include "engine/record/frame.h"
#include "engine/scene/scene.h"
#include "engine/solve/dynamics.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// What is known of a state.
struct Certificate {
  double residual_N = 0;         ///< largest force that nothing holds
  int negative_pivots = 0;       ///< of the Hessian with what is held held; 0: stable
  double error_estimate_mm = 0;  ///< of the joints; NaN on one mesh
  double largest_strain = 0;     ///< by size; below 0: a compression

  bool stable() const { return negative_pivots == 0; }
};

/// Something that happened to the shell on its path.
struct Event {
  enum class Kind { stability_lost, turned_back, locked, overbent, contact };
  Kind kind = Kind::stability_lost;
  double t = 0;                 ///< position on the path, extrapolated where two meshes have it
  std::optional<double> error;  ///< of t, where two meshes have it
  std::optional<double> to;     ///< path parameter of the next equilibrium, if one was found
  bool leap = true;             ///< whether that is another state; else on a branch from there
  bool confirmed = true;        ///< whether the companion has it too, if there is one
  /// of a contact: of which parts, and where in space; of rods strained too far: by which limit;
  /// of rods at their length: not empty where they are so in the equilibrium after a snap
  std::string what = {};
  /// The event on one mesh of so many edges per segment, and to how much it was located.
  struct Location {
    int edges = 0;
    double t = 0, located = 0;
  } placed = {};  ///< on the mesh that was followed

  /// Sets t and its error from where another mesh has the event, by second order.
  void extrapolate(const Location& other);

  /// Whether the path ends there in the last state before.
  bool is_limit() const {
    return kind == Kind::locked || kind == Kind::overbent || kind == Kind::contact;
  }
};

/// How a path ended at a limit.
constexpr Outcome outcome_of(Event::Kind limit) {
  if (limit == Event::Kind::contact) return Outcome::contact;
  return limit == Event::Kind::overbent ? Outcome::overbent : Outcome::locked;
}

/// How a step ended: what was reached, why no more, what it cost. Where not all was reached the
/// shell stands in the last certified state.
struct [[nodiscard]] Report {
  Outcome end = Outcome::reached;
  double t = 0;               ///< path parameter reached
  Certificate certificate;    ///< of the state the shell stands in
  std::vector<Event> events;  ///< on the way
  Effort effort;
  double seconds = 0;
};

/// A point of a path with the certificate of all meshes, and what touches there.
struct LoadStep {
  NestedPathPoint point;
  Certificate certificate;
  record::Contacts contacts = {};
};

/// What the coarsest mesh was like at a time, while it moved.
struct TimedState {
  double time = 0;  ///< s
  State state;
};

/// What a path leaves to whoever watches it: a load_step a certified load step, in order, and what
/// moved in time where a snap was followed so.
struct PathRecord {
  std::vector<LoadStep> load_steps;
  struct Snap {
    std::size_t before = 0;  ///< the load_step that it left from
    std::vector<TimedState> moments;
  };
  std::vector<Snap> snaps;
};

/// How a branch that ended is left.
struct BifurcationPolicy {
  bool wanted = true;             ///< false: the path ends there
  bool through_unstable = false;  ///< go on through states that are not stable instead
};

/// Where the boundary is: how far along the scene's motion, and by how much its edge points lie off
/// that.
struct BoundaryPosition {
  double progress = 0;
  Eigen::Matrix3Xd dragged;  ///< 3 x edge points, mm
};

/// A load case on the shell: the forces that it came on with, times a factor.
struct CaseOnShell {
  std::string name;
  std::vector<NodeAction> forces;
  double dead = 0;  ///< its part of the dead loads
  double factor = 0;
};

/// A state to go back to; taking one and going back cost a copy. It keeps the meshes that it was
/// taken on, so that going back cannot fail.
struct Checkpoint {
  NestedState state;
  std::shared_ptr<NestedShell> shell;
  std::optional<ShellRods> rods;
  std::vector<PinnedMotion> motions;  ///< one a mesh
  std::vector<Constraint> holds;
  std::vector<NodeAction> field;
  double load_scale = 1, progress = 0;
  bool actuating = true;
  BoundaryPosition boundary;
  std::map<int, Eigen::Vector3d> grip_origins;
  std::vector<CaseOnShell> cases;
  double first_stiffness = 0;  ///< of the push, N/mm
  Eigen::VectorXd along;       ///< its direction
};

/// Moves of a joint below are none, mm.
inline constexpr double nearest_mm = 1e-9;

/// Whether a pushed joint finds its own way across the push.
enum class Across { free, held };

/// One shell of one scene. Not thread-safe; its watch may be cancelled from any thread, which is
/// answered within one factorisation. Every call ends by itself too: a load step is halved five
/// times at most, a way leaves eight branches at most, and Newton's corrections are counted.
class Simulation {
 public:
  /// Errors (bad_input): rods that the rung cannot take.
  static Result<Simulation> open(std::shared_ptr<const Scene> scene, const LevelPlan& plan);

  // ---- begin ----

  /// The flat footprint itself.
  Report begin_flat();
  /// A buckled state where the rods are `shortening` shorter than flat on average: the seed's.
  /// Errors (bad_input, no_equilibrium) as first_buckled().
  Result<Report> begin_buckled(double shortening, const Watch& watch);
  /// The equilibrium next to the net.
  Result<Report> begin_on_net(const Watch& watch);
  /// The rest that a network drawn in space comes to.
  Result<Report> begin_as_drawn(const Watch& watch);
  /// A state of the finest mesh, in equilibrium or nearly.
  Report begin_at(double t, const State& fine, const Watch& watch);
  /// A state of the coarsest mesh, brought to the finest.
  Report begin_refined(double t, const State& coarse, const Watch& watch);

  // ---- move ----

  /// Follows the path to t in load steps of its own, past snaps and to the limit of the rods'
  /// length. The path parameter is sqrt(progress) in an actuation, else from 0 to 1 since the drive
  /// began.
  Report go(double t, const Watch& watch, const BifurcationPolicy& leaving = {},
            PathRecord* record = nullptr);
  /// The boundary to a progress of the scene's motion, joints held where they are.
  Report move_to(double progress, const Watch& watch, PathRecord* record = nullptr);
  /// The boundary to somewhere else altogether: the edge points straight to the motion's end.
  Report move_edge_points(const BoundaryMotion& motion, const Watch& watch);
  /// Moves a joint, held from now on.
  Report push(int joint, const Eigen::Vector3d& displacement, Across across, const Watch& watch,
              PathRecord* record = nullptr);
  /// Lets a joint go: the force on it is taken away in even steps.
  Report release(int joint, const Watch& watch);
  /// From now on the scene's dead loads count `factor` times.
  Report load(double factor, const Watch& watch);
  /// Puts a field of forces in the place of that which is there, or takes it away (empty), and with
  /// it the factor of the dead loads by `dead` up.
  Report set_field(std::vector<NodeAction> field, const Watch& watch, double dead = 0);
  /// Joints open as far as the bolts of the rods say that is to come, t from 0 to 1.
  Report open_joints(const Watch& watch, PathRecord* record = nullptr);
  /// Down the energy to rest from where it is, whatever happened to it; off a saddle to that side.
  Report rest(const Watch& watch, BranchSide side = BranchSide::lower);
  /// The same in time, with the scene's damping; `seen` after each time step.
  Report rest_in_time(const Watch& watch, const std::function<void(const MovingState&)>& seen);
  /// Other rods on the same footprint, from where it is. Errors (bad_input) as open().
  Result<Report> set_rods(const ShellRods& rods, const Watch& watch);
  /// The same shell on other meshes, finer or coarser. Errors (bad_input) as open().
  Result<Report> remesh(const LevelPlan& plan, const Watch& watch);
  /// Finer meshes until the error estimate is below `tolerance_mm`, or no plan is finer or fits the
  /// memory.
  Report refine(double tolerance_mm, const Watch& watch);
  /// Begins to push joints without going anywhere: the drive of `push`, for go().
  Report begin_joint_push(std::vector<Constraint> holds, std::vector<Eigen::Vector3d> displacements,
                          const Watch& watch);

  // ---- keep ----

  Checkpoint save() const;
  void restore(const Checkpoint& checkpoint);

  // ---- look ----

  const Scene& scene() const { return *scene_; }
  NestedShell& shell() { return *shell_; }
  const NestedShell& shell() const { return *shell_; }
  Certificate certificate() const;
  /// Positions of the nodes of the finest mesh, extrapolated where planned; joints come first.
  const Eigen::Matrix3Xd& nodes() const { return shell_->state().x; }
  /// The force that holds joint `k` of holds(), N.
  Eigen::Vector3d force(std::size_t k) const { return shell_->state().reactions[k]; }
  const std::vector<Constraint>& holds() const { return holds_; }
  const std::vector<NodeAction>& field() const { return field_; }
  const ShellRods& rods() const { return rods_ ? *rods_ : scene_->rods; }
  /// How many times the dead loads act.
  LoadFactor steady_load() const;
  double progress() const { return progress_; }
  /// Tells a frame how far the joint held last was pushed, with what force it resists, and how that
  /// grows; nothing where none is held. The depth is the way of the joint since it was taken hold
  /// of, along the directions that it is held in, mm, positive the way it was pushed; the force is
  /// the part along that way of what holds it, N.
  void put_push(record::Frame& frame) const;
  /// The stiffness along the last push and the errors of it and of the push's force.
  void put_push_errors(record::Frame& frame) const;
  /// Energies by term under what acts, extrapolated as forces are.
  Energies energies() const;
  Effort effort() const { return spent_ + shell_->effort(); }
  /// Counts what another simulation spent before this one.
  void charge(const Effort& spent) { spent_ += spent; }
  /// Certifies the state at t beside a load_step, without moving the path on; with `unstable`, or
  /// beside a load_step that is not stable, any equilibrium, which says how stable it is. `across`:
  /// one beyond t to which its branch goes on.
  Report sample(double t, const LoadStep& beside, bool unstable, const Watch& watch,
                const LoadStep* across = nullptr);
  /// The rest at t that a shell comes to which lost its branch behind the load_step.
  Report certify_rest_at(double t, const LoadStep& before, const Watch& watch);
  /// Whether the rods have come to their length.
  bool locked() const;
  /// What of the scene's limits the state is beyond: an event that is_limit(), or nothing.
  std::optional<Event> beyond_limits() const;
  /// Largest strain of a fibre by bending, on the finest mesh.
  double bending_strain() const;
  /// What touches in nodes(), the shape that is shown.
  record::Contacts contacts() const;

  BoundaryPosition boundary;
  /// Where the joints that are held were when they were taken hold of, mm.
  std::map<int, Eigen::Vector3d> grip_origins;
  /// Load cases that are on, the last that came last.
  std::vector<CaseOnShell> cases;

 private:
  Simulation(std::shared_ptr<const Scene> scene);
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
  void apply_field(std::vector<NodeAction> field);
  void set_progress(double progress);
  double load_step() const;
  Result<Outcome> replace_meshes(const LevelPlan& plan, bool nearby, const Watch& watch);
  double push_stiffness() const;
  /// How far a state may go: what its rods bear over what they may, and the least gap of each kind.
  struct Limits {
    double strained, gap_mm[record::contact_kinds];
  };
  /// The larger of bending strain and utilisation over its limit, and which: "max_utilisation =
  /// 0.8".
  std::pair<double, std::string> strained() const;
  Limits limits() const;
  Limits limits_here() const;
  std::optional<Event> beyond(const Limits& limits) const;
  class Walk;

  std::shared_ptr<const Scene> scene_;
  std::optional<ShellRods> rods_;  // in the place of the scene's
  std::shared_ptr<NestedShell> shell_;
  /// Those of rods(), by their edges per segment: a drag changes between two of them.
  std::vector<std::shared_ptr<NestedShell>> built_;
  std::optional<record::ContactSearch> search_;  // on its finest mesh
  std::vector<Constraint> holds_;
  std::vector<NodeAction> field_;  // that is there
  double load_scale_ = 1;          // of the scene's dead loads
  double progress_ = 0;
  double first_stiffness_ = 0;  // of the last push, where it began
  Eigen::VectorXd along_;       // of its displacements, in the holds' directions
  bool actuating_ = true;       // the path is the scene's motion, not a drive
  Effort spent_;                // by meshes that finer ones replaced
};

}  // namespace gridshell
