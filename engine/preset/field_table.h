// Every key of a preset as data: its table, its member, the allowed values, its meaning and its
// dependence on other keys. The reader, `--set`, the writer, the reference and the window use
// these; the type of the member chooses how it is read and written.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Allowed range of a number; infinite bounds are no bounds.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< low itself is not allowed

  bool holds(double value) const {
    return (low_open ? value > low : value >= low) && value <= high;
  }
};

inline Range above(double low) { return {.low = low, .low_open = true}; }
inline Range at_least(double low) { return {.low = low}; }
inline Range between(double low, double high) { return {.low = low, .high = high}; }

/// A member of an enum as the index of its name, or a list of these.
template <class Places>
struct WordMember {
  void* member;
  Places (*get)(const void* member);
  void (*set)(void* member, const Places& places);
};
using OneWord = WordMember<int>;
using SomeWords = WordMember<std::vector<int>>;

/// The member of a preset that a key fills.
using Member =
    std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
                 std::array<int, 2>*, std::vector<int>*, std::vector<double>*,
                 std::vector<std::string>*, std::vector<SweepAxis>*, Points*, SurfaceData*,
                 NetworkData*, OneWord, SomeWords>;

/// What a key has to do with other keys.
enum class RuleKind {
  unused,             ///< it has no effect
  refused,            ///< its value does not go with theirs
  needs_twist,        ///< the model `bend` is not exact
  needs_equilibrium,  ///< the smooth net itself, the model `net`, is not enough
};
struct Rule {
  RuleKind kind;
  std::vector<std::string> others;  ///< keys that decide: "[net] kind", of its own table "kind"
  /// what is wrong, of an item of a list of tables; empty: nothing
  std::function<std::string(const Preset& preset, int item)> fault;
};

/// One key.
struct Field {
  std::string table;  ///< empty at the top of the file
  std::string key;
  std::string unit;     ///< empty: a pure number or not a number
  std::string meaning;  ///< one sentence without a full stop
  /// the member, of an item of a list of tables or, below 0, of the last
  std::function<Member(Preset& preset, int item)> in;
  Range range = {};        ///< of numbers
  std::string label = {};  ///< what a control of it is called; empty: as the key, without its unit
  std::string shape = {};  ///< of a list: "[x, y, z]"
  bool colour = false;     ///< of a text
  std::vector<std::string> words = {};                          ///< of an enum
  std::vector<std::string> coordinates = {};                    ///< of points: their names
  std::vector<std::vector<std::string>> coordinate_words = {};  ///< of those that are no numbers
  std::vector<Rule> rules = {};

  /// The member where it is of that type, else null.
  template <class T>
  T* as(Preset& preset, int item = -1) const {
    const Member member = in(preset, item);
    const auto* found = std::get_if<T*>(&member);
    return found ? *found : nullptr;
  }
  /// The value of an enum member; empty for other types.
  std::optional<OneWord> as_word(Preset& preset, int item = -1) const {
    const Member member = in(preset, item);
    const auto* found = std::get_if<OneWord>(&member);
    return found ? std::optional(*found) : std::nullopt;
  }
  /// The words of one of its coordinates; none: that is a number.
  std::vector<std::string> words_of(std::size_t coordinate) const {
    return coordinate < coordinate_words.size() ? coordinate_words[coordinate]
                                                : std::vector<std::string>();
  }
};

/// Label of a key in messages: "[footprint] radius_mm", "[[step]] 1 joint" (item 0), "title" at the
/// top.
std::string key_label(const std::string& table, const std::string& key, int item = -1);
std::string name_of(const Field& field);
/// The unit that the end of a key names: "N/mm" of "field_N_per_mm"; empty: none.
std::string unit_of(const std::string& key);
/// Label of a key that may be in another table: "[net] kind".
std::string full_label(const std::string& table, const std::string& key, int item = -1);

/// Allowed values: "a number > 0", "an integer from 2 to 100000", "\"up\" or \"down\"".
std::string allowed(const Field& field);
/// "\"up\", \"down\" or \"flat\"".
std::string words_text(const std::vector<std::string>& words);

/// Its value in `preset` as TOML.
std::string value_text(const Field& field, const Preset& preset, int item = -1);

/// A table of the file, in the order of the reference.
struct Table {
  std::string name;  ///< empty for the keys at the top
  std::string meaning;
  bool list = false;  ///< a table that is a list of items: [[block]]
};

const std::vector<Table>& tables();

/// All keys; those of a table are in the order of the reference. Defaults are those of a
/// default-constructed Preset.
const std::vector<Field>& field_table();
/// The keys of a table, in that order.
std::vector<std::string> keys_of(const std::string& table);

/// The key `key` of `table`, or null.
const Field* find_field(const std::string& table, const std::string& key);

}  // namespace gridshell::preset
