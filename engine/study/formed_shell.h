// Studies of a formed, loaded shell in the state in which its experiment ends: natural vibrations
// and critical loads.
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

/// A shell at the end of its preset's path.
struct FormedShell {
  simulate::EquilibriumPath path;  ///< its simulation is in the last certified state
  record::Trajectory state;        ///< one frame: the last certified state
  record::Summary summary;
};

/// Runs a preset. Errors: bad_input for the net model, which solves nothing; those of
/// simulate::follow().
Result<FormedShell> form_shell(const preset::Preset& preset, Watch& watch);

/// Natural frequencies and mode shapes of a shell about one of its states.
struct Vibrations {
  std::vector<record::ModeRow> modes;
  /// one per mode: displacements of the layout's nodes (3 x n), the largest of length 1
  std::vector<Eigen::Matrix3Xd> shapes;
  record::Trajectory state;  ///< one frame: the state about which the shell vibrates
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

// Critical loads on one mesh: the load factor at which a state under increasing loads loses its
// stability, found on its equilibrium path by arc length, and its estimate by the linearised
// problem at the start.

struct CriticalOptions {
  double max_strain = 1e-3;   ///< the path ends at this strain
  double most_factor = 1000;  ///< the path ends at this load factor
  /// largest arc step, unless the linear estimate allows a longer one; 0: the estimate alone
  double largest_mm = 0;
  double steps_to_linear = 40;  ///< arc steps of the initial length up to the linear estimate
  int most_steps = 160;         ///< the path ends after so many arc steps
  int after_turn = 12;          ///< the path ends so many steps after its first limit point
  double tolerance_mm = 1e-7;   ///< of Newton's corrections
};

/// Loss of stability under increasing loads, and the path to it.
struct CriticalLoad {
  std::vector<TracedPoint> points;  ///< the path; its parameter is the load factor
  double factor = record::unknown;  ///< at the first loss of stability; NaN: none on this path
  /// bifurcation or turn (a limit point); else how the path ended: locking, lost, none (complete)
  record::BranchEvent event = record::BranchEvent::none;
  double linear = record::unknown;  ///< linear_critical_factor(); NaN for models with cables
  Eigen::Matrix3Xd mode;  ///< that loses stability, all columns, largest length 1; empty: none
};

/// The smallest factor > 0 at which K_0 + factor K_g is singular. K_0 is the Hessian at the stable
/// state `begin` under the loads of `motion` at parameter 0, K_g its derivative by the factor along
/// the path's tangent at that state (axial forces and shape). Computed by subspace iteration on
/// K_0^-1 K_g [Bathe 1996]. NaN: there is none, or the state is not stable.
double linear_critical_factor(Linearisation& system, const PinnedMotion& motion, const State& begin,
                              const Watch& watch);

/// Follows the equilibrium `begin` under the loads that `motion` applies, whose factor is its
/// parameter. A limit point is the top of the parabola through the three points around it;
/// bifurcations are located by bisection.
CriticalLoad critical_load(Linearisation& system, const PinnedMotion& motion, const State& begin,
                           const CriticalOptions& options, const Watch& watch);

/// Equilibrium paths and critical factors of all load cases of a shell.
struct LoadStudy {
  std::vector<record::LoadPoint> points;  ///< on the finest mesh, case by case
  std::vector<record::LoadRow> cases;
  /// one per case: the mode that loses stability, as displacements of the layout's nodes (3 x n),
  /// the largest of length 1; empty: stability is not lost
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
/// reported. For each case `imperfections` imperfect shells are loaded too, on the coarser of these
/// meshes. Their shape is displaced by a random mixture of the lowest modes, at most
/// `loads.imperfection` of the length scale, which dead forces produce (to first order). Errors:
/// bad_input (no case, or the net model), no_equilibrium, cancelled.
Result<LoadStudy> load_study(const preset::Preset& preset, int imperfections, Watch& watch);
/// Load study of a formed shell, whose state does not change.
Result<LoadStudy> load_study(FormedShell& shell, int imperfections, Watch& watch);

}  // namespace gridshell::study
