// Choice of the mesh on which a path is followed, and when it is fine enough. It is made only here.
//
//   1. The tolerance gives the number k of edges per segment. The path is followed on this mesh.
//      The meshes of k/2 and k/4 edges give the error estimate (solve/nested_shell.h).
//   2. The edges are doubled if an error estimate is above the tolerance, if an event is missing on
//      the coarser mesh, or if the coarser mesh has no state near the fine one.
//   3. The mesh is fine enough if none of this applies, or if two consecutive meshes agree; else
//      `doubt` reports what is not confirmed.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Tolerances for the comparison of meshes. Path parameters run from 0 to 1.
struct MeshTolerances {
  /// Largest difference in the path parameter of equal events of two meshes: on 4 and 8 edges a
  /// bifurcation of the paper's shells moves by up to 0.03.
  double same_event = 0.05;
  /// Largest difference of the joints of equal states, in units of d: meshes of 4 and 8 edges
  /// differ by up to 0.05 d on one branch, and states of different branches by d and more.
  double same_state = 0.1;
  /// How often the edges are doubled for events alone, on which meshes may never agree.
  int doublings = 3;
  /// Segments of a rod up to which the first mesh is chosen by the tolerance alone.
  int segments = 26;
  /// Ratio of the estimate to the tolerance below which finer meshes need a reason.
  double clearly_finer = 10;
};
inline constexpr MeshTolerances mesh_tolerances;

/// Initial meshes: those for the tolerance, or those requested in the preset.
LevelPlan initial_levels(const Scene& scene);

/// Follows a path on the meshes of a plan. Errors: bad_input, no_equilibrium, cancelled.
using Follow = std::function<Result<EquilibriumPath>(const LevelPlan&, const Watch&)>;

/// The path on the coarsest mesh that is fine enough. `doubt` reports what is missed or not
/// confirmed: the tolerance, an event, a state. Errors: those of `follow`; bad_input if the first
/// meshes do not fit the memory.
Result<EquilibriumPath> converged_path(const Scene& scene, const Follow& follow,
                                       const Watch& watch);

/// A sentence on what a path's finest mesh and the next coarser one disagree on; empty: they agree.
std::optional<std::string> not_confirmed(const EquilibriumPath& path);

/// Whether two paths on different meshes have the same segments with the same events, near each
/// other, to the same end.
bool meshes_agree(const EquilibriumPath& coarse, const EquilibriumPath& fine);

/// Why a path is on finer meshes than its tolerance needs; empty: it is not.
std::string why_so_fine(const EquilibriumPath& path);

}  // namespace gridshell::simulate
