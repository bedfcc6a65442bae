// The keys of the field table that say how the states of a shell are looked for.
#pragma once

#include <vector>

#include "engine/preset/field.h"

namespace gridshell::preset {

std::vector<Field> jitter_fields();  ///< [jitter]

}  // namespace gridshell::preset
