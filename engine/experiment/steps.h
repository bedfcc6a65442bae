// What a hand does to a shell, as the steps of a preset: the one place that turns a [[step]] into
// calls of a session, for runs and for the window alike.
#pragma once

#include <string>

#include "engine/preset/preset.h"
#include "engine/session/session.h"

namespace gridshell::experiment {

/// Where a hand has the boundary: how far along the scene's motion, and by how much its edge points
/// lie off that.
struct HandBoundary {
  double progress = 1;
  Eigen::Matrix3Xd dragged;  ///< 3 x edge points, mm

  /// At the end of the scene's motion.
  static HandBoundary of(const Scene& scene) {
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

/// The way of a move or of a push: what was followed, and where the session stood at its end.
struct Way {
  Trail trail;
  Checkpoint end = {};
};

/// Does one step; `boundary` follows what was reached. A step that ends early leaves the session in
/// its last certified state, a `release`, `rest` or `jitter` where it was before. All but moves and
/// loads are led by the coarsest mesh alone (`way.end` of a push stands on that one), or by a finer
/// one where others do not follow it: the session then stands on finer meshes. Errors
/// (bad_input): a joint or an edge point that is not there, nothing to release, edge points to be
/// moved by themselves whose rods' directions are held.
Result<Report> take_step(Session& session, HandBoundary& boundary, const preset::Step& step,
                         const Watch& watch, Way* way = nullptr);

}  // namespace gridshell::experiment
