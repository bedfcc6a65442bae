// Reads networks from JSON: points, rods, listed joints, supports.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/core/enum_words.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/network_file.h"
#include "engine/formats/plain_text.h"

namespace gridshell::preset {
namespace {

using Json = nlohmann::json;

/// An iterator over characters that counts lines.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, int* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    if (*at_ == '\n') ++*line_;
    ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  int* line_;
};

// largest depth of nested values in a network
constexpr int deepest = 6;

constexpr std::size_t most_at_a_joint = 100;
constexpr std::size_t longest_key = 40;

/// A JSON document, and the line at which each item of its lists starts.
struct Document {
  Json json;
  std::map<std::string, std::vector<int>> lines;
};

Result<Document> parse(std::string_view bytes, const std::string& name) {
  Document document;
  int line = 1;
  std::string key, twice;
  std::map<int, std::set<std::string>> keys;  // keys of the open objects, by depth
  const auto seen = [&](int depth, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) keys[depth + 1].clear();
    if (event == Event::key) {
      const auto here = value.get<std::string>();
      if (depth == 1) key = here;
      if (twice.empty() && !keys[depth].insert(here).second)
        twice = fmt::format("{}:{}: got key '{}' twice in one object, expected it once", name, line,
                            here.substr(0, longest_key));
    }
    const bool begins =
        event == Event::array_start || event == Event::object_start || event == Event::value;
    if (begins && depth == 2) document.lines[key].push_back(line);
    return depth < deepest;
  };
  try {
    document.json = Json::parse(CountingIterator(bytes.data(), &line),
                                CountingIterator(bytes.data() + bytes.size(), &line), seen);
  } catch (const Json::exception& error) {
    return invalid(
        "{}:{}: {}", name, line,
        bytes.empty() ? "got an empty file, expected JSON" : "got no JSON at this position");
  }
  if (!twice.empty()) return invalid(twice);
  if (!document.json.is_object())
    return invalid(name + ":1: expected an object {\"points_mm\": ..., \"rods\": ...}");
  return document;
}

/// The numbers of a list; empty if it is no list of numbers.
std::optional<std::vector<double>> numbers_in(const Json& value) {
  if (!value.is_array()) return std::nullopt;
  std::vector<double> numbers;
  for (const Json& item : value) {
    if (!item.is_number()) return std::nullopt;
    numbers.push_back(item.get<double>());
  }
  return numbers;
}

class Reader {
 public:
  Reader(const Document& document, const std::string& name, double join_mm)
      : document_(document), name_(name), builder_(join_mm) {}

  Result<NetworkData> read() {
    const std::vector<std::string> known{"points_mm", "rods", "joints", "supports", "law"};
    for (const auto& [key, value] : document_.json.items()) {
      if (std::ranges::find(known, key) == known.end())
        return invalid(
            "{}: got an unknown key '{}', expected points_mm, rods, joints, supports or law{}",
            name_, key.substr(0, 40),
            std::ranges::count(known, key + "_mm") > 0 ? fmt::format("; did you mean '{}_mm'?", key)
                                                       : did_you_mean(key, known));
      if (key != "law" && !value.is_array())
        return invalid("{}: '{}': expected a list", name_, key);
    }
    return each("points_mm", &Reader::point)
        .and_then([&] { return each("rods", &Reader::rod); })
        .and_then([&] { return each("joints", &Reader::joint); })
        .and_then([&] { return each("supports", &Reader::support); })
        .and_then([&] { return builder_.join_listed(); })
        .and_then([&] { return builder_.join_ends(name_); })
        .and_then([&] { return network_law(); })
        .and_then([&] { return builder_.take(name_); });
  }

 private:
  Result<void> each(const char* key, Result<void> (Reader::*item)(const Json&)) {
    const auto list = document_.json.find(key);
    if (list == document_.json.end()) return {};
    const auto lines = document_.lines.find(key);
    for (std::size_t k = 0; k < list->size(); ++k) {
      const int line =
          lines != document_.lines.end() && k < lines->second.size() ? lines->second[k] : 1;
      at_ = fmt::format("{}:{}: {}[{}]", name_, line, key, k);
      if (auto done = (this->*item)((*list)[k]); !done) return done;
    }
    return {};
  }

  tl::unexpected<Error> wrong(const std::string& what) const {
    return invalid("{}: {}", at_, what);
  }
  static std::string shown(const Json& value) {
    constexpr std::size_t longest = 60;
    const std::string text = value.dump(-1, ' ', true);
    return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
  }
  tl::unexpected<Error> unlike(const Json& value, const std::string& expected) const {
    return wrong("got " + shown(value) + ", expected " + expected);
  }
  tl::unexpected<Error> unlike(const std::string& key, const Json& value,
                               const std::string& expected) const {
    return wrong(key + ": got " + shown(value) + ", expected " + expected);
  }

  Result<void> point(const Json& value) {
    const auto xyz = numbers_in(value);
    if (!xyz) return unlike(value, "a point [x, y] or [x, y, z], mm");
    return builder_.add_point(*xyz, at_);
  }

  /// Index of the point that a value names by index or position. An index of a point that was
  /// merged with an earlier one is an error, since it is probably a mistake, except in a list of
  /// joints.
  Result<int> point_of(const Json& value, bool in_joint = false) {
    if (value.is_number_integer()) {
      if (value.is_number_unsigned() && value.get<std::uint64_t>() > builder_.points())
        return wrong("got a point that is not in points_mm");
      const long number = value.get<long>();
      TRY(point, builder_.point(number, at_));
      if (*point != number && !in_joint && !is_listed(value) && !builder_.joins_near())
        return wrong(fmt::format(
            "got point {} at the position of point {}, expected that number, or another position",
            number, *point));
      return *point;
    }
    const auto xyz = numbers_in(value);
    if (!xyz) return unlike(value, "the number of a point, or its position [x, y] or [x, y, z]");
    return builder_.find_or_add_point(*xyz, at_);
  }

  /// Whether "joints" lists a point by its number.
  bool is_listed(const Json& number) const {
    const auto joints = document_.json.find("joints");
    return joints != document_.json.end() && std::ranges::any_of(*joints, [&](const Json& joint) {
             const Json& points =
                 joint.is_object() && joint.contains("points") ? joint["points"] : joint;
             return points.is_array() && std::ranges::find(points, number) != points.end();
           });
  }

  Result<void> rod(const Json& value) {
    const Json* list = &value;
    double diameter = 0;
    std::vector<std::pair<std::string, double>> own;
    std::vector<std::pair<bool, EndKind>> constraints;
    if (value.is_object()) {
      for (const auto& [key, inner] : value.items()) {
        if (key == "points") {
          list = &inner;
        } else if (key == "begin" || key == "end") {
          const auto kind =
              inner.is_string() ? find_word<EndKind>(inner.get<std::string>()) : std::nullopt;
          if (!kind)
            return unlike(key, inner,
                          fmt::format("\"{}\"", fmt::join(all_words<EndKind>(), "\", \"")));
          constraints.emplace_back(key == "end", *kind);
        } else if (key == "diameter_mm" && inner.is_number() && inner.get<double>() > 0) {
          diameter = inner.get<double>();
        } else if (key != "diameter_mm" &&
                   (key == "as_drawn" ? inner.is_boolean() : inner.is_number())) {
          // own_value_error() checks the keys: this folder does not know those of [rod]
          own.emplace_back(key.substr(0, longest_key),
                           inner.is_boolean() ? double(inner.get<bool>()) : inner.get<double>());
        } else {
          return unlike(key, inner,
                        "{\"points\": list, \"diameter_mm\": number above 0}, in addition "
                        "\"begin\", \"end\" and keys of [rod], each a number (as_drawn: true or "
                        "false)");
        }
      }
    }
    if (!list->is_array()) return unlike(*list, "a list of points");
    std::vector<int> points;
    for (const Json& item : *list) {
      TRY(point, point_of(item));
      points.push_back(*point);
    }
    TRY_DO(builder_.add_rod(std::move(points), diameter, at_));
    for (const auto& [key, number] : own) builder_.add_own(key, number);
    for (const auto& [end, kind] : constraints) builder_.add_constraint(end, kind);
    return {};
  }

  Result<void> joint(const Json& value) {
    if (value.is_object()) return joint_with_law(value);
    TRY(point, merged(value));
    return {};
  }

  /// Adds a list of points that are one joint. Returns the first.
  Result<int> merged(const Json& value) {
    if (!value.is_array() || value.size() < 2 || value.size() > most_at_a_joint)
      return unlike(value, "a list of 2 to 100 points, by number or position");
    std::vector<int> points;
    for (std::size_t k = 0; k < value.size(); ++k) {
      TRY(point, point_of(value[k], true));
      if (std::find(value.begin(), value.begin() + std::ptrdiff_t(k), value[k]) !=
          value.begin() + std::ptrdiff_t(k))
        return wrong("got a point twice, expected each point once");
      points.push_back(*point);
    }
    const int first = points.front();
    TRY_DO(builder_.add_joint(std::move(points), at_));
    return first;
  }

  /// Reads the law of all joints without a law of their own: a name, or an object as for a joint.
  Result<void> network_law() {
    const auto law = document_.json.find("law");
    if (law == document_.json.end()) return {};
    at_ = name_ + ": law";
    const Json value = law->is_object() ? *law : Json{{"law", *law}};
    if (value.contains("point") || value.contains("points") || value.contains("eccentricity_mm"))
      return wrong(
          "got the law of all joints, expected \"law\", \"shear_Nmm\" and \"twist_Nmm\" alone");
    TRY(row, law_of(value, every_joint));
    builder_.add_law(std::move(*row));
    return {};
  }

  /// Reads a law as a row of joint_laws: "free", "hinge" (rotates about the normal alone), "rigid",
  /// or "spring" with two stiffnesses.
  Result<std::vector<double>> law_of(const Json& value, double point) const {
    static const std::map<std::string, std::pair<double, double>> laws{
        {"free", {0, 0}}, {"hinge", {0, -1}}, {"rigid", {-1, -1}}, {"spring", {0, 0}}};
    const auto text = value.find("law");
    const auto law =
        text != value.end() && text->is_string() ? laws.find(text->get<std::string>()) : laws.end();
    if (law == laws.end())
      return unlike(value, "\"law\" of \"free\", \"hinge\", \"rigid\" or \"spring\"");
    auto [shear, twist] = law->second;
    for (const auto& [key, inner] : value.items()) {
      if (key == "law" || key == "point" || key == "points") continue;
      if (key == "eccentricity_mm") {
        if (!inner.is_number() || !(std::abs(inner.get<double>()) <= 1000))
          return unlike(key, inner, "a number from -1000 to 1000");
        continue;
      }
      const bool stiffness = key == "shear_Nmm" || key == "twist_Nmm";
      if (!stiffness || law->first != "spring")
        return unlike(value,
                      "{\"point\" or \"points\", \"law\"}, of a \"spring\" with "
                      "\"shear_Nmm\" and \"twist_Nmm\", and may have \"eccentricity_mm\"");
      if (!inner.is_number() || !(inner.get<double>() >= 0 && inner.get<double>() <= 1e9))
        return unlike(key, inner, "a number from 0 to 1e9");
      (key == "shear_Nmm" ? shear : twist) = inner.get<double>();
    }
    std::vector<double> row{point, shear, twist};
    if (value.contains("eccentricity_mm")) row.push_back(value["eccentricity_mm"].get<double>());
    return row;
  }

  Result<void> joint_with_law(const Json& value) {
    TRY(row, law_of(value, 0));
    if (value.contains("point") == value.contains("points"))
      return wrong("got a law of no joint, expected a \"point\", or \"points\" that are one joint");
    TRY(point, value.contains("point") ? point_of(value["point"]) : merged(value["points"]));
    row->front() = double(*point);
    builder_.add_law(std::move(*row));
    return {};
  }

  Result<void> support(const Json& value) {
    if (!value.is_object() || !value.contains("point"))
      return unlike(value, "{\"point\": number, \"to_mm\": [x, y, z] or \"free\"}");
    TRY(point, point_of(value["point"]));
    for (const auto& [key, inner] : value.items())
      if (key != "point" && key != "to_mm" && key != "spring_N_per_mm")
        return unlike(value,
                      "{\"point\": number, \"to_mm\": [x, y, z], \"spring_N_per_mm\": number}");
    if (value.contains("to_mm") && value["to_mm"] == "free") {
      if (value.contains("spring_N_per_mm"))
        return wrong("an end that is free has no spring_N_per_mm");
      builder_.add_free(*point);
      return {};
    }
    std::vector<double> row{double(*point)};
    if (value.contains("to_mm")) {
      const auto to = numbers_in(value["to_mm"]);
      if (!to || to->size() != 3) return unlike("to_mm", value["to_mm"], "[x, y, z], or \"free\"");
      for (const double one : *to)
        if (!(std::abs(one) <= 1e9)) return unlike("to_mm", value["to_mm"], "at most 1e9");
      row.insert(row.end(), to->begin(), to->end());
    }
    builder_.add_support(std::move(row));
    return value.contains("spring_N_per_mm") ? spring(*point, value["spring_N_per_mm"])
                                             : Result<void>();
  }

  /// Reads the stiffness of a support's spring: one for x, y and z, or one for each.
  Result<void> spring(int point, const Json& value) {
    const auto k = value.is_number() ? std::vector<double>(3, value.get<double>())
                                     : numbers_in(value).value_or(std::vector<double>());
    if (k.size() != 3) return unlike("spring_N_per_mm", value, "a number, or [kx, ky, kz]");
    if (const auto fault = spring_error(k); !fault.empty()) return wrong(fault);
    builder_.add_spring(point, k);
    return {};
  }

  const Document& document_;
  std::string name_, at_;
  NetworkBuilder builder_;
};

}  // namespace

Result<NetworkData> read_network_json(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options) {
  if (options.unit_mm > 0 && options.unit_mm != 1)
    return invalid("{}: its points are points_mm, expected file_unit \"mm\" or none", name);
  if (options.linkage)
    return invalid("{}: [footprint] linkage: got true, expected none: the file lists its rods",
                   name);
  std::string storage;
  TRY(document, parse(plain_text(bytes, storage), name));
  return Reader(*document, name, options.join_mm).read();
}

}  // namespace gridshell::preset
