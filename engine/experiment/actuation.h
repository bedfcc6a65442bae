// The actuation of a footprint: its edge points move straight and evenly from the original to the
// actuated boundary, through equilibria.
#pragma once

#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/footprint/blocks.h"
#include "engine/footprint/flat_frame.h"
#include "engine/footprint/footprint.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/gridshell/twist_shell.h"
#include "engine/record/snapshot.h"
#include "engine/record/summary.h"
#include "engine/solve/buckle.h"
#include "engine/solve/nested.h"

namespace gridshell::experiment {

/// Whether and how a snap is followed in time.
struct SnapDynamics {
  bool wanted = false;
  double step_s = 0, damping_per_s = 0;
};

/// Everything that an actuation needs to know.
struct ActuationScene {
  Footprint footprint;
  ShellRods rods;
  TwistRods twist;                    ///< the same on the `twist` rung
  std::vector<double> mass_t_per_mm;  ///< one a rod; 0: not known
  double rod_diameter_mm = 0;
  BoundaryMotion motion;
  double length_scale_mm = 0;                ///< R_o: what errors are relative to
  FlatFrame flat;                            ///< where the flat footprint lies
  std::shared_ptr<const ChebyshevNet> net;   ///< that it was designed on, if it was
  std::shared_ptr<const Assemblage> blocks;  ///< that the net is made of, if it is
  bool from_net = false;                     ///< the path starts at the net, where progress is 1
  Eigen::Matrix3Xd original_boundary;        ///< closed polylines in correspondence, for pictures
  Eigen::Matrix3Xd actuated_boundary;
  double radius_begin_mm = record::unknown;  ///< of a circular boundary
  double radius_end_mm = record::unknown;
  BuckleSeed seed;
  LevelPlan levels;  ///< to begin with; finer ones follow where the tolerance asks for them
  bool levels_fixed = false;  ///< the mesh was asked for
  double tolerance = 1e-3;    ///< of the joints, over length_scale_mm
  double max_strain = 1e-3;
  SnapDynamics snap;
};

/// What came out; `limit` says why the path ended before the last sample, if it did.
struct ActuationOutcome {
  record::Trajectory trajectory;
  record::Limit limit = record::Limit::none;
  std::string limit_reason;
  LevelPlan levels;  ///< that were used
  int dof = 0;
  Effort effort;
  std::unique_ptr<NestedShell> shell;  ///< in the state certified last, to go on from
  double seconds_setup = 0, seconds_simulation = 0;
};

/// Samples the path at `progress` (ascending, in [0, 1]; 0 is the flat footprint). From flat the
/// path is found the patient way: a first buckled state where the rods are 2 % shorter than flat on
/// average, from there back towards the flat and on to the end. From the net it is found at the
/// equilibrium next to the net, progress 1, and followed backwards. Errors: bad_input,
/// no_equilibrium (not a single buckled state), cancelled.
Result<ActuationOutcome> run_actuation(const ActuationScene& scene,
                                       const std::vector<double>& progress, Watch& watch);

}  // namespace gridshell::experiment
