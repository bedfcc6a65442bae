// What the keys of shapes must be to each other: points where a shape is made of points, blocks and
// joins that know one another.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/preset/consistency.h"

namespace gridshell::preset {

/// Curves and nets without the points they need.
std::vector<Conflict> shape_conflicts(const Preset& preset);

/// Blocks without a name of their own, joins of sides that do not exist, no blocks at all.
std::vector<Conflict> block_conflicts(const Preset& preset);

/// Second rings and designs of what has no net, or whose ends are held otherwise.
std::vector<Conflict> end_conflicts(const Preset& preset);

/// A side of a block as a join names it.
struct NamedSide {
  int block = 0;     ///< index in Preset::block
  std::string side;  ///< "east", "west", "north" or "south"
};

/// "left.east"; empty when no block or side has that name.
std::optional<NamedSide> side_named(const Preset& preset, const std::string& name);

}  // namespace gridshell::preset
