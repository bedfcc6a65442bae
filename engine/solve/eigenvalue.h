// How far a stable state is from losing its stability.
#pragma once

#include "engine/core/watch.h"
#include "engine/solve/linearisation.h"

namespace gridshell {

/// Smallest lambda, N/mm^2, of H v = lambda L v at a stable state: H the energy's Hessian with what
/// is held held, L the length of rod, mm, that each node stands for (`length`, one a node: half of
/// each edge that meets there). So it is the stiffness of the softest mode against a force on every
/// millimetre of rod, and does not hang on the mesh. By inverse iteration; NaN where the Hessian is
/// not positive definite. Angles (twist rung) have no length of their own: they follow.
/// `converged`: relative change at which the iteration ends.
double lowest_eigenvalue(Linearisation& system, const State& state, const Eigen::VectorXd& length,
                         const Watch& watch, double converged = 1e-7);

}  // namespace gridshell
