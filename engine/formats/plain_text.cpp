#include "engine/formats/plain_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

namespace gridshell::preset {
namespace {

void append_utf8(unsigned long code, std::string& text) {
  if (code < 0x80) {
    text += char(code);
    return;
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::array<int, 4> first{0, 0xC0, 0xE0, 0xF0};
  text += char(first[std::size_t(more)] | int(code >> (6 * more)));
  for (int k = more - 1; k >= 0; --k) text += char(0x80 | (int(code >> (6 * k)) & 0x3F));
}

std::string from_utf16(std::string_view bytes, bool big) {
  std::string text;
  unsigned long high = 0;
  for (std::size_t k = 0; k + 1 < bytes.size(); k += 2) {
    const auto a = (unsigned char)bytes[k], b = (unsigned char)bytes[k + 1];
    const unsigned long unit = big ? a << 8 | b : b << 8 | a;
    if (unit >= 0xD800 && unit < 0xDC00) {
      high = unit;
    } else {
      const bool low = high != 0 && unit >= 0xDC00 && unit < 0xE000;
      append_utf8(low ? 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00) : unit, text);
      high = 0;
    }
  }
  // half a code unit at the end: the file was cut short
  if (bytes.size() % 2 == 1) text += '?';
  return text;
}

}  // namespace

std::string_view plain_text(std::string_view bytes, std::string& storage) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto pair = [&](std::size_t k, char a, char b) {
    return bytes.size() > k + 1 && bytes[k] == a && bytes[k + 1] == b;
  };
  const bool zeros = bytes.size() >= 4 && (bytes[0] == '\0') != (bytes[1] == '\0') &&
                     (bytes[0] == '\0') == (bytes[2] == '\0') &&
                     (bytes[1] == '\0') == (bytes[3] == '\0');
  if (pair(0, '\xFF', '\xFE') || pair(0, '\xFE', '\xFF') || zeros) {
    const bool mark = !zeros || pair(0, '\xFF', '\xFE') || pair(0, '\xFE', '\xFF');
    const bool big = mark ? bytes[0] == '\xFE' : bytes[0] == '\0';
    storage = from_utf16(bytes.substr(mark ? 2 : 0), big);
    bytes = storage;
  }
  if (bytes.find('\n') == bytes.npos && bytes.find('\r') != bytes.npos) {
    std::string lines(bytes);
    std::ranges::replace(lines, '\r', '\n');
    storage = std::move(lines);
    bytes = storage;
  }
  return bytes;
}

double millimetres_of(std::string_view unit) {
  static const std::map<std::string_view, double> units{
      {"mm", 1},         {"cm", 10},         {"dm", 100},     {"m", 1000},     {"in", 25.4},
      {"inch", 25.4},    {"ft", 304.8},      {"feet", 304.8}, {"um", 1e-3},    {"\xC2\xB5m", 1e-3},
      {"millimeter", 1}, {"centimeter", 10}, {"meter", 1000}, {"metre", 1000}, {"km", 1e6}};
  const auto found = units.find(unit);
  return found == units.end() ? 0 : found->second;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(word_blanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(word_blanks) + 1 - begin);
}

std::string lower(std::string_view text) {
  std::string letters(text);
  for (char& c : letters) c = char(std::tolower((unsigned char)c));
  return letters;
}

}  // namespace gridshell::preset
