// Choices that presets name and the engine implements: one enum each, followed by its names.
#pragma once

#include "engine/core/enum_words.h"

namespace gridshell {

/// Rod model: how much of a rod is modelled. `net`: the smooth net, geometry alone. `bend`: stretch
/// and bending of rods whose twist stores no energy, three unknowns per node. `twist`: torsion in
/// addition, full discrete elastic rods, one angle more per edge and frames transported in time
/// [Bergou 2008, 2010]. `automatic`: the simplest model that is exact.
enum class RodModel { automatic, net, bend, twist };
constexpr auto words(RodModel) { return names_except<RodModel>({{RodModel::automatic, "auto"}}); }

/// Positions of the grid lines: at (i + 1/2) d, or at i d so that one rod of each family is an
/// axis.
enum class Placement { half, on_axis };

/// How points of the original boundary correspond to points of the actuated one.
enum class Correspondence {
  arc_length,  ///< the same fraction of the length, both counted from the positive x-axis
  angle,       ///< the same polar angle about the origin
};

/// The side of an unstable state on which a descent starts: that with the lower final energy, along
/// a mode, or against it.
enum class BranchSide { lower, along, against };

}  // namespace gridshell
