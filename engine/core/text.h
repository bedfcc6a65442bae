// Numbers and words in text.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridshell {

/// `text` as a number; empty unless all of its characters belong to the number. `how`: arguments of
/// std::from_chars, the base of an integer or the format of a real number.
template <class Number, class... How>
std::optional<Number> parse_number(std::string_view text, How... how) {
  Number number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number, how...);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The words of a line, separated by any of the characters of `apart`.
inline std::vector<std::string_view> words_in(std::string_view line,
                                              std::string_view apart = " \t\r\f\v") {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(apart, at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(apart, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// "1 rod", "2 rods".
inline std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// Removes the next line from the front of a text and returns it without its end.
inline std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// "Did you mean ...": the known name nearest to a mistyped one.

/// Least number of letters that are inserted, left out, changed, or exchanged with a neighbour
/// (optimal string alignment distance); upper and lower case are equal.
int edit_distance(std::string_view a, std::string_view b);

/// The name in `known` that is most similar to `word`, if at most a third of the letters differ
/// (one letter always may) or the end is missing; else empty. Of equally similar ones the first.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?", or empty if no name is similar.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// The error message on a value. The reason "rods would touch, expected less than 2" gives "KEY:
/// got VALUE (rods would touch), expected less than 2"; "expected less than 2" gives "KEY: got
/// VALUE, expected less than 2"; a reason without an expectation gives "KEY: got VALUE: REASON".
std::string got_text(const std::string& key, const std::string& value, const std::string& reason);

// Text in XML.

/// The text for XML: characters with a meaning in XML are escaped, control characters are left out.
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
    else if (c == '"')
      xml += "&quot;";
    else if (!control)
      xml += c;
  }
  return xml;
}

}  // namespace gridshell
