// Consistency of a preset's keys with each other; the reader checks the range of each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// A key that other keys put in the wrong.
struct KeyError {
  std::string table, key;
  int item = -1;                    ///< of a list of tables, from 0
  std::vector<std::string> others;  ///< the other keys: "[net] kind"
  std::string what;                 ///< what is wrong, what is allowed

  std::string label() const { return key_label(table, key, item); }
};

/// What the rules of one kind find in this preset; of an unused key the first reason alone.
std::vector<KeyError> key_errors(const Preset& preset, RuleKind kind);

/// Keys that contradict each other. Empty if the preset is consistent (whether its footprint can be
/// built is not known here).
std::vector<KeyError> conflicts(const Preset& preset);

/// Every key that this preset's kinds do not use. The reader refuses those that are set to
/// something, the writer leaves them out.
std::vector<KeyError> unused_keys(const Preset& preset);

/// `[rod]` with the values that a network file gives for one rod. Keys that are not in [rod] or out
/// of range are ignored; own_value_fault() finds them. `reversed`: left and right of the rod are
/// exchanged.
Rod rod_of_network(const Preset& preset, int number, bool reversed = false);

/// A sentence on joints of a network whose rods run so that they close while a step opens the
/// others by the mean of all angles; empty: there are none.
std::string joints_against(const Preset& preset);

/// What is wrong with the first such value, naming its rod; empty: nothing.
std::string own_value_error(const NetworkData& network);

/// A side of a block as a join names it.
struct NamedSide {
  int block = 0;     ///< index in Preset::block
  std::string side;  ///< one of side_names
};
inline constexpr const char* side_names[] = {"east", "west", "north", "south"};

/// "left.east"; empty when no block or side has that name.
std::optional<NamedSide> side_named(const Preset& preset, const std::string& name);

/// Sentences on values that are in range but unlike those of any known shell: a material stiffer
/// than all materials, joints larger than their distance.
std::vector<std::string> doubtful_values(const Preset& preset);

// Choice of the rod model: the simplest one that the preset's scene allows.

/// The rod model of a preset: the requested one, else the simplest that is exact; `net` only for a
/// cap of a sphere with a tolerance of 0.05 or more, since such shells are known to lie within 0.03
/// of their net.
RodModel rod_model_of(const Preset& preset);

/// A sentence: which rod model, what it neglects, and why the result is exact.
std::string model_reason(const Preset& preset);

}  // namespace gridshell::preset
