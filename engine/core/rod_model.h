// How much of a rod is modelled: the rungs of a ladder, of which a preset names one or leaves the
// choice to the program.
#pragma once

#include "engine/core/enum_words.h"

namespace gridshell {

/// `net`: the smooth net, geometry alone. `bend`: stretch and bend of rods whose spin stores no
/// energy, three unknowns a node. `twist`: torsion too, full discrete elastic rods, one angle an
/// edge more and frames carried in time [Bergou 2008, 2010]. `automatic`: the lowest that is exact.
enum class RodModel { automatic, net, bend, twist };
constexpr auto words(RodModel) { return names_except<RodModel>({{RodModel::automatic, "auto"}}); }

}  // namespace gridshell
