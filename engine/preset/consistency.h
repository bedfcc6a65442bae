// Consistency of a preset's keys with each other; the reader checks the range of each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// A key whose value contradicts other keys, or has no effect because of them.
struct KeyError {
  std::string table, key;
  int item = -1;                    ///< index in a list of tables; -1: no list
  std::vector<std::string> others;  ///< the other keys: "[net] kind"
  std::string what;                 ///< the error and the allowed values

  std::string label() const { return key_label(table, key, item); }
};

/// Keys for which a rule of this kind applies; an unused key is listed once, with its first reason.
std::vector<KeyError> key_errors(const Preset& preset, RuleKind kind);

/// Keys that contradict each other. Empty if the preset is consistent; whether its footprint can be
/// built is not checked.
std::vector<KeyError> conflicts(const Preset& preset);

/// Keys that have no effect in this preset, because of the kinds that it chooses. The reader
/// refuses those that are set to another value than their default, the writer leaves them out.
std::vector<KeyError> unused_keys(const Preset& preset);

/// `[rod]` with the values that a network file gives for rod `number`. Keys that are not in [rod]
/// or out of range are ignored; own_value_error() finds them. `reversed`: the rod runs in the
/// opposite direction, so its sideways curvature changes sign.
Rod rod_of_network(const Preset& preset, int number, bool reversed = false);

/// A sentence on joints that a step "open" with a mean angle would close, because one of their rods
/// runs in the wrong direction; empty: there are none.
std::string joints_against(const Preset& preset);

/// The error of the first value of a single rod in a network file, with its rod; empty: none.
std::string own_value_error(const NetworkData& network);

/// A side of a block as a join names it.
struct NamedSide {
  int block = 0;     ///< index in Preset::block
  std::string side;  ///< one of side_names
};
inline constexpr const char* side_names[] = {"east", "west", "north", "south"};

/// The side that a name like "left.east" means; empty if no block or side has that name.
std::optional<NamedSide> side_named(const Preset& preset, const std::string& name);

/// Sentences on values that are in range but unlike those of any known shell: a material stiffer
/// than all materials, joints larger than their distance.
std::vector<std::string> doubtful_values(const Preset& preset);

// Choice of the rod model: the simplest one that the preset's scene allows.

/// The rod model of a preset: the requested one, else the simplest that is exact; `net` only for a
/// cap of a sphere with a tolerance of 0.05 or more, since such shells are known to be within 0.03
/// of their net.
RodModel rod_model_of(const Preset& preset);

/// A sentence: which rod model, what it neglects, and why the result is exact.
std::string model_reason(const Preset& preset);

}  // namespace gridshell::preset
