// The keys of the field table that say what rods, joints, ends and loads are.
#pragma once

#include <vector>

#include "engine/preset/field.h"

namespace gridshell::preset {

std::vector<Field> rod_fields();      ///< [rod], [rod_v]
std::vector<Field> joint_fields();    ///< [joints], [ends]
std::vector<Field> load_fields();     ///< [loads], [dynamics]
std::vector<Field> inverse_fields();  ///< [inverse]

}  // namespace gridshell::preset
