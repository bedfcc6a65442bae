// Files of text as other programs write them, and the units that they name.
#pragma once

#include <string>
#include <string_view>

namespace gridshell::preset {

inline constexpr std::string_view word_blanks = " \t\r\f\v";

/// The text of a file as UTF-8: without its byte-order mark, converted from UTF-16, and with line
/// ends CR converted to LF. `storage` stores a converted text.
std::string_view plain_text(std::string_view bytes, std::string& storage);

/// Without blanks around it.
std::string_view trimmed(std::string_view text);

/// In small letters, where they are of ASCII.
std::string lower(std::string_view text);

/// A unit of length in millimetres: "mm", "cm", "m", "in", "ft", ...; 0: it is none.
double millimetres_of(std::string_view unit);

}  // namespace gridshell::preset
