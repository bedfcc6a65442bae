// From a preset to a trajectory: the one entry point behind every command that simulates.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/fabrication.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/scene/scene.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// A finished experiment. If the path ended early, `summary.limit` gives the reason, and
/// `trajectory` has the certified frames up to there; it never contains a state that is not an
/// equilibrium.
struct ExperimentResult {
  record::Trajectory trajectory;
  record::Summary summary;
};

/// Description of a run before it is started (`gridshell check`).
struct Plan {
  std::string model;          ///< the rod model chosen
  std::string model_reason;   ///< one sentence
  int edges_per_segment = 0;  ///< edges per segment of the finest mesh
  std::vector<int> levels;    ///< edges per segment of every mesh solved
  bool extrapolated = false;  ///< Richardson over the last levels
  int rods = 0, joints = 0, cells = 0, dof = 0;
  double expected_error_mm = record::unknown;
  double expected_seconds = record::unknown;
  double memory_GB = record::unknown;  ///< memory of the program
  std::vector<std::string> seams;      ///< seams of building blocks, one sentence each
  /// on a mesh: the parts that it reaches and those that it does not, one sentence each
  std::vector<std::string> net;
  std::string bending;  ///< expected bending of the rods; empty: not known
  /// effects that the model neglects and that matter here: one sentence each
  std::vector<std::string> left_out;
  std::string footprint;               ///< "12 + 12 rods, longest leg 0.80 d, corner leg -0.15 d"
  std::shared_ptr<const Scene> scene;  ///< the scene of the preset, which run() takes
};

/// Builds the scene of a preset and describes the run. Errors: Fault::bad_input with the reason.
Result<Plan> plan(const preset::Preset& preset);

/// Runs the experiment and passes every certified frame to `sink`. Frames sample the path at
/// `preset.movie.frames` even steps, or with `stills` at its end or at `preset.figure.radii_mm`.
/// Errors: bad_input, no_equilibrium, cancelled, those of the sink.
Result<record::Summary> run(const preset::Preset& preset, bool stills, record::Sink& sink,
                            Watch& watch);

/// Runs a preset on its scene with changed meshes or load steps.
Result<record::Summary> run(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                            bool stills, record::Sink& sink, Watch& watch,
                            const RunContext& context = {});

/// Follows the path of a scene and returns it; its simulation is in the state of the last frame.
Result<EquilibriumPath> follow(const preset::Preset& preset,
                               const std::shared_ptr<const Scene>& scene, bool stills,
                               record::Sink& frames, Watch& watch, record::Summary& summary,
                               const RunContext& context = {});

/// Runs a preset and stores all frames in memory.
Result<ExperimentResult> run(const preset::Preset& preset, bool stills, Watch& watch);

// Fabrication plan of a preset.

/// The rods, marks, splices, boundaries and pins of a preset's footprint. Errors: bad_input, as
/// scene_of() and spliced().
Result<exports::FabricationPlan> fabrication_plan_of(const preset::Preset& preset);

}  // namespace gridshell::simulate
