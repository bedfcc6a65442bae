#include "engine/formats/obj_ply.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/point_file.h"
#include "engine/formats/surface_file.h"

namespace gridshell::preset {
namespace {

std::optional<long> obj_vertex(std::string_view word, long vertices) {
  word = word.substr(0, word.find('/'));
  const auto number = parse_number<long>(word);
  if (!number || *number == 0) return std::nullopt;
  return *number > 0 ? *number - 1 : vertices + *number;
}

/// The next line, with the following ones as long as it ends in a backslash. `number` is increased
/// for these; `joined` stores a line that is made of several.
std::string_view obj_line(std::string_view& text, int& number, std::string& joined) {
  std::string_view line = trimmed(next_line(text));
  if (!line.ends_with('\\')) return line;
  joined.clear();
  while (line.ends_with('\\')) {
    line.remove_suffix(1);
    joined += line;
    joined += ' ';
    if (text.empty()) return joined;
    line = trimmed(next_line(text));
    ++number;
  }
  joined += line;
  return joined;
}

/// x, y, z of a line "v x y z"; a weight or a colour may follow.
Result<std::vector<double>> obj_coordinates(const std::vector<std::string_view>& words,
                                            const std::string& where) {
  std::vector<double> xyz;
  bool commas = false;
  for (std::size_t k = 1; k < words.size(); ++k) {
    const auto value = number_of(words[k]);
    commas = commas || words[k].find(',') != words[k].npos;
    if (value && k < 4) xyz.push_back(*value);
    if (!value) break;
  }
  if (xyz.size() == 3) return xyz;
  return invalid("{}: expected a vertex of three numbers, v x y z{}", where,
                 commas ? ", with decimal points" : "");
}

enum class Form { text, little, big };

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Number> number_type(std::string_view word) {
  static const std::map<std::string_view, Number> types{
      {"char", Number::int8},      {"int8", Number::int8},       {"uchar", Number::uint8},
      {"uint8", Number::uint8},    {"short", Number::int16},     {"int16", Number::int16},
      {"ushort", Number::uint16},  {"uint16", Number::uint16},   {"int", Number::int32},
      {"int32", Number::int32},    {"uint", Number::uint32},     {"uint32", Number::uint32},
      {"float", Number::float32},  {"float32", Number::float32}, {"double", Number::float64},
      {"float64", Number::float64}};
  const auto found = types.find(word);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
  std::string name;
  std::optional<Number> count;  ///< type of the length of a list; empty: the property is no list
  Number value = Number::float32;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Form form = Form::text;
  std::vector<Element> elements;
  int lines = 0;
};

Result<Property> property_of(const std::vector<std::string_view>& words, const std::string& where) {
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3)
    return invalid(where + ": expected \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
  Property property{std::string(words.back()), std::nullopt, Number::float32};
  const auto value = number_type(words[words.size() - 2]);
  if (list) property.count = number_type(words[2]);
  if (!value || (list && !property.count))
    return invalid(where + ": got a type that PLY does not have");
  property.value = *value;
  return property;
}

Result<Header> read_header(std::string_view& bytes, const std::string& name) {
  constexpr std::size_t most_elements = 100;
  Header header;
  bool formed = false;
  while (!bytes.empty()) {
    const auto words = words_in(next_line(bytes));
    const auto where = fmt::format("{}:{}", name, ++header.lines);
    if (header.lines == 1) {
      if (words.size() == 1 && words[0] == "ply") continue;
      return invalid(where + ": got no PLY, expected \"ply\" as the first line");
    }
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      if (formed) return header;
      return invalid(where + ": got a header without a format");
    }
    if (words[0] == "format" && words.size() == 3) {
      formed = true;
      if (words[1] == "ascii")
        header.form = Form::text;
      else if (words[1] == "binary_little_endian")
        header.form = Form::little;
      else if (words[1] == "binary_big_endian")
        header.form = Form::big;
      else
        formed = false;
      if (formed) continue;
    }
    if (words[0] == "element" && words.size() == 3 && header.elements.size() < most_elements) {
      const auto count = number_of(words[2]);
      if (count && *count >= 0 && *count <= 1e9 && *count == std::floor(*count)) {
        header.elements.push_back({std::string(words[1]), std::size_t(*count), {}});
        continue;
      }
    }
    if (words[0] == "property" && !header.elements.empty() &&
        header.elements.back().properties.size() < most_elements) {
      TRY(property, property_of(words, where));
      header.elements.back().properties.push_back(std::move(*property));
      continue;
    }
    return invalid(where + ": got no line of a PLY header");
  }
  return invalid(name + ": ends within its header");
}

/// Reads the numbers after a header, one by one; empty at the end, or if a text is no number.
class Numbers {
 public:
  Numbers(std::string_view bytes, Form form) : bytes_(bytes), form_(form) {}

  std::optional<double> next(Number type) {
    return form_ == Form::text ? next_word() : next_bytes(type);
  }

 private:
  std::optional<double> next_word() {
    constexpr std::string_view blanks = " \t\r\n\f\v";
    const std::size_t begin = bytes_.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return std::nullopt;
    bytes_.remove_prefix(begin);
    const std::size_t end = std::min(bytes_.find_first_of(blanks), bytes_.size());
    // nan is a number: scanners write it for missing vertices
    std::string_view word = bytes_.substr(0, end);
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto value = parse_number<double>(word);
    bytes_.remove_prefix(end);
    return value;
  }

  template <class T>
  std::optional<double> as() {
    if (bytes_.size() < sizeof(T)) return std::nullopt;
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    const auto own = std::endian::native == std::endian::little ? Form::little : Form::big;
    if (form_ != own) std::reverse(std::begin(raw), std::end(raw));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return double(value);
  }

  std::optional<double> next_bytes(Number type) {
    switch (type) {
      case Number::int8:
        return as<std::int8_t>();
      case Number::uint8:
        return as<std::uint8_t>();
      case Number::int16:
        return as<std::int16_t>();
      case Number::uint16:
        return as<std::uint16_t>();
      case Number::int32:
        return as<std::int32_t>();
      case Number::uint32:
        return as<std::uint32_t>();
      case Number::float32:
        return as<float>();
      case Number::float64:
        break;
    }
    return as<double>();
  }

  std::string_view bytes_;
  Form form_;
};

/// The values of one property of one element: a single one, or those of a list.
std::optional<std::vector<double>> values_of(const Property& property, Numbers& numbers) {
  constexpr double longest = 1000;
  double count = 1;
  if (property.count) {
    const auto length = numbers.next(*property.count);
    if (!length || !(*length >= 0 && *length <= longest)) return std::nullopt;
    count = *length;
  }
  std::vector<double> values;
  while (double(values.size()) < count) {
    const auto value = numbers.next(property.value);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

Result<PlyItem> read_item(const Element& element, std::size_t number, Numbers& numbers,
                          const std::string& name) {
  PlyItem item;
  item.element = element.name;
  item.number = number;
  int coordinates = 0;
  for (const Property& property : element.properties) {
    const auto values = values_of(property, numbers);
    if (!values)
      return invalid(item.location(name) +
                     ": got the end of the file or no number, expected a number");
    if (!property.count && property.name.size() == 1 && property.name[0] >= 'x' &&
        property.name[0] <= 'z') {
      item.xyz[property.name[0] - 'x'] = values->front();
      ++coordinates;
    }
    if (!property.count && (property.name == "vertex1" || property.name == "vertex2"))
      item.corners.push_back(std::abs(values->front()) < 1e9 ? long(values->front()) : -1);
    if (property.count && (property.name == "vertex_indices" || property.name == "vertex_index"))
      for (const double corner : *values)
        item.corners.push_back(std::abs(corner) < 1e9 ? long(corner) : -1);
  }
  item.has_xyz = coordinates >= 3;
  return item;
}

}  // namespace

Result<std::map<std::string, int>> read_obj_lines(std::string_view bytes, const std::string& name,
                                                  std::string_view element,
                                                  const ObjCallbacks& lines) {
  std::string storage;
  bytes = plain_text(bytes, storage);
  std::map<std::string, int> others;
  long vertices = 0;
  std::string joined;
  for (int number = 1, first = 1; !bytes.empty(); first = ++number) {
    const std::string_view line = obj_line(bytes, number, joined);
    const auto words = words_in(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    const auto where = fmt::format("{}:{}", name, first);
    if (words[0] == "curv" || words[0] == "curv2" || words[0] == "surf")
      return invalid("{}: got '{}', a free-form {}, expected {}", where, words[0],
                     words[0] == "surf" ? "surface" : "curve",
                     words[0] == "surf" ? "polygons (f)" : "a polyline (l)");
    if (words[0] == "v") {
      TRY(xyz, obj_coordinates(words, where));
      if (auto taken = lines.vertex(*xyz, where); !taken) return tl::unexpected(taken.error());
      ++vertices;
    }
    if (words[0] != element) {
      if (words[0] == "f" || words[0] == "l" || words[0] == "p") ++others[std::string(words[0])];
      continue;
    }
    std::vector<long> corners;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto corner = obj_vertex(words[k], vertices);
      if (!corner)
        return invalid("{}: got '{}', expected the number of a vertex", where,
                       words[k].substr(0, 40));
      corners.push_back(*corner);
    }
    if (auto taken = lines.element(corners, where); !taken) return tl::unexpected(taken.error());
  }
  return others;
}

Result<void> read_off_lines(std::string_view bytes, const std::string& name,
                            const ObjCallbacks& lines) {
  std::string storage;
  bytes = plain_text(bytes, storage);
  int number = 0;
  const auto next_words = [&] {
    std::vector<std::string_view> words;
    while (words.empty() && !bytes.empty()) {
      const std::string_view line = next_line(bytes);
      words = words_in(line.substr(0, line.find('#')));
      ++number;
    }
    return words;
  };
  auto words = next_words();
  if (!words.empty() && words[0].ends_with("OFF")) words.erase(words.begin());
  if (words.empty()) words = next_words();
  const auto count = [&](std::size_t k) {
    const auto value = k < words.size() ? parse_number<long>(words[k]) : std::nullopt;
    constexpr long most = 1'000'000'000;  // vertices, faces, and corners of a face
    return value && *value >= 0 && *value <= most ? *value : -1;
  };
  const long vertices = count(0), faces = count(1);
  if (vertices < 0 || faces < 0)
    return invalid("{}:{}: got no OFF, expected \"OFF\" and the numbers of vertices and faces",
                   name, number);
  for (long k = 0; k < vertices + faces; ++k) {
    words = next_words();
    const auto where = fmt::format("{}:{}", name, number);
    if (words.empty())
      return invalid("{}: ends after {} of its {} vertices and {} faces", where, k, vertices,
                     faces);
    if (k < vertices) {
      std::vector<double> xyz;
      for (std::size_t n = 0; n < words.size() && n < 3; ++n)
        if (const auto value = number_of(words[n])) xyz.push_back(*value);
      if (xyz.size() != 3) return invalid("{}: expected a vertex of three numbers, x y z", where);
      if (auto taken = lines.vertex(xyz, where); !taken) return taken;
      continue;
    }
    std::vector<long> corners;
    const long size = count(0);
    for (long n = 1; n <= size && n < long(words.size()); ++n)
      corners.push_back(count(std::size_t(n)));
    if (size < 0 || long(corners.size()) != size)
      return invalid("{}: expected a face: its number of vertices and these", where);
    if (auto taken = lines.element(corners, where); !taken) return taken;
  }
  return {};
}

std::string PlyItem::location(const std::string& name) const {
  return fmt::format("{}: {} {}", name, element, number + 1);
}

Result<void> each_ply_item(std::string_view bytes, const std::string& name,
                           const std::function<Result<void>(const PlyItem&)>& take) {
  TRY(header, read_header(bytes, name));
  Numbers numbers(bytes, header->form);
  for (const Element& element : header->elements)
    // elements without properties take no bytes: a file may declare any number of them
    for (std::size_t k = 0; k < element.count && !element.properties.empty(); ++k) {
      TRY(item, read_item(element, k, numbers, name));
      if (auto taken = take(*item); !taken) return taken;
    }
  return {};
}

}  // namespace gridshell::preset
