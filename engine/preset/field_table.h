// Every key of a preset as data: its table, its member, the allowed values, its meaning and its
// dependence on other keys. The reader, `--set`, the writer, the reference and the window use this
// table; the type of the member decides how it is read and written.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Allowed range of a number; infinite bounds are no bounds.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< low itself is not allowed

  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && value <= high;
  }
};

// products of values in the energies must stay within the range of double
inline constexpr double least_magnitude = 1e-9, largest_magnitude = 1e9;

/// The error of a number that is too large or too small to compute with; empty: none.
std::string magnitude_error(double value);

inline Range above(double low) { return {.low = low, .low_open = true}; }
inline Range at_least(double low) { return {.low = low}; }
inline Range between(double low, double high) { return {.low = low, .high = high}; }

/// Access to a member whose type is an enum (OneWord) or a list of enumerators (SomeWords), as
/// indices into Field::words.
template <class Indices>
struct WordMember {
  void* member;
  Indices (*get)(const void* member);
  void (*set)(void* member, const Indices& indices);
};
using OneWord = WordMember<int>;
using SomeWords = WordMember<std::vector<int>>;

/// The member of a preset that a key fills.
using Member =
    std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
                 std::array<int, 2>*, std::vector<int>*, std::vector<double>*,
                 std::vector<std::string>*, std::vector<SweepAxis>*, Points*, SurfaceData*,
                 NetworkData*, OneWord, SomeWords>;

/// How the values of other keys affect a key.
enum class RuleKind {
  unused,             ///< it has no effect
  refused,            ///< its value contradicts theirs
  needs_twist,        ///< its value excludes the rod models `bend` and `net`
  needs_equilibrium,  ///< its value excludes the rod model `net`, which solves nothing
};
struct Rule {
  RuleKind kind;
  std::vector<std::string> others;  ///< keys that decide: "[net] kind", or "kind" of its own table
  /// Returns the error, or an empty text if there is none; `item` is the index in a list of tables.
  std::function<std::string(const Preset& preset, int item)> fault;
};

/// One key of a preset.
struct Field {
  std::string table;  ///< empty at the top of the file
  std::string key;
  std::string unit;     ///< empty: a pure number or not a number
  std::string meaning;  ///< one sentence without a full stop
  /// Returns the member; in a list of tables that of item `item`, below 0 that of the last item.
  std::function<Member(Preset& preset, int item)> in;
  Range range = {};        ///< allowed range, if it is a number or a list of numbers
  std::string label = {};  ///< label of its control; empty: the key without its unit
  std::string shape = {};  ///< required entries of a list: "[x, y, z]"; empty: any number
  bool colour = false;     ///< whether a text is a colour
  std::vector<std::string> words = {};        ///< allowed names, if it is an enum
  std::vector<std::string> coordinates = {};  ///< names of the columns, if it is a table of points
  /// Allowed names of each column; empty: the column has numbers.
  std::vector<std::vector<std::string>> coordinate_words = {};
  std::vector<Rule> rules = {};

  /// The member if it is of type T, else null.
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
  /// Allowed names of one column of points; empty: it has numbers.
  std::vector<std::string> words_of(std::size_t coordinate) const {
    return coordinate < coordinate_words.size() ? coordinate_words[coordinate]
                                                : std::vector<std::string>();
  }
};

/// Label of a key in messages: "[footprint] radius_mm", "[[step]] 1 joint" (item 0), "title" at the
/// top.
std::string key_label(const std::string& table, const std::string& key, int item = -1);
/// key_label() of a field.
std::string name_of(const Field& field);
/// The unit that the ending of a key names: "N/mm" of "field_N_per_mm"; empty: none.
std::string unit_of(const std::string& key);
/// The key without the ending that names this unit: "field" of "field_N_per_mm" and "N/mm".
std::string without_unit(const std::string& key, std::string_view unit);
/// Label of a key of Rule::others: `key` itself if it names its table ("[net] kind"), else
/// key_label().
std::string full_label(const std::string& table, const std::string& key, int item = -1);

/// Allowed values of a key: "a number > 0", "an integer from 2 to 100000", "\"up\" or \"down\"".
std::string allowed(const Field& field);
/// The names in quotes: "\"up\", \"down\" or \"flat\"".
std::string words_text(const std::vector<std::string>& words);

/// Value of a key in `preset` as TOML; `item` as in key_label().
std::string value_text(const Field& field, const Preset& preset, int item = -1);

/// A table of the file, in the order of the reference.
struct Table {
  std::string name;  ///< empty for the keys at the top
  std::string meaning;
  bool list = false;  ///< whether the table is a list of items: [[block]]
};

/// All tables, in the order of the reference.
const std::vector<Table>& tables();

/// All keys; those of a table are in the order of the reference. Defaults are those of a
/// default-constructed Preset.
const std::vector<Field>& field_table();
/// The keys of a table, in the order of the reference.
std::vector<std::string> keys_of(const std::string& table);

/// The key `key` of `table`, or null.
const Field* find_field(const std::string& table, const std::string& key);

}  // namespace gridshell::preset
