// Guesses the unit and the upward axis of a mesh whose file does not give them.
#pragma once

#include <string>
#include <vector>

#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// If the unit of a mesh is not known, multiplies it by the first of 1, 10 (cm, or a file in metres
/// at 1 : 100) and 1000 (m) that makes it at least four spacings of the rods wide. If y is up, that
/// is, if its area seen along y is more than 1.5 times that seen along z, turns it about x so that
/// z is up. Returns a sentence for each change.
std::vector<std::string> make_likely(SurfaceData& mesh, double spacing_mm, bool unit_known);

}  // namespace gridshell::preset
