// Reading and writing JSON in one source file, since its templates take seconds to compile.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/core/enum_words.h"

namespace gridshell {

/// JSON whose keys are in the order in which they were added.
using Json = nlohmann::ordered_json;

/// The value of a text; if the text is not JSON, a value with is_discarded().
Json parsed(std::string_view text);

/// JSON as indented text with a newline at its end. NaN becomes null, an invalid UTF-8 sequence
/// U+FFFD.
std::string text_of(const Json& json);

/// JSON on one line without a newline; `ascii`: other characters as \uXXXX.
std::string line_of(const Json& json, bool ascii = false);

/// Assigns a value of the right type. If it has another type, returns the expected one, else an
/// empty text.
std::string take(const Json& json, int& value);
std::string take(const Json& json, bool& value);
/// As above; null becomes NaN, an unknown number.
std::string take(const Json& json, double& value);
std::string take(const Json& json, std::string& value);
std::string take(const Json& json, std::vector<std::string>& value);
std::string take(const Json& json, std::map<std::string, int>& value);
template <class Enum>
requires std::is_enum_v<Enum> std::string take(const Json& json, Enum& value) {
  if (json.is_string())
    if (const auto found = find_word<Enum>(json.get<std::string>())) return value = *found, "";
  std::string expected;
  for (const auto& [one, word] : words_of<Enum>())
    if (!word.empty())
      expected.append(expected.empty() ? "one of \"" : ", \"").append(word).append("\"");
  return expected;
}

/// A record as an object with the keys that `fields` (core/fields.h) names.
template <class Record>
Json json_of(const Record& record) {
  Json json = Json::object();  // made by [] it would not survive a failed allocation
  fields(record, [&]<class Value>(const char* key, const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      json[key] = word_of(value);
    else
      json[key] = value;
  });
  return json;
}

/// Reads the members of a record from an object; a missing key is no error if `may_lack(key)`.
/// Returns the first error as a text; empty: there is none.
template <class Record, class MayLack>
std::string take_fields(const Json& json, Record& record, const MayLack& may_lack) {
  std::string fault;
  fields(record, [&](const std::string& key, auto& value) {
    if (!fault.empty()) return;
    if (!json.contains(key)) {
      if (!may_lack(key)) fault = "has no \"" + key + "\"";
    } else if (const std::string expected = take(json[key], value); !expected.empty()) {
      fault = "\"" + key + "\": got " + line_of(json[key]) + ", expected " + expected;
    }
  });
  return fault;
}

}  // namespace gridshell
