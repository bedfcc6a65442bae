// How the values of keys are written, read and described: one overload for each type of member.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <type_traits>

#include "engine/core/file_io.h"
#include "engine/core/suggest.h"
#include "engine/formats/network_file.h"
#include "engine/formats/point_file.h"
#include "engine/formats/surface_file.h"
#include "engine/preset/preset_access.h"
#include "engine/preset/toml_reader.h"

namespace gridshell::preset {
namespace {

// Surfaces and networks as tables of a preset: visit(key, member, whether it must be there).

template <class Data, class Visit>
void each_part(Data& data, bool mesh,
               const Visit& visit) requires std::is_same_v<std::remove_const_t<Data>, SurfaceData> {
  if (mesh) {
    visit("vertices_mm", data.vertices, true);
    visit("triangles", data.triangles, true);
  } else {
    visit("x_mm", data.x, true);
    visit("y_mm", data.y, true);
    visit("z_mm", data.z, true);
  }
}

template <class Data, class Visit>
void each_part(Data& data, bool,
               const Visit& visit) requires std::is_same_v<std::remove_const_t<Data>, NetworkData> {
  visit("points_mm", data.points, true);
  visit("rods", data.rods, true);
  visit("diameters_mm", data.diameters, false);
  visit("supports_mm", data.supports, false);
  visit("springs_N_per_mm", data.springs, false);
  visit("free", data.free, false);
}

// Writing.

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
std::string text_of(const std::optional<int>& value) {
  return value ? text_of(*value) : "\"none\"";
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

/// The text of a member.
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
    for (const int place : words.get(words.member))
      texts.push_back(field.words.at(std::size_t(place)));
    return text_of(texts);
  }
};

// Describing.

std::string bounds_text(const Range& range) {
  const bool below = std::isfinite(range.low), above = std::isfinite(range.high);
  if (below && above && !range.low_open)
    return fmt::format(" from {} to {}", range.low, range.high);
  std::string text;
  if (below) text += fmt::format(" {} {}", range.low_open ? ">" : ">=", range.low);
  if (above) text += fmt::format("{} <= {}", below ? " and" : "", range.high);
  return text;
}

/// What a member may hold.
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
           "springs_N_per_mm, free}, or \"\"";
  }
};

// Reading.

// a finite number, written as an integer or a float
std::optional<double> real_of(const toml::node& value) {
  if (const auto* real = value.as_floating_point(); real && std::isfinite(real->get()))
    return real->get();
  if (const auto* integer = value.as_integer()) return double(integer->get());
  return std::nullopt;
}

// products of values as they stand in the energies must stay within the range of double
constexpr double least_magnitude = 1e-9, largest_magnitude = 1e9;

// why a number cannot be computed with, or empty
std::string magnitude_fault(double value) {
  const double size = std::abs(value);
  if (size == 0 || (size >= least_magnitude && size <= largest_magnitude)) return "";
  return std::string(size > 1 ? "too large" : "too small") +
         " to compute with (0, or a magnitude of 1e-9 to 1e9)";
}

// of coordinates only the size counts: what should be zero is often a little beside it
std::string points_fault(const Points& points) {
  constexpr std::size_t most_places = 100000;
  if (points.size() > most_places)
    return fmt::format("holds {} points, must be at most {}", points.size(), most_places);
  for (const auto& point : points)
    for (const double value : point)
      if (!(std::abs(value) <= largest_magnitude))
        return "holds a number too large to compute with (at most 1e9)";
  return "";
}

// the place of a word among those allowed
std::optional<double> place_of(const toml::node& value, const std::vector<std::string>& words) {
  const auto* text = value.as_string();
  if (!text) return std::nullopt;
  const auto found = std::ranges::find(words, text->get());
  if (found == words.end()) return std::nullopt;
  return double(found - words.begin());
}

std::string type_text(const toml::node& value) {
  if (value.is_floating_point()) return real_of(value) ? "a number" : "not finite";
  if (value.is_integer()) return "an integer";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return "a boolean";
  if (value.is_array()) return "a list";
  if (value.is_table()) return "a table";
  return "a date or time";
}

// a part of a surface or network: of coordinates only the size counts, the rest counts things
std::string read_part(const toml::node& value, double& number) {
  const auto real = real_of(value);
  number = real.value_or(0);
  return real && std::abs(*real) <= largest_magnitude ? "" : "must hold numbers of at most 1e9";
}
std::string read_part(const toml::node& value, int& number) {
  const auto whole = value.is_integer() ? value.as_integer()->get() : -1;
  number = int(whole);
  return whole >= 0 && whole <= 1000000000 ? "" : "must hold whole numbers from 0 to 1e9";
}
template <class List>
std::string read_part(const toml::node& value, List& list) {
  const auto* items = value.as_array();
  if (!items) return "must hold lists";
  if constexpr (requires { list.emplace_back(); })
    list.resize(items->size());
  else if (items->size() != list.size())
    return fmt::format("must hold lists of {}", list.size());
  for (std::size_t k = 0; k < items->size(); ++k)
    if (auto wrong = read_part((*items)[k], list[k]); !wrong.empty()) return wrong;
  return "";
}

template <class Data>
std::string read_parts(const toml::table& table, Data& data) {
  std::string wrong;
  each_part(data, table.contains("triangles"), [&](const char* key, auto& part, bool needed) {
    if (!wrong.empty() || (!needed && !table.contains(key))) return;
    const auto* value = table.get(key);
    const bool list = value && value->is_array();
    wrong = list ? read_part(*value, part) : fmt::format("has no list {}", key);
    if (list && !wrong.empty()) wrong = fmt::format("{} {}", key, wrong);
  });
  return wrong;
}

/// Puts a value into a member, or says what is wrong.
class Reader {
 public:
  Reader(const Field& field, const toml::node& value, const FileContext& beside)
      : field_(field), value_(value), beside_(beside) {}

  /// Whatever its type, a member is changed only where nothing is wrong.
  template <class T>
  std::string operator()(T* member) {
    T fresh{};
    auto wrong = read(value_, fresh);
    if (wrong.empty()) *member = std::move(fresh);
    return wrong;
  }
  std::string operator()(const OneWord& word) {
    const auto place = place_of(value_, field_.words);
    if (!place) return value_.is_string() ? "unknown word" : "is " + type_text(value_);
    word.set(word.member, int(*place));
    return "";
  }
  std::string operator()(const SomeWords& words) {
    const auto* list = value_.as_array();
    if (!list) return "is " + type_text(value_);
    std::vector<int> places;
    for (const auto& item : *list) {
      const auto place = place_of(item, field_.words);
      if (!place) return item.is_string() ? "unknown word" : "is a list with " + type_text(item);
      if (std::ranges::count(places, int(*place)) > 0) return "names a word twice";
      places.push_back(int(*place));
    }
    words.set(words.member, places);
    return "";
  }
  /// Whether what is wrong was said in full, as of a file.
  bool told_in_full() const { return told_in_full_; }

 private:
  std::string read(const toml::node& value, double& number) const {
    const auto real = real_of(value);
    if (!real) return is_ + type_text(value);
    if (!field_.range.holds(*real)) return "out of range";
    number = *real;
    return magnitude_fault(*real);
  }
  std::string read(const toml::node& value, int& number) const {
    const auto* integer = value.as_integer();
    if (!integer) return is_ + type_text(value);
    if (!field_.range.holds(double(integer->get()))) return "out of range";
    number = int(integer->get());
    return "";
  }
  std::string read(const toml::node& value, bool& flag) const {
    if (!value.is_boolean()) return is_ + type_text(value);
    flag = value.as_boolean()->get();
    return "";
  }
  std::string read(const toml::node& value, std::string& text) const {
    if (!value.is_string()) return is_ + type_text(value);
    text = value.as_string()->get();
    const bool hex = text.size() == 7 && text[0] == '#' &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    return field_.colour && !hex && !text.empty() && text != "transparent" ? "is no colour" : "";
  }
  std::string read(const toml::node& value, std::optional<int>& number) const {
    if (const auto* text = value.as_string(); text && text->get() == "none") return "";
    return read(value, number.emplace());
  }
  template <class T>
  std::string read(const toml::node& value, std::vector<T>& list) {
    const auto* items = value.as_array();
    if (!items) return is_ + type_text(value);
    is_ = "is a list with ";
    for (const auto& item : *items)
      if (auto wrong = read(item, list.emplace_back()); !wrong.empty()) return wrong;
    const auto size = std::size_t(1 + std::ranges::count(field_.shape, ','));
    const bool fits = field_.shape.empty() || list.empty() || list.size() == size;
    return fits ? "" : fmt::format("is a list of {}", list.size());
  }
  std::string read(const toml::node& value, std::array<int, 2>& pair) {
    std::vector<int> numbers;
    if (auto wrong = read(value, numbers); !wrong.empty()) return wrong;
    if (numbers.size() != 2) return fmt::format("is a list of {}", numbers.size());
    std::ranges::copy(numbers, pair.begin());
    return "";
  }
  // what is in a table is read where its faults have their places: read_axes()
  std::string read(const toml::node& value, std::vector<SweepAxis>&) {
    return "is " + type_text(value);
  }

  std::string read(const toml::node& value, Points& points) {
    if (const auto* name = value.as_string()) {
      const auto file = beside_.folder / name->get();
      auto found = read_points(file, field_.coordinates, field_.coordinate_words);
      if (found) points = std::move(*found);
      auto wrong = found ? points_fault(points) : found.error().message;
      told_in_full_ = !wrong.empty();
      return found && told_in_full_ ? file.string() + ": " + wrong : wrong;
    }
    const auto* list = value.as_array();
    if (!list) return "is " + type_text(value);
    for (const auto& item : *list) {
      const auto* point = item.as_array();
      if (!point) return "is a list with " + type_text(item);
      if (point->size() != field_.coordinates.size())
        return fmt::format("holds a point of {} coordinates", point->size());
      auto& numbers = points.emplace_back();
      for (const auto& number : *point) {
        const auto words = field_.words_of(numbers.size());
        const auto real = words.empty() ? real_of(number) : place_of(number, words);
        if (!real) return "holds a point with " + type_text(number);
        numbers.push_back(*real);
      }
    }
    return points_fault(points);
  }
  std::string read(const toml::node& value, SurfaceData& surface) {
    if (const auto* name = value.as_string())
      return read_file_of(name->get(), read_surface, largest_mesh_file, surface);
    if (!value.is_table()) return "is " + type_text(value);
    const auto wrong = read_parts(*value.as_table(), surface);
    return wrong.empty() ? surface_fault(surface) : wrong;
  }
  std::string read(const toml::node& value, NetworkData& network) {
    if (const auto* name = value.as_string())
      return read_file_of(name->get(), read_network, largest_network_file, network);
    if (!value.is_table()) return "is " + type_text(value);
    const auto wrong = read_parts(*value.as_table(), network);
    return wrong.empty() ? network_fault(network) : wrong;
  }

  // a surface or network out of a file, or none where the name is empty
  template <class Data>
  std::string read_file_of(const std::string& name,
                           Result<Data> (*read_data)(std::string_view, const std::string&),
                           std::size_t largest, Data& data) {
    if (name.empty()) return "";
    const bool known = beside_.built_in && beside_.built_in->contains(name);
    const auto file = beside_.folder / name;
    auto found = known ? read_data(beside_.built_in->at(name), name)
                       : read_file(file, largest).and_then([&](const std::string& bytes) {
                           return read_data(bytes, file.string());
                         });
    told_in_full_ = !found;
    if (!found) return found.error().message;
    data = std::move(*found);
    return "";
  }

  const Field& field_;
  const toml::node& value_;
  const FileContext& beside_;
  const char* is_ = "is ";  // begins the sentence on what stands there instead
  bool told_in_full_ = false;
};

}  // namespace

std::string words_text(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + fmt::format("\"{}\"", words[k]);
  return text;
}

std::string allowed(const Field& field) {
  Preset any = default_items();  // only the type of its member counts
  return std::visit(Describer{field}, field.in(any, -1));
}

std::string value_text(const Field& field, const Preset& preset, int item) {
  // members are reached for writing too; nothing is written here
  return std::visit(Writer{field}, field.in(const_cast<Preset&>(preset), item));
}

std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const FileContext& beside) {
  Reader reader(field, value, beside);
  const auto wrong = std::visit(reader, field.in(preset, -1));
  if (wrong.empty() || reader.told_in_full()) return wrong;
  std::string text = wrong + ", must be " + allowed(field);
  if (field.as_word(preset) && value.is_string())
    text += did_you_mean(value.as_string()->get(), field.words);
  return text;
}

std::string toml_text(const toml::node& value) {
  std::ostringstream out;
  out << toml::toml_formatter{value, toml::format_flags::none};
  auto text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace gridshell::preset
