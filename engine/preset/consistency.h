// What a preset's keys must be to each other; each key on its own is held to its range by the
// reader.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Two keys that do not go together. The fault is shown where `key` was set.
struct Conflict {
  std::string table, key;
  std::vector<std::string> others;  ///< the other keys, "[table] key"
  std::string what;                 ///< what is wrong, what is allowed
  int item = -1;                    ///< of a list of tables, from 0
};

/// Empty when the preset makes sense as a whole (whether its footprint can be built is not known
/// here).
std::vector<Conflict> conflicts(const Preset& preset);

// What the keys of shapes must be to each other: points where a shape is made of points, blocks and
// joins that know one another.

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

// Which keys of a preset count for nothing, because of the kind that another key chooses.

/// A key that nothing reads in this preset.
struct UnusedKey {
  std::string table, key;
  int item = -1;                      ///< of a list of tables, from 0
  std::vector<std::string> deciders;  ///< the keys that make it so, "[net] kind"
  std::string why;                    ///< "only a spool or beltrami net has one"
};

/// Every key that this preset's kinds do not use. The reader refuses those that are set to
/// something, the writer leaves them out.
std::vector<UnusedKey> unused_keys(const Preset& preset);

}  // namespace gridshell::preset
