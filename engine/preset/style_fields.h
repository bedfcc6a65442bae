// Keys of how pictures look and are printed: [style], [page], and what [movie] and [figure] have
// beside size, camera and quality.
#pragma once

#include <vector>

#include "engine/preset/field.h"

namespace gridshell::preset {

std::vector<Field> style_fields();

}  // namespace gridshell::preset
