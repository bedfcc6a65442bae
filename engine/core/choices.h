// Choices that presets name and the engine makes: one enum each, its words beside it.
#pragma once

#include "engine/core/enum_words.h"

namespace gridshell {

/// How much of a rod is modelled, the rungs of a ladder. `net`: the smooth net, geometry alone.
/// `bend`: stretch and bend of rods whose spin stores no energy, three unknowns a node. `twist`:
/// torsion too, full discrete elastic rods, one angle an edge more and frames carried in time
/// [Bergou 2008, 2010]. `automatic`: the lowest that is exact.
enum class RodModel { automatic, net, bend, twist };
constexpr auto words(RodModel) { return names_except<RodModel>({{RodModel::automatic, "auto"}}); }

/// Where the grid lines lie: at (i + 1/2) d, or at i d so that one rod of each family is an axis.
enum class Placement { half, on_axis };

/// How a point of the original boundary finds its place on the actuated one.
enum class Correspondence {
  arc_length,  ///< the same fraction of the length, both counted from the positive x-axis
  angle,       ///< the same polar angle about the origin
};

/// On which side of an unstable state to leave it: where the energy ends lower, along a mode, or
/// against it.
enum class BranchSide { lower, along, against };

}  // namespace gridshell
