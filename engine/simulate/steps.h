// What a hand does to a shell, as the steps of a preset: the one place that turns a [[step]] into
// calls of a simulation, for runs and for the window alike.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/record/frame.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// Where a hand has the boundary: how far along the scene's motion, and by how much its edge points
/// lie off that.
struct BoundaryPosition {
  double progress = 1;
  Eigen::Matrix3Xd dragged;  ///< 3 x edge points, mm

  /// At the end of the scene's motion.
  static BoundaryPosition of(const Scene& scene) {
    return {1, Eigen::Matrix3Xd::Zero(3, scene.motion.begin.cols())};
  }
};

/// Moves of a joint below are none, mm.
inline constexpr double nearest_mm = 1e-9;

/// What a step does, as people read it: "push [2, -1]".
std::string text_of(const preset::Step& step);

/// The joint that a step names. Errors (bad_input): the footprint has none such.
Result<int> joint_of(const preset::Step& step, const Footprint& footprint);

/// The progress that a move asks for.
double progress_of(const preset::Step& step, const Scene& scene);

/// The way of a move or of a push: what was followed, and where the simulation stood at its end.
struct StepPath : PathRecord {
  Checkpoint end = {};
};

/// Does one step; `boundary` follows what was reached. A step that ends early leaves the simulation
/// in its last certified state, a `release`, `rest` or `jitter` where it was before. All but moves
/// and loads are led by the coarsest mesh alone (`way.end` of a push stands on that one), or by a
/// finer one where others do not follow it: the simulation then stands on finer meshes. Errors
/// (bad_input): a joint or an edge point that is not there, nothing to release, edge points to be
/// moved by themselves whose rods' directions are held.
Result<Report> apply_step(Simulation& simulation, BoundaryPosition& boundary,
                          const preset::Step& step, const Watch& watch, StepPath* way = nullptr);

// Where a hand took hold of joints: what the depth and the force of its pushes are told from.

/// The joint held last, and where it was when it was taken hold of.
struct GrippedJoint {
  int joint = -1;  ///< none
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

/// Remembers, over the steps of a simulation, where its joints were before they were held.
class GrippedJoints {
 public:
  /// Before a step: where every joint stands that nothing holds.
  void note(const Simulation& simulation);
  /// After it.
  GrippedJoint last(const Simulation& simulation) const;

 private:
  std::map<int, Eigen::Vector3d> at_;
};

/// Tells the frame of the state that a simulation stands in how far the joint of a grip was moved
/// the way it is held, mm, and with what force it resists, N; nothing where none is held.
void fill_push(const Simulation& simulation, const GrippedJoint& grip, record::Frame& frame);

// A run of a preset with steps: the shell is actuated, then a hand does one step after the other.

/// How many of `frames` fall to each step, the first frame being the shell before them all: one to
/// each, and what is left to those that have a way to be shown, moves of the whole boundary and
/// pushes, evenly.
std::vector<int> frames_of_steps(const std::vector<preset::Step>& steps, int frames);

/// What became of the steps.
struct StepsResult {
  EquilibriumPath path;
  std::vector<std::string> messages = {};  ///< a sentence a step that was begun
};

/// Does the steps in order until one ends early, which is then the path's limit, and hands frames
/// to the sink: the shell before, and of each step as many as frames_of_steps() says, each
/// certified. They only sample the steps' ways. Meshes are chosen and events confirmed as for a
/// path (path.h). Errors: bad_input as apply_step(), no_equilibrium (no shell to begin with),
/// cancelled, the sink's.
Result<StepsResult> run_steps(const std::shared_ptr<const Scene>& scene,
                              const std::vector<preset::Step>& steps, int frames,
                              record::Sink& sink, Watch& watch);

}  // namespace gridshell::simulate
