// The path of an experiment as an object: followed once, by steps of its own, then sampled.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/record/summary.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// How near to the flat a path is followed: what its rods are shorter there, over their length.
inline constexpr double flat_shortening = 1e-3;

/// One way along the path of a simulation, from where it began to where it was to end.
struct PathSegment : PathRecord {
  double from = 0, to = 0;  ///< path parameter
  Report report;            ///< how it ended
  bool back = false;        ///< from the first state back towards the flat
  /// 1 where its parameter grows, -1 where it falls
  double sign() const { return to < from ? -1 : 1; }
  /// Path parameter of the last certified state.
  double end() const { return load_steps.back().point.t; }
};

/// Where on the path parts of one kind begin to touch, or touch no more.
struct ContactEvent {
  std::size_t segment = 0;
  double t = 0, error = 0;  ///< path parameter: between two certified states
  std::string text;         ///< which, where in space and on the path
};

/// A simulation with the segments that were followed in it, and what ended them.
struct EquilibriumPath {
  Simulation simulation;
  std::vector<PathSegment> segments = {};
  std::vector<PathSegment> earlier = {};  ///< of a push: those of the actuation before it
  LevelPlan meshes = {};                  ///< that it was followed on
  bool single_motion = true;  ///< whether all segments are of the motion that the simulation is on
  double seconds_setup = 0;
  std::string mesh_disagreement =
      {};                         ///< what is not confirmed, or missed, a sentence; empty: nothing
  bool tolerance_missed = false;  ///< somewhere the error is above the tolerance, or not known
  record::Limit limit = record::Limit::none;
  std::string limit_reason = {};
  std::vector<ContactEvent> contacts = {};

  /// Whether it ended as its mesh is too coarse (LevelPlan::allowed_mm): what comes after it is not
  /// followed then.
  bool too_coarse() const;
};

/// Largest distance of the joints where a simulation stands from those of nodes of its finest mesh,
/// mm.
double distance_of_joints(const Simulation& simulation, const Eigen::Matrix3Xd& nodes);

/// Largest error estimate of stable states, mm; NaN where none is known.
double worst_estimate_mm(const EquilibriumPath& path);

/// The load_step that a sample of a segment lies behind: the last one that the segment came past
/// before it.
const LoadStep& load_step_before(const PathSegment& segment, double t);

/// Whether nothing happens to the branch between two load steps that follow one another, both
/// stable.
bool goes_on_between(const PathSegment& segment, const LoadStep& a, const LoadStep& b);

/// Whether no state of a segment has a negative pivot.
bool all_stable(const PathSegment& segment);

/// From where the simulation stands on: follows the path to `to` and keeps the way as a segment.
/// What begins beyond a limit goes nowhere, but back.
PathSegment& follow_segment(EquilibriumPath& path, double to, const BifurcationPolicy& leaving,
                            const Watch& watch);

/// A sample of a segment.
struct PathSample {
  int index = 0;  ///< of the frame
  std::size_t segment = 0;
  double t = 0;         ///< path parameter
  double progress = 0;  ///< of the experiment
};

/// Whether t lies in the jump between two branches, where neither may have a state.
bool within_snap(const PathSegment& segment, double t);

/// How a sample was certified, and the path parameter that the segment had reached when the
/// sample's branch was found: events before it have happened to this state.
struct CertifiedSample {
  Report report;
  double past = 0;
};

/// Certifies the path at a sample and leaves the simulation there; what the path itself found is
/// not changed by it. Outcomes as of a path.
CertifiedSample certify_sample(EquilibriumPath& path, const PathSample& sample, const Watch& watch);

/// Says where a path parameter lies, in the experiment's own words: "at progress 0.4312", with its
/// error where it is known.
using At = std::function<std::string(double t, std::optional<double> error)>;

/// What a frame says of the state in which a path ended at a limit; empty: it ended otherwise.
std::string limit_event(const Simulation& simulation, Outcome end);

/// Where segments left a branch for a rest further on, by a leap or along another branch that
/// leaves there: "at progress 0.0183 and at ..."; empty: nowhere.
std::string branch_loss_places(std::span<const PathSegment> segments, const At& at,
                               bool leap = true);

/// Tells as a limit and a sentence how the segments ended and what they came past: the first that
/// ended before its end, else the snaps. A path that branches has no limit, and the sentence says
/// where.
void set_limit(EquilibriumPath& path, const At& at);

/// Where on a path parts begin to touch and where they part again: between load steps of one branch
/// by the cubic through both.
std::vector<ContactEvent> contact_events(const EquilibriumPath& path, const At& at);

}  // namespace gridshell::simulate
