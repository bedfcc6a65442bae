// Natural vibrations of a formed, loaded shell about the state that its experiment ends in.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::study {

/// A shell at the end of its preset's path.
struct FormedShell {
  simulate::EquilibriumPath path;  ///< its simulation stands in the last certified state
  record::Trajectory state;        ///< of that state the frame alone
  record::Summary summary;
};

/// Runs a preset. Errors: bad_input where nothing is solved, simulate::follow()'s.
Result<FormedShell> form_shell(const preset::Preset& preset, Watch& watch);

/// Frequencies and shapes, and the state that they are of.
struct Vibrations {
  std::vector<record::ModeRow> modes;
  /// one a mode: how every node of the layout moves, the one that moves furthest by 1
  std::vector<Eigen::Matrix3Xd> shapes;
  record::Trajectory state;  ///< one frame
  record::Summary summary;
};

/// Runs a preset and finds the `count` lowest modes of K v = (2 pi f)^2 M v about its last
/// certified state, joints that are pushed held: K the energy's Hessian, loads and axial forces in
/// it, M the masses of rods, spins and joints, lumped on each mesh. Frequencies of the last meshes,
/// paired by their shapes, are extrapolated and estimated as forces are. Errors: bad_input, of rods
/// without density and of what nothing is solved for; no_equilibrium; cancelled.
Result<Vibrations> vibrations_of(const preset::Preset& preset, int count, Watch& watch);
/// The same of a shell that is formed, which stands as before afterwards.
Result<Vibrations> vibrations_of(FormedShell& shell, int count, const Watch& watch);

}  // namespace gridshell::study
