// The equilibrium path of an experiment: followed once, in load steps of its own, then sampled.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// Relative shortening of the rods, (flat length - length)/flat length, down to which a path is
/// followed towards the flat state.
inline constexpr double flat_shortening = 1e-3;

/// A monotonic stretch of the path of a simulation. PathRecord has its load steps and snaps in
/// order.
struct PathSegment : PathRecord {
  double from = 0,
         to = 0;      ///< path parameters of its start and of its requested end, dimensionless
  Report report;      ///< how it ended, its events and cost; written by Simulation::go
  bool back = false;  ///< whether it leads from the first state back towards the flat state
  // Members of a step, whose motion later steps replace:
  std::string step = {};      ///< the step as text: "push [0, 0]"; empty: the segment is no step
  bool sampled = false;       ///< whether frames are sampled along its path
  std::string reported = {};  ///< sentence on it in addition to its certificate
  /// The simulation at the end of the segment's path, of a step only if the step changes it
  /// further, and after the step.
  std::optional<Checkpoint> path_end = {}, after = {};
  /// 1 where the path parameter grows along the segment, -1 where it falls.
  double sign() const { return to < from ? -1 : 1; }
  /// Path parameter of the last certified state.
  double end() const { return load_steps.back().point.t; }
  /// Frees the states of the load steps, nearly all memory of a path; its events, certificates and
  /// parameters remain.
  void free_states();
};

/// A position on the path at which parts of one kind begin to touch or separate.
struct ContactEvent {
  std::size_t segment = 0;  ///< index in EquilibriumPath::segments
  double t = 0, error = 0;  ///< path parameter and its uncertainty: half the interval between two
                            ///< certified states
  std::string text;         ///< which parts touch, where in space and where on the path
};

/// Writes a path parameter in the terms of the experiment, "at progress 0.4312", with its error if
/// one is known.
using At = std::function<std::string(double t, std::optional<double> error)>;

/// "at progress 0.0183 ± 0.0005", of a path parameter of an actuation.
std::string at_progress(double t, std::optional<double> error);

/// A push of a joint by `displacement`, along the normal of the net, or of the unloaded shell if
/// there is no net.
struct Push {
  int joint = 0;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Matrix3Xd before = {};  ///< joints of the unloaded shell, mm, 3 x n
  bool unload = false;           ///< whether the joint is moved back afterwards

  double depth_mm() const { return displacement.norm(); }
};

/// A simulation with the segments of the path that were followed in it.
struct EquilibriumPath {
  /// The simulation that followed the path. Reading a state of the path moves it.
  Simulation simulation;
  /// The segments in the order in which they were followed.
  std::vector<PathSegment> segments = {};
  std::vector<PathSegment> earlier = {};  ///< segments of the actuation before a push or steps
  std::optional<Push> push = {};          ///< the push of [indentation] that `segments` follow
  /// Joints that the segments push, for the layout of a run.
  std::vector<record::LoadedJoint> loaded_joints = {};
  At at = at_progress;    ///< how texts name a position on `segments`
  LevelPlan meshes = {};  ///< mesh levels on which the path was followed
  /// Time to build the meshes and the first state, s.
  double seconds_setup = 0;
  /// A sentence on what a second mesh does not confirm, or on a missed tolerance; empty: neither.
  std::string mesh_disagreement = {};
  std::string doubt_before = {};  ///< doubt_about() the actuation before a push or steps
  bool tolerance_missed = false;  ///< whether an error is above the tolerance or not known
  /// Which limit ended the path, and the sentence that reports it; written by set_limit().
  record::Limit limit = record::Limit::none;
  std::string limit_reason = {};
  /// Why the step after the last segment could not begin; empty: it did, or there is none.
  std::string refused = {};
  /// Contacts along the path, written by contact_events().
  std::vector<ContactEvent> contacts = {};

  /// Whether the segments are steps. Else all belong to the current motion of `simulation`.
  bool of_steps() const { return !segments.empty() && segments.front().after; }
  /// How texts name a position on one of the segments: by `at`, or, of a step that moves the whole
  /// boundary, by its progress.
  At at_on(const PathSegment& segment) const;
  /// Whether the path ended because its mesh is too coarse (LevelPlan::allowed_mm). Later segments
  /// are then not followed.
  bool too_coarse() const;
};

/// Largest distance, mm, between the joints of the current state and the first columns of `nodes`
/// (3 x nodes of the finest mesh, mm).
double distance_of_joints(const Simulation& simulation, const Eigen::Matrix3Xd& nodes);

/// Whether t is within twice the error of an event, where the branch changes: it is then not known
/// on which side of the event t is. States there have no error estimate.
bool at_event(const PathSegment& segment, double t);

/// The stable load step of a path that is at no event and has the largest error estimate; null:
/// none has one.
const LoadStep* worst_load_step(const EquilibriumPath& path);
/// Error estimate of worst_load_step(), mm; NaN: there is none.
double worst_estimate_mm(const EquilibriumPath& path);

/// The last load step that the segment passed before parameter t.
const LoadStep& load_step_before(const PathSegment& segment, double t);

/// Whether consecutive load steps a and b are on the same branch: both are stable, and no event is
/// between them.
bool goes_on_between(const PathSegment& segment, const LoadStep& a, const LoadStep& b);

/// Whether no state of the segment has a Hessian with negative pivots.
bool all_stable(const PathSegment& segment);

/// Follows the path from the current state to parameter `to` and appends the segment. From a state
/// past a limit only a segment back towards the flat state can be followed, or one from a drawing,
/// whose rods may be strained before anything moves: it ends if it exceeds that state's measures.
PathSegment& follow_segment(EquilibriumPath& path, double to, const BifurcationPolicy& leaving,
                            const Watch& watch);

/// A requested sample of the path.
struct PathSample {
  int index = 0;  ///< index of the frame, from 0
  /// Index in EquilibriumPath::segments.
  std::size_t segment = 0;
  double t = 0;            ///< path parameter
  double progress = 0;     ///< progress of the experiment, from 0 to 1
  double actuation = 1;    ///< progress of the boundary, from 0 to 1
  bool ends_step = false;  ///< whether it is the state after a step, not one of its path
  /// `segment` of the state before the path: the flat footprint, or the shell before the steps.
  static constexpr std::size_t before_path = -1;
};

/// Progress of an actuation or of the push of [indentation] at path parameter t of a segment.
double progress_on(const EquilibriumPath& path, std::size_t segment, double t);

/// Whether the shell snapped on the segment.
bool snapped(const PathSegment& segment);

/// Whether t is between the two branches of a snap, where neither may have a state.
bool within_snap(const PathSegment& segment, double t);

/// How a sample was certified. `past`: the path parameter that the segment had reached when it
/// found the branch of the sample; events before it apply to this state.
struct CertifiedSample {
  Report report;
  double past = 0;
};

/// Certifies the path at a sample and leaves the simulation in that state. The load steps of the
/// path do not change. Outcomes as of Simulation::sample().
CertifiedSample certify_sample(EquilibriumPath& path, const PathSample& sample, const Watch& watch);

/// Text of the frame in which a path ended at a limit; empty for another end.
std::string limit_event(const Simulation& simulation, Outcome end);

/// Sets `limit` and `limit_reason` from how the segments ended: the first that ended before its
/// requested end, else the snaps. Switching to a branch is no limit; the sentence reports where it
/// happened. For a push it reports its limit point, and the snaps of the actuation before it; for
/// steps it names the step.
void set_limit(EquilibriumPath& path, const Watch& watch);

/// One sentence for each step of the path: "2 push [0, 0]: reached, residual 3.1e-10 N, stable".
std::vector<std::string> messages_of_steps(const EquilibriumPath& path);

/// Computes where parts begin to touch and where they separate. Between load steps of one branch
/// the state is interpolated by the cubic through both.
std::vector<ContactEvent> contact_events(const EquilibriumPath& path);

}  // namespace gridshell::simulate
