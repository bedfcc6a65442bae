// Numbers in text.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace gridshell {

/// `text` as a number, if it is one from its first character to its last; `how` as
/// std::from_chars takes it: the base of an integer, the format of a real number.
template <class Number, class... How>
std::optional<Number> parse_number(std::string_view text, How... how) {
  Number number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number, how...);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Text as XML takes it.

/// Without the signs that XML takes for itself, and without control characters.
inline std::string escape_xml(std::string_view letters) {
  std::string xml;
  for (char c : letters) {
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else if (c == '>')
      xml += "&gt;";
    else if (!control)
      xml += c;
  }
  return xml;
}

}  // namespace gridshell
