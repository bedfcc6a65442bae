// Text files of other programs: encodings, blanks, names of units.
#pragma once

#include <string>
#include <string_view>

namespace gridshell::preset {

/// Characters that separate words on a line.
inline constexpr std::string_view word_blanks = " \t\r\f\v";

/// The text of a file as UTF-8: without its byte-order mark, converted from UTF-16, and with line
/// ends CR converted to LF. `storage` stores a converted text.
std::string_view plain_text(std::string_view bytes, std::string& storage);

/// A text without blanks around it.
std::string_view trimmed(std::string_view text);

/// A text with its ASCII letters in lower case.
std::string lower(std::string_view text);

/// Millimetres of a unit of length: "mm", "cm", "m", "in", "ft", ...; 0: it is no unit of length.
double millimetres_of(std::string_view unit);

}  // namespace gridshell::preset
