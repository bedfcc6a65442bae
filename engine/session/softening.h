// How a path steps where its shell grows soft.
#pragma once

#include <optional>

#include "engine/core/watch.h"
#include "engine/solve/nested.h"

namespace gridshell {

/// Follows the stiffness of the softest mode on the leading mesh from load step to load step. A
/// branch may lose its stability and regain it within one step, and the shell would have left it
/// in between: where the stiffness heads for zero, steps become short enough to see that.
class Softening {
 public:
  /// After a load step that was certified.
  void take(NestedShell& shell, const Watch& watch);
  /// Nothing is known of the path: it goes on from somewhere else.
  void forget() { before_.reset(), now_.reset(); }
  /// The load step to take in the place of `step`, at least an eighth of it.
  double shortened(double step) const;

 private:
  struct Point {
    double t, stiffness;
  };
  std::optional<Point> before_, now_;
};

}  // namespace gridshell
