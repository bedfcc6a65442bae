#include "engine/preset/toml_reader.h"

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

namespace gridshell::preset {
namespace {

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

constexpr std::size_t most_places = 100000;

// of coordinates only the size counts: what should be zero is often a little beside it
std::string points_fault(const Points& points) {
  if (points.size() > most_places)
    return "holds " + std::to_string(points.size()) + " points, must be at most " +
           std::to_string(most_places);
  for (const auto& point : points)
    for (const double value : point)
      if (!(std::abs(value) <= largest_magnitude))
        return "holds a number too large to compute with (at most 1e9)";
  return "";
}

bool is_finite_number(const toml::node& value) { return real_of(value).has_value(); }

// the place of a word among those allowed
std::optional<double> place_of(const toml::node& value, const std::vector<std::string>& words) {
  const auto* text = value.as_string();
  if (!text) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) return std::nullopt;
  return double(found - words.begin());
}

std::string type_text(const toml::node& value) {
  if (value.is_floating_point()) return is_finite_number(value) ? "a number" : "not finite";
  if (value.is_integer()) return "an integer";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return "a boolean";
  if (value.is_array()) return "a list";
  if (value.is_table()) return "a table";
  return "a date or time";
}

// a number of the range, or what is wrong; `is` begins the sentence on what stands there instead
std::string read(const toml::node& value, const Range& range, const char* is, double& number) {
  const auto real = real_of(value);
  if (!real) return is + type_text(value);
  if (!range.holds(*real)) return "out of range";
  number = *real;
  return magnitude_fault(*real);
}

std::string read(const toml::node& value, const Range& range, const char* is, int& number) {
  const auto* integer = value.as_integer();
  if (!integer) return is + type_text(value);
  if (!range.holds(double(integer->get()))) return "out of range";
  number = int(integer->get());
  return "";
}

template <class Number>
std::string read(const toml::node& value, const Range& range, const char* is,
                 std::vector<Number>& numbers) {
  const auto* list = value.as_array();
  if (!list) return is + type_text(value);
  for (const auto& item : *list)
    if (auto wrong = read(item, range, "is a list with ", numbers.emplace_back()); !wrong.empty())
      return wrong;
  return "";
}

template <class Number, class Kind>
std::string put_numbers(const Kind& kind, const toml::node& value, Preset& preset) {
  Number number{};
  auto wrong = read(value, kind.range, "is ", number);
  if (wrong.empty()) kind.in(preset) = std::move(number);
  return wrong;
}

std::string put(const Real& kind, const toml::node& value, Preset& preset) {
  return put_numbers<double>(kind, value, preset);
}

std::string put(const Integer& kind, const toml::node& value, Preset& preset) {
  return put_numbers<int>(kind, value, preset);
}

std::string put(const IntegerList& kind, const toml::node& value, Preset& preset) {
  return put_numbers<std::vector<int>>(kind, value, preset);
}

std::string put(const RealList& kind, const toml::node& value, Preset& preset) {
  return put_numbers<std::vector<double>>(kind, value, preset);
}

std::string put(const Flag& kind, const toml::node& value, Preset& preset) {
  const auto* flag = value.as_boolean();
  if (!flag) return "is " + type_text(value);
  kind.in(preset) = flag->get();
  return "";
}

std::string put(const Text& kind, const toml::node& value, Preset& preset) {
  const auto* text = value.as_string();
  if (!text) return "is " + type_text(value);
  kind.in(preset) = text->get();
  return "";
}

std::string put(const ColourText& kind, const toml::node& value, Preset& preset) {
  const auto* text = value.as_string();
  if (!text) return "is " + type_text(value);
  const std::string& colour = text->get();
  const bool hex = colour.size() == 7 && colour[0] == '#' &&
                   colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!hex && !colour.empty() && colour != "transparent") return "is no colour";
  kind.in(preset) = colour;
  return "";
}

std::string put(const Word& kind, const toml::node& value, Preset& preset) {
  const auto* text = value.as_string();
  if (!text) return "is " + type_text(value);
  const auto found = std::find(kind.words.begin(), kind.words.end(), text->get());
  if (found == kind.words.end()) return "unknown word";
  kind.set(preset, int(found - kind.words.begin()));
  return "";
}

std::string put(const IntegerPair& kind, const toml::node& value, Preset& preset) {
  std::vector<int> numbers;
  if (auto wrong = read(value, kind.range, "is ", numbers); !wrong.empty()) return wrong;
  if (numbers.size() != 2) return "is a list of " + std::to_string(numbers.size());
  kind.in(preset) = {numbers[0], numbers[1]};
  return "";
}

std::string put(const OptionalInteger& kind, const toml::node& value, Preset& preset) {
  if (const auto* text = value.as_string(); !text || text->get() != "none")
    return put_numbers<int>(kind, value, preset);
  kind.in(preset).reset();
  return "";
}

std::string put(const TextList& kind, const toml::node& value, Preset& preset) {
  const auto* list = value.as_array();
  if (!list) return "is " + type_text(value);
  std::vector<std::string> texts;
  for (const auto& item : *list) {
    const auto* text = item.as_string();
    if (!text) return "is a list with " + type_text(item);
    texts.push_back(text->get());
  }
  kind.in(preset) = std::move(texts);
  return "";
}

// what is in a table is read where its faults have their places: read_axes()
std::string put(const AxisList&, const toml::node& value, Preset&) {
  return "is " + type_text(value);
}

std::string put(const WordList& kind, const toml::node& value, Preset& preset) {
  const auto* list = value.as_array();
  if (!list) return "is " + type_text(value);
  std::vector<int> indices;
  for (const auto& item : *list) {
    const auto place = place_of(item, kind.words);
    if (!place) return item.is_string() ? "unknown word" : "is a list with " + type_text(item);
    if (std::find(indices.begin(), indices.end(), int(*place)) != indices.end())
      return "names a word twice";
    indices.push_back(int(*place));
  }
  kind.set(preset, indices);
  return "";
}

std::string put(const PointList& kind, const toml::node& value, Preset& preset) {
  const auto* list = value.as_array();
  if (!list) return "is " + type_text(value);
  Points points;
  for (const auto& item : *list) {
    const auto* point = item.as_array();
    if (!point) return "is a list with " + type_text(item);
    if (point->size() != kind.coordinates.size())
      return "holds a point of " + std::to_string(point->size()) + " coordinates";
    points.emplace_back();
    for (const auto& number : *point) {
      const auto words = kind.words_of(points.back().size());
      const auto real = words.empty() ? real_of(number) : place_of(number, words);
      if (!real) return "holds a point with " + type_text(number);
      points.back().push_back(*real);
    }
  }
  if (auto wrong = points_fault(points); !wrong.empty()) return wrong;
  kind.in(preset) = std::move(points);
  return "";
}

// coordinates: of these only the size counts
std::string read_coordinates(const toml::node* value, const char* key,
                             std::vector<double>& numbers) {
  const auto* list = value ? value->as_array() : nullptr;
  if (!list) return std::string("has no list ") + key;
  for (const auto& item : *list) {
    const auto real = real_of(item);
    if (!real || !(std::abs(*real) <= largest_magnitude))
      return std::string(key) + " holds what is no number of at most 1e9";
    numbers.push_back(*real);
  }
  return "";
}

std::string read_coordinates(const toml::node* value, const char* key, Points& rows) {
  const auto* list = value ? value->as_array() : nullptr;
  if (!list) return std::string("has no list ") + key;
  for (const auto& item : *list)
    if (auto wrong = read_coordinates(&item, key, rows.emplace_back()); !wrong.empty())
      return wrong;
  return "";
}

std::string read_triangles(const toml::node* value, std::vector<std::array<int, 3>>& triangles) {
  const auto* list = value ? value->as_array() : nullptr;
  if (!list) return "has no list triangles";
  for (const auto& item : *list) {
    std::vector<int> corners;
    if (auto wrong = read(item, between(0, 1e9), "triangles hold ", corners); !wrong.empty())
      return wrong;
    if (corners.size() != 3) return "triangles must be three numbers each";
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return "";
}

std::string put(const SurfaceText& kind, const toml::node& value, Preset& preset) {
  const auto* table = value.as_table();
  if (!table) return "is " + type_text(value);
  SurfaceData surface;
  std::string wrong;
  if (table->contains("triangles")) {
    wrong = read_coordinates(table->get("vertices_mm"), "vertices_mm", surface.vertices);
    if (wrong.empty()) wrong = read_triangles(table->get("triangles"), surface.triangles);
  } else {
    wrong = read_coordinates(table->get("x_mm"), "x_mm", surface.x);
    if (wrong.empty()) wrong = read_coordinates(table->get("y_mm"), "y_mm", surface.y);
    if (wrong.empty()) wrong = read_coordinates(table->get("z_mm"), "z_mm", surface.z);
  }
  if (wrong.empty()) wrong = surface_fault(surface);
  if (wrong.empty()) kind.in(preset) = std::move(surface);
  return wrong;
}

// a list that may be left out
template <class Values>
std::string read_if_there(const toml::table& table, const char* key, Values& values) {
  if (!table.contains(key)) return "";
  if constexpr (std::is_same_v<Values, std::vector<int>>) {
    const auto wrong = read(*table.get(key), between(0, 1e9), "is ", values);
    return wrong.empty() ? "" : std::string(key) + " " + wrong;
  } else {
    return read_coordinates(table.get(key), key, values);
  }
}

std::string put(const NetworkText& kind, const toml::node& value, Preset& preset) {
  const auto* table = value.as_table();
  if (!table) return "is " + type_text(value);
  NetworkData network;
  std::string wrong = read_coordinates(table->get("points_mm"), "points_mm", network.points);
  const auto* rods = table->get_as<toml::array>("rods");
  if (wrong.empty() && !rods) wrong = "has no list rods";
  for (std::size_t r = 0; wrong.empty() && r < rods->size(); ++r)
    wrong = read(*rods->get(r), between(0, 1e9), "rods hold ", network.rods.emplace_back());
  if (wrong.empty()) wrong = read_if_there(*table, "diameters_mm", network.diameters);
  if (wrong.empty()) wrong = read_if_there(*table, "supports_mm", network.supports);
  if (wrong.empty()) wrong = read_if_there(*table, "springs_N_per_mm", network.springs);
  if (wrong.empty()) wrong = read_if_there(*table, "free", network.free);
  if (wrong.empty()) wrong = network_fault(network);
  if (wrong.empty()) kind.in(preset) = std::move(network);
  return wrong;
}

// the points of a file, or what is wrong with it
std::string put_file(const PointList& kind, const std::filesystem::path& file, Preset& preset) {
  auto points = read_points(file, kind.coordinates, kind.words);
  if (!points) return points.error().message;
  if (const auto wrong = points_fault(*points); !wrong.empty()) return file.string() + ": " + wrong;
  kind.in(preset) = std::move(*points);
  return "";
}

// a surface or network out of a file, or none where the name is empty
template <class Kind, class Data>
std::string put_file(const Kind& kind, const std::string& name, const FileContext& beside,
                     Result<Data> (*read_data)(std::string_view, const std::string&),
                     std::size_t largest, Preset& preset) {
  if (name.empty()) {
    kind.in(preset) = {};
    return "";
  }
  const auto known = [&]() -> const std::string* {
    if (!beside.built_in) return nullptr;
    const auto found = beside.built_in->find(name);
    return found == beside.built_in->end() ? nullptr : &found->second;
  }();
  const auto file = beside.folder / name;
  const auto bytes = known ? Result<std::string>(*known) : read_file(file, largest);
  if (!bytes) return bytes.error().message;
  auto data = read_data(*bytes, known ? name : file.string());
  if (!data) return data.error().message;
  kind.in(preset) = std::move(*data);
  return "";
}

}  // namespace

std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const FileContext& beside) {
  if (const auto* points = std::get_if<PointList>(&field.kind); points && value.is_string())
    return put_file(*points, beside.folder / value.as_string()->get(), preset);
  if (const auto* surface = std::get_if<SurfaceText>(&field.kind); surface && value.is_string())
    return put_file(*surface, value.as_string()->get(), beside, read_surface, largest_mesh_file,
                    preset);
  if (const auto* network = std::get_if<NetworkText>(&field.kind); network && value.is_string())
    return put_file(*network, value.as_string()->get(), beside, read_network, largest_network_file,
                    preset);
  const auto wrong =
      std::visit([&](const auto& kind) { return put(kind, value, preset); }, field.kind);
  if (wrong.empty()) return "";
  std::string text = wrong + ", must be " + allowed(field);
  if (const auto* word = std::get_if<Word>(&field.kind); word && value.is_string())
    text += did_you_mean(value.as_string()->get(), word->words);
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
