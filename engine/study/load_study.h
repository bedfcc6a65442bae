// What a formed shell carries: the load factor over a joint's way, for each of its load cases.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/study/modes.h"

namespace gridshell::study {

struct LoadStudy {
  std::vector<record::LoadPoint> points;  ///< of the finest mesh, case by case
  std::vector<record::LoadRow> cases;
  /// one a case: how the nodes of the layout move where stability is lost, the one that moves
  /// furthest by 1; empty: it is not
  std::vector<Eigen::Matrix3Xd> modes;
  /// one a case: what comes on with a factor of one, on the layout's supports, N
  std::vector<Eigen::Matrix3Xd> loads;
  record::Trajectory state;  ///< that the loads come on to: one frame
  record::Summary summary;
};

/// Runs a preset and brings each of its load cases on to the last certified state, beside what acts
/// there, by arc length until stability is lost and a little beyond a limit point. Critical factors
/// of the last two meshes are extrapolated, and their difference is the error, as with all forces;
/// so are the factors at which a fibre comes to its rod's strength. Where the meshes lose their
/// stability by different events, which lie close together then, the finer one's is told.
/// `imperfections` shells more a case, on the coarser of these meshes, have a random mixture of the
/// softest modes as their shape, `loads.imperfection` of the length scale at most, by the dead
/// forces that bend the perfect shell so far to first order. Errors: bad_input (no case, nothing is
/// solved), no_equilibrium, cancelled.
Result<LoadStudy> load_study(const preset::Preset& preset, int imperfections, Watch& watch);
/// The same of a shell that is formed, which stands as before afterwards.
Result<LoadStudy> load_study(FormedShell& shell, int imperfections, Watch& watch);

}  // namespace gridshell::study
