// JSON, read and written in one place: its templates take a compiler seconds a file.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace gridshell::record {

/// Keys keep their order.
using Json = nlohmann::ordered_json;

/// The value of a text; one that is_discarded() where the text is not JSON.
Json parsed(std::string_view text);

/// A whole number that an int holds; nothing for any other value.
std::optional<int> whole_number(const Json& json);

/// Indented, with a newline at its end. NaN becomes null, a broken UTF-8 sequence U+FFFD.
std::string text_of(const Json& json);

/// The same on one line without a newline; `ascii`: other letters as \uXXXX.
std::string line_of(const Json& json, bool ascii = false);

}  // namespace gridshell::record
