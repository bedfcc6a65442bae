// What a step of a session says: how it ended, what it certified, what happened on its way.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/outcome.h"
#include "engine/solve/nested.h"

namespace gridshell {

/// What is known of a state.
struct Certificate {
  double residual_N = 0;         ///< largest force that nothing holds
  int negative_pivots = 0;       ///< of the Hessian with what is held held; 0: stable
  double error_estimate_mm = 0;  ///< of the joints; NaN on one mesh
  double largest_strain = 0;     ///< by size; below 0: a compression

  bool stable() const { return negative_pivots == 0; }
};

/// Something that happened to the shell on its path.
struct Event {
  enum class Kind { stability_lost, turned_back, locked };
  Kind kind = Kind::stability_lost;
  double t = 0;                 ///< where: as one mesh says, or extrapolated where two say it
  std::optional<double> error;  ///< of t, where two meshes say it
  std::optional<double> to;     ///< where the next rest stands, if one was found
};

/// How a step ended: what was reached, why no more, what it cost. Where not all was reached the
/// shell stands in the last certified state.
struct Report {
  Outcome end = Outcome::reached;
  double t = 0;               ///< path parameter reached
  Certificate certificate;    ///< of the state the shell stands in
  std::vector<Event> events;  ///< on the way
  Effort effort;
  double seconds = 0;
};

/// A point of a path with the certificate of all meshes.
struct Station {
  NestedPoint point;
  Certificate certificate;
};

/// What the coarsest mesh was like at a time, while it moved.
struct Moment {
  double time = 0;  ///< s
  State state;
};

/// What a path leaves to whoever watches it: a station a certified load step, in order, and what
/// moved in time where a snap was followed so.
struct Trail {
  std::vector<Station> stations;
  struct Snap {
    std::size_t before = 0;  ///< the station that it left from
    std::vector<Moment> moments;
  };
  std::vector<Snap> snaps;
};

/// How a branch that ended is left.
struct Leaving {
  bool wanted = true;             ///< false: the path ends there
  bool through_unstable = false;  ///< go on through states that are not stable instead
};

}  // namespace gridshell
