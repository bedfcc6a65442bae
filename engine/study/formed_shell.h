// What is found out about a formed, loaded shell, in the state that its experiment ends in.
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
#include "engine/study/bifurcation_diagram.h"

namespace gridshell::study {

// Natural vibrations about it.

/// A shell at the end of its preset's path.
struct FormedShell {
  simulate::EquilibriumPath path;  ///< its simulation is in the last certified state
  record::Trajectory state;        ///< of that state the frame alone
  record::Summary summary;
};

/// Runs a preset. Errors: bad_input where nothing is solved, simulate::follow()'s.
Result<FormedShell> form_shell(const preset::Preset& preset, Watch& watch);

/// Frequencies and shapes, and the state that they are of.
struct Vibrations {
  std::vector<record::ModeRow> modes;
  /// one per mode: how every node of the layout moves, the one that moves furthest by 1
  std::vector<Eigen::Matrix3Xd> shapes;
  record::Trajectory state;  ///< one frame
  record::Summary summary;
};

/// Runs a preset and computes the `count` lowest modes of K v = (2 pi f)^2 M v about its last
/// certified state, with pushed joints fixed. K is the Hessian of the energy, including loads and
/// axial forces, M the masses of rods (also their rotation) and joints, lumped on each mesh.
/// Frequencies of the last meshes, paired by their mode shapes, are extrapolated, and their error
/// is estimated as that of forces. Errors: bad_input for rods without density and for a preset
/// without a solve; no_equilibrium; cancelled.
Result<Vibrations> vibrations_of(const preset::Preset& preset, int count, Watch& watch);
/// Vibrations of a formed shell, whose state does not change.
Result<Vibrations> vibrations_of(FormedShell& shell, int count, const Watch& watch);

// Load factor over the displacement of a joint for each load case. On one mesh: where a state under
// increasing loads loses its stability, by arc length, and the estimate of the linearised problem
// at its start.

struct CriticalOptions {
  double max_strain = 1e-3;     ///< the path ends there
  double most_factor = 1000;    ///< of the load
  double largest_mm = 0;        ///< arc steps may be so long; 0: by the linear estimate alone
  double steps_to_linear = 40;  ///< first arc steps up to the linear estimate
  int most_steps = 160;         ///< of the path
  int after_turn = 12;          ///< steps of it after its first limit point
  double tolerance_mm = 1e-7;
};

/// What was found.
struct CriticalLoad {
  std::vector<TracedPoint> points;  ///< the path, its parameter the load factor
  double factor = record::unknown;  ///< where the first stability is lost; NaN: not on this path
  /// bifurcation or turn (a limit point); else how the path ended: locking, lost, none (complete)
  record::BranchEvent event = record::BranchEvent::none;
  double linear = record::unknown;  ///< linear_critical_factor(), of models without cables
  Eigen::Matrix3Xd mode;            ///< over all columns, longest move 1; empty: none
};

/// The smallest factor > 0 at which K_0 + factor K_g is singular: K_0 the Hessian at a stable state
/// under motion's loads at 0, K_g its change with the factor along the path's tangent there (axial
/// forces and shape). By subspace iteration on K_0^-1 K_g [Bathe 1996]. NaN: there is none, or the
/// state is not stable.
double linear_critical_factor(Linearisation& system, const PinnedMotion& motion, const State& begin,
                              const Watch& watch);

/// Follows the equilibrium `begin` under the loads that `motion` brings on by its parameter. Limit
/// points are the top of the parabola through the three points around, bifurcations are bisected.
CriticalLoad critical_load(Linearisation& system, const PinnedMotion& motion, const State& begin,
                           const CriticalOptions& options, const Watch& watch);

struct LoadStudy {
  std::vector<record::LoadPoint> points;  ///< of the finest mesh, case by case
  std::vector<record::LoadRow> cases;
  /// one per case: how the nodes of the layout move where stability is lost, the one that moves
  /// furthest by 1; empty: it is not
  std::vector<Eigen::Matrix3Xd> modes;
  /// per case: the load at a factor of one, on the layout's supports, N
  std::vector<Eigen::Matrix3Xd> loads;
  record::Trajectory state;  ///< the state to which the loads are applied: one frame
  record::Summary summary;
};

/// Runs a preset and applies each of its load cases to the last certified state, in addition to the
/// loads present, by arc length until stability is lost and slightly past a limit point. Critical
/// factors of the last two meshes are extrapolated, with their difference as the error, as for all
/// forces; so are the factors at which a fibre reaches its rod's strength. If the meshes lose
/// stability by different events, which are then close together, that of the finer mesh is
/// reported. `imperfections` further shells per case, on the coarser of these meshes, have a random
/// mixture of the lowest modes as their shape, at most `loads.imperfection` of the length scale,
/// produced by the dead forces that deform the perfect shell by that amount to first order. Errors:
/// bad_input (no case, no solve), no_equilibrium, cancelled.
Result<LoadStudy> load_study(const preset::Preset& preset, int imperfections, Watch& watch);
/// Load study of a formed shell, whose state does not change.
Result<LoadStudy> load_study(FormedShell& shell, int imperfections, Watch& watch);

}  // namespace gridshell::study
