// Newton's method on the mixed form: positions and the axial force of every edge are unknowns; the
// forces are eliminated edge by edge, so the system solved has the size and pattern of the Hessian.
#pragma once

#include <optional>

#include "engine/core/outcome.h"
#include "engine/core/watch.h"
#include "engine/solve/linearisation.h"

namespace gridshell {

struct NewtonOptions {
  double tolerance_mm = 1e-5;  ///< converged when a correction moves no node further
  int most_iterations = 25;
  double near_mm = 0.2;  ///< corrections below this may use an old factorisation
  double trusted_mm =
      0;  ///< take a correction m of a new factorisation as the last where 8 m^2/l, l the mean rest
          ///< length of an edge, is no more than this: the next is about that or less, but
          ///< for states beside a snap, where it may be a hundred times that
  std::optional<double> trusted_misfit =
      {};  ///< and where axial forces and strains agree within this share of the largest force
  double farthest_mm = 1e300;  ///< a correction that moves a node further is refused: lost
  double widest_turn = -0.5;   ///< edges that turn further than this cosine have folded
};

struct NewtonReport {
  Outcome outcome =
      Outcome::not_converged;  ///< reached, folded, lost, not_finite, not_converged, cancelled
  int iterations = 0;          ///< corrections, with a new factorisation or an old one
  double first_move_mm = 0;    ///< of the first correction: how good the guess was
  double last_move_mm = 0;
  double factored_move_mm =
      0;            ///< since the last factorisation, the first correction with it included
  Inertia inertia;  ///< of the last factorisation (mixed form)
};

/// Full mixed Newton steps from `state`, what is held held; a factorisation is used again for as
/// long as its corrections shrink tenfold. On success `state` is the equilibrium, else it is the
/// last iterate and the report says what happened. A cancel is answered between corrections.
NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options,
                    const Watch& watch = unwatched);

}  // namespace gridshell
