// A bifurcation diagram: the points of a path and of the branches that leave it.
#pragma once

#include <string>
#include <vector>

#include "engine/core/words.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// What happens at a point of a branch.
enum class BranchEvent {
  none,
  bifurcation,  ///< stability changes and the path goes on: branches cross
  turn,         ///< the path turns back: a limit point
  joins,        ///< the branch meets one that was followed before
  locking,      ///< the rods are at their length: it ends there
  lost,         ///< it could not be followed further
};
constexpr auto words(BranchEvent) {
  return word_table<BranchEvent>({{BranchEvent::none, ""},
                                  {BranchEvent::bifurcation, "bifurcation"},
                                  {BranchEvent::turn, "turn"},
                                  {BranchEvent::joins, "joins"},
                                  {BranchEvent::locking, "locking"},
                                  {BranchEvent::lost, "lost"}});
}

/// One equilibrium of a branch; points of a branch stand in the order of its arc length.
struct BranchPoint {
  int branch = 0;       ///< 0: the path itself
  double progress = 0;  ///< of the actuation, or of the push
  double boundary_radius_mm = unknown;
  double height_mm = 0;        ///< highest joint above the boundary's plane
  double amplitude = unknown;  ///< root mean square of what breaks the symmetry of the path, over
                               ///< the length scale, signed
  double energy_mJ = 0;
  int negative_pivots = 0;
  BranchEvent event = BranchEvent::none;

  bool stable() const { return negative_pivots == 0; }
};

/// The text of branches.csv; unknown numbers are empty.
std::string branches_csv(const std::vector<BranchPoint>& points);

}  // namespace gridshell::record
