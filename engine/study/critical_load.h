// Where a state under growing loads loses its stability, on one mesh: by arc length, and as the
// linearised problem at its begin estimates it.
#pragma once

#include <vector>

#include "engine/core/watch.h"
#include "engine/record/study_tables.h"
#include "engine/study/bifurcation_diagram.h"

namespace gridshell::study {

struct CriticalOptions {
  double max_strain = 1e-3;     ///< the path ends there
  double most_factor = 1000;    ///< of the load
  double largest_mm = 0;        ///< arc steps may be so long; 0: by the linear estimate alone
  double steps_to_linear = 40;  ///< first arc steps up to the linear estimate
  int most_steps = 160;         ///< of the path
  int after_turn = 12;          ///< of it beyond its first limit point
  double tolerance_mm = 1e-7;
};

/// What was found.
struct CriticalLoad {
  std::vector<TracedPoint> points;  ///< the path, its parameter the load factor
  double factor = record::unknown;  ///< where the first stability is lost; NaN: not on this path
  /// bifurcation or turn (a limit point); else how the path ended: locking, lost, none (it went all
  /// the way)
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

}  // namespace gridshell::study
