// The keys that give shapes: boundaries, nets and building blocks.
#pragma once

#include <vector>

#include "engine/preset/field.h"

namespace gridshell::preset {

/// Of [footprint] and [actuation]: boundaries that a user gives.
std::vector<Field> boundary_fields();

/// Of [net], [blocks], [[block]] and [[join]].
std::vector<Field> net_fields();

}  // namespace gridshell::preset
