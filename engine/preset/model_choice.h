// Which rung of the model ladder a preset needs: no more than its scene asks for.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/consistency.h"
#include "engine/preset/preset.h"

namespace gridshell::preset {

/// The rung that a preset runs on: the one it asks for, else the lowest that is exact; `net` only
/// where a tolerance of 0.05 or more is asked for a cap of a sphere, of which it is known that
/// shells lie within 0.03 of their net.
RodModel rod_model_of(const Preset& preset);

/// One sentence: which rung, what was left out, and why nothing is lost.
std::string model_reason(const Preset& preset);

/// What a rung that is asked for cannot serve, and rods whose stiffness it lacks.
std::vector<KeyFault> model_conflicts(const Preset& preset);

}  // namespace gridshell::preset
