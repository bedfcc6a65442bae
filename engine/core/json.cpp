#include "engine/core/json.h"

#include <algorithm>
#include <limits>

namespace gridshell {
namespace {

std::string dumped(const Json& json, int indent, bool ascii) {
  return json.dump(indent, ' ', ascii, Json::error_handler_t::replace);
}

/// The value as an int if it is an integer in the range of int, else empty.
std::optional<int> whole_number(const Json& json) {
  if (!json.is_number_integer()) return std::nullopt;
  const bool fits = json.is_number_unsigned() ? std::in_range<int>(json.get<std::uint64_t>())
                                              : std::in_range<int>(json.get<std::int64_t>());
  return fits ? std::optional(json.get<int>()) : std::nullopt;
}

}  // namespace

Json parsed(std::string_view text) { return Json::parse(text, nullptr, false); }

std::string text_of(const Json& json) { return dumped(json, 2, false) + "\n"; }

std::string line_of(const Json& json, bool ascii) { return dumped(json, -1, ascii); }

std::string take(const Json& json, int& value) {
  const auto number = whole_number(json);
  value = number.value_or(value);
  return number ? "" : "an integer";
}

std::string take(const Json& json, bool& value) {
  if (json.is_boolean()) value = json.get<bool>();
  return json.is_boolean() ? "" : "true or false";
}

std::string take(const Json& json, double& value) {
  value = json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
  return json.is_number() || json.is_null() ? "" : "a number or null";
}

std::string take(const Json& json, std::string& value) {
  if (json.is_string()) value = json.get<std::string>();
  return json.is_string() ? "" : "a string";
}

std::string take(const Json& json, std::vector<std::string>& value) {
  const bool right = json.is_array() && std::ranges::all_of(json, &Json::is_string);
  if (right) value = json.get<std::vector<std::string>>();
  return right ? "" : "a list of strings";
}

std::string take(const Json& json, std::map<std::string, int>& value) {
  bool right = json.is_object();
  if (right)
    for (const auto& [key, item] : json.items()) right = right && take(item, value[key]).empty();
  return right ? "" : "an object of whole numbers";
}

}  // namespace gridshell
