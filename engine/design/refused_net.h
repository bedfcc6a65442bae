// What there is of the net of a preset that is refused.
#pragma once

#include <optional>

#include "engine/geometry/surface_net.h"
#include "engine/preset/preset.h"

namespace gridshell {

/// Where the net of a preset, on any surface, ends before its boundary. Nothing: it does not, or
/// something else is wrong.
std::optional<NetSoFar> refused_net(const preset::Preset& preset);

}  // namespace gridshell
