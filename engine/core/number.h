// Numbers in text.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace gridshell {

/// `text` as a number, if it is one from its first character to its last; `how` as
/// std::from_chars takes it: the base of an integer, the format of a real number.
template <class Number, class... How>
std::optional<Number> number_from(std::string_view text, How... how) {
  Number number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number, how...);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace gridshell
