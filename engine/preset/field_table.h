// One key of a preset as data: where it stands, what it may hold, what it means, and which member
// of Preset it fills. Everything that speaks of keys (reader, writer, reference) works from these.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// The numbers a key may hold; infinite bounds are no bounds.
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

// The kinds of value a key can have; each reaches its member through `in`.
struct Real {
  double& (*in)(Preset&);
  Range range;
};
struct Integer {
  int& (*in)(Preset&);
  Range range;
};
struct Flag {
  bool& (*in)(Preset&);
};
struct Text {
  std::string& (*in)(Preset&);
};
/// A colour: "#rrggbb", "transparent", or empty for the usual one.
struct ColourText {
  std::string& (*in)(Preset&);
};
/// One word of a few, those of an enum; the index of a word is the enumerator's value.
struct Word {
  int (*get)(const Preset&);
  void (*set)(Preset&, int);
  std::vector<std::string> words;
};
struct IntegerPair {
  std::array<int, 2>& (*in)(Preset&);
  Range range;
};
struct RealList {
  std::vector<double>& (*in)(Preset&);
  Range range;
};

struct IntegerList {
  std::vector<int>& (*in)(Preset&);
  Range range;
};

/// A number, or nothing where the key is "none".
struct OptionalInteger {
  std::optional<int>& (*in)(Preset&);
  Range range;
};
/// Texts of any number.
struct TextList {
  std::vector<std::string>& (*in)(Preset&);
};
/// The keys of a sweep with their values (sweep_axes.h).
struct AxisList {
  std::vector<SweepAxis>& (*in)(Preset&);
};
/// Points of two or three coordinates, in the preset or in a file beside it.
struct PointList {
  Points& (*in)(Preset&);
  std::vector<std::string> coordinates;  ///< their names
  /// of coordinates that are words: which, the number of one being its place; empty: no words
  std::vector<std::vector<std::string>> words = {};

  /// The words of a coordinate; none: it is a number.
  std::vector<std::string> words_of(std::size_t coordinate) const {
    return coordinate < words.size() ? words[coordinate] : std::vector<std::string>();
  }
};

/// A surface: the name of a file that holds it, or what was in the file.
struct SurfaceText {
  SurfaceData& (*in)(Preset&);
};

/// A network of rods: the name of a file that holds it, or what was in the file.
struct NetworkText {
  NetworkData& (*in)(Preset&);
};

/// Several words of a few, those of an enum.
struct WordList {
  std::vector<int> (*get)(const Preset&);
  void (*set)(Preset&, const std::vector<int>&);
  std::vector<std::string> words;
};

/// One key.
struct Field {
  std::string table;  ///< empty at the top of the file
  std::string key;
  std::string unit;  ///< empty: a pure number or not a number
  std::variant<Real, Integer, Flag, Text, ColourText, Word, IntegerPair, RealList, IntegerList,
               OptionalInteger, TextList, AxisList, PointList, SurfaceText, NetworkText, WordList>
      kind;
  std::string meaning;  ///< one sentence without a full stop
};

/// "[footprint] radius_mm", or "title" at the top.
std::string name_of(const Field& field);

/// What it may hold: "a number > 0", "an integer from 2 to 100000", "\"up\" or \"down\"".
std::string allowed(const Field& field);

/// Its value in `preset` as TOML.
std::string value_text(const Field& field, const Preset& preset);

// The field table: every key a preset may hold, once. The reader, `--set`, `--print-config`,
// `check` and the README's reference are made from it; defaults are those of a default-built
// Preset.

/// A table of the file, in the order of the reference.
struct Table {
  std::string name;  ///< empty for the keys at the top
  std::string meaning;
  bool list = false;  ///< stands once an item: [[block]]
};

const std::vector<Table>& tables();

/// All keys, table by table in the order of tables().
const std::vector<Field>& field_table();

/// The key `key` of `table`, or null.
const Field* find_field(const std::string& table, const std::string& key);

}  // namespace gridshell::preset
