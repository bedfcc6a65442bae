// What a mesh of a surface is likely meant as, where its file does not say.
#pragma once

#include <string>
#include <vector>

#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// Multiplies a mesh by the first of 1, 10 (cm, or a file in metres at 1 : 100) and 1000 (m) that
/// makes it four of the rods' spacings wide or more, where its unit is not known, and turns it
/// about x where it faces y by half more than z, y being up. Returns a sentence for each.
std::vector<std::string> make_likely(SurfaceData& mesh, double spacing_mm, bool unit_known);

}  // namespace gridshell::preset
