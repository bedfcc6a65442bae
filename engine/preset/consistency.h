// What a preset's keys are to each other; each on its own is held to its range by the reader.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// A key that other keys put in the wrong.
struct KeyFault {
  std::string table, key;
  int item = -1;                    ///< of a list of tables, from 0
  std::vector<std::string> others;  ///< the other keys: "[net] kind"
  std::string what;                 ///< what is wrong, what is allowed

  std::string label() const { return key_label(table, key, item); }
};

/// What the rules of one kind find in this preset; of an unused key the first reason alone.
std::vector<KeyFault> key_faults(const Preset& preset, RuleKind kind);

/// Keys that do not go together. Empty when the preset makes sense as a whole (whether its
/// footprint can be built is not known here).
std::vector<KeyFault> conflicts(const Preset& preset);

/// Every key that this preset's kinds do not use. The reader refuses those that are set to
/// something, the writer leaves them out.
std::vector<KeyFault> unused_keys(const Preset& preset);

/// `[rod]` as a rod of a network has it: with what the file says of that rod. Keys that are none of
/// [rod] or out of range count for nothing; own_value_fault() finds them. `reversed`: left of it is
/// right of the rod in the file.
Rod rod_of_network(const Preset& preset, int number, bool reversed = false);

/// What is wrong with the first such value, naming its rod; empty: nothing.
std::string own_value_fault(const NetworkData& network);

/// A side of a block as a join names it.
struct NamedSide {
  int block = 0;     ///< index in Preset::block
  std::string side;  ///< one of side_names
};
inline constexpr const char* side_names[] = {"east", "west", "north", "south"};

/// "left.east"; empty when no block or side has that name.
std::optional<NamedSide> side_named(const Preset& preset, const std::string& name);

/// Values that are in their range and of no shell that is known: a material beyond all materials,
/// joints larger than their distance. A sentence each.
std::vector<std::string> doubtful_values(const Preset& preset);

// Which rung of the model ladder a preset needs: no more than its scene asks for.

/// The rung that a preset runs on: the one it asks for, else the lowest that is exact; `net` only
/// where a tolerance of 0.05 or more is asked for a cap of a sphere, of which it is known that
/// shells lie within 0.03 of their net.
RodModel rod_model_of(const Preset& preset);

/// One sentence: which rung, what was left out, and why nothing is lost.
std::string model_reason(const Preset& preset);

}  // namespace gridshell::preset
