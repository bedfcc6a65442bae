// Writes the values of keys as TOML and describes the allowed ones: one overload per type of
// member.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "engine/preset/preset.h"
#include "engine/preset/toml_reader.h"

namespace gridshell::preset {
namespace {

std::string text_of(const std::string& text) {
  std::ostringstream out;
  const toml::value<std::string> value(text);
  out << toml::toml_formatter{value, toml::format_flags::none};
  return out.str();
}

// shortest text that reads back as the same double, always a TOML float
std::string text_of(double value) {
  auto text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string text_of(int value) { return std::to_string(value); }
std::string text_of(const bool& value) { return value ? "true" : "false"; }
template <class Number>
std::string text_of(const std::optional<Number>& value) {
  return value ? text_of(*value) : "\"none\"";
}

std::string text_of(const RodValue& of) {
  return fmt::format("[{}, {}, {}]", of.rod, text_of(of.key), text_of(of.value));
}

template <class List>
requires requires(const List& list) { list.begin(), list.size(); }
std::string text_of(const List& list) {
  std::vector<std::string> items;
  for (const auto& item : list) items.push_back(text_of(item));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string text_of(const std::vector<SweepAxis>& axes) {
  std::vector<std::string> items;
  for (const auto& axis : axes)
    items.push_back(fmt::format("{} = [{}]", axis.key, fmt::join(axis.values, ", ")));
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

template <class Data>
std::string table_text(const Data& data, bool mesh) {
  if (data.empty()) return "\"\"";
  std::vector<std::string> items;
  each_part(data, mesh, [&](const char* key, const auto& part, bool needed) {
    if (needed || !part.empty()) items.push_back(fmt::format("{} = {}", key, text_of(part)));
  });
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}
std::string text_of(const SurfaceData& surface) { return table_text(surface, surface.is_mesh()); }
std::string text_of(const NetworkData& network) { return table_text(network, false); }

std::string points_text(const Field& field, const Points& points) {
  std::vector<std::string> items;
  for (const auto& point : points) {
    std::vector<std::string> numbers;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const auto words = field.words_of(k);
      numbers.push_back(words.empty() ? text_of(point[k])
                                      : text_of(words.at(std::size_t(point[k]))));
    }
    items.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
  }
  return fmt::format("[{}]", fmt::join(items, ", "));
}

/// Writes a member as TOML.
struct Writer {
  const Field& field;

  template <class T>
  std::string operator()(const T* member) const {
    return text_of(*member);
  }
  std::string operator()(const Points* points) const { return points_text(field, *points); }
  std::string operator()(const OneWord& word) const {
    return text_of(field.words.at(std::size_t(word.get(word.member))));
  }
  std::string operator()(const SomeWords& words) const {
    std::vector<std::string> texts;
    for (const int location : words.get(words.member))
      texts.push_back(field.words.at(std::size_t(location)));
    return text_of(texts);
  }
};

std::string bounds_text(const Range& range) {
  const bool below = std::isfinite(range.low), above = std::isfinite(range.high);
  if (below && above && !range.low_open)
    return fmt::format(" from {} to {}", range.low, range.high);
  std::string text;
  if (below) text += fmt::format(" {} {}", range.low_open ? ">" : ">=", range.low);
  if (above) text += fmt::format("{} <= {}", below ? " and" : "", range.high);
  return text;
}

/// Describes the allowed values of a member.
struct Describer {
  const Field& field;
  std::string bounds = bounds_text(field.range);

  std::string operator()(const double*) const { return "a number" + bounds; }
  std::string operator()(const int*) const { return "an integer" + bounds; }
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const std::string*) const {
    return field.colour ? "a colour \"#rrggbb\", \"transparent\" or \"\"" : "a string";
  }
  std::string operator()(const OneWord&) const { return words_text(field.words); }
  std::string operator()(const SomeWords&) const { return "a list of " + words_text(field.words); }
  std::string operator()(const std::array<int, 2>*) const { return "two integers, each" + bounds; }
  std::string operator()(const std::vector<int>*) const {
    return field.shape.empty() ? "a list of integers" + bounds
                               : field.shape + ", integers" + bounds + ", or empty";
  }
  std::string operator()(const std::vector<double>*) const {
    if (!field.shape.empty()) return field.shape + " or empty";
    return "a list of numbers" + (bounds.empty() ? bounds : ", each" + bounds);
  }
  std::string operator()(const std::optional<int>*) const {
    return "an integer" + bounds + ", or \"none\"";
  }
  std::string operator()(const std::optional<double>*) const {
    return "a number" + bounds + ", or \"none\"";
  }
  std::string operator()(const std::vector<std::string>*) const { return "a list of strings"; }
  std::string operator()(const std::vector<SweepAxis>*) const {
    return "a table of keys in dotted form, each a list of values or { from, to, count }";
  }
  std::string operator()(const Points*) const {
    return fmt::format("a list of points [{}], or the name of a file with one a line",
                       fmt::join(field.coordinates, ", "));
  }
  std::string operator()(const SurfaceData*) const {
    return "the name of a file, a table {x_mm, y_mm, z_mm} of a grid or {vertices_mm, triangles}, "
           "or \"\"";
  }
  std::string operator()(const NetworkData*) const {
    return "the name of a file, a table {points_mm, rods, diameters_mm, supports_mm, "
           "springs_N_per_mm, own, free, joint_laws, holds}, or \"\"";
  }
};

}  // namespace

std::string words_text(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + fmt::format("\"{}\"", words[k]);
  return text;
}

std::string allowed(const Field& field) {
  Preset any = default_items();  // only the type of the member matters
  return std::visit(Describer{field}, field.in(any, -1));
}

std::string value_text(const Field& field, const Preset& preset, int item) {
  // Field::in takes a preset that can be written to; nothing is written
  return std::visit(Writer{field}, field.in(const_cast<Preset&>(preset), item));
}

}  // namespace gridshell::preset
