// Minimum-energy path between two stable states and its highest point, the mountain pass, which
// gives the height of the barrier.
#pragma once

#include <vector>

#include "engine/core/outcome.h"
#include "engine/core/watch.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// A saddle with one descent direction.
struct MountainPass {
  Outcome outcome = Outcome::not_converged;  ///< reached, not_converged, cancelled
  State saddle;
  double energy_mJ = 0;
  double residual_N = 0;
  Eigen::Matrix3Xd towards_b;     ///< lowest mode of the saddle, a unit vector, towards b
  std::vector<double> string_mJ;  ///< energies of the string, from a to b
};

/// Finds the saddle by the string method [E, Ren, Vanden-Eijnden 2007]. A string of states grows
/// from both ends, descends in energy perpendicular to itself, and is distributed evenly after
/// every round. From its highest state Newton's method finds an equilibrium, which is accepted if
/// it has one negative pivot and is on the string. Steps are linearly implicit, (K + m I) dx =
/// -dE/dx, so that stiff rods retain their lengths. `a` and `b` are stable states of one model with
/// the same ends; no node moves further than `step_mm` in one step. The caller must check that the
/// saddle's two sides lead to `a` and `b`: there may be other states between them.
MountainPass mountain_pass(Linearisation& system, const State& a, const State& b, double step_mm,
                           const Watch& watch);

}  // namespace gridshell
