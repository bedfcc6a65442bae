// Files of text in other encodings, and their units.
#include "engine/formats/plain_text.h"

#include "tests/results.h"

using namespace gridshell::preset;

namespace {

std::string plain(std::string_view bytes) {
  std::string storage;
  return std::string(plain_text(bytes, storage));
}

/// The text in UTF-16, of letters below 256.
std::string wide(const std::string& text, bool big, bool mark) {
  std::string bytes = !mark ? "" : big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    if (big) bytes += '\0';
    bytes += c;
    if (!big) bytes += '\0';
  }
  return bytes;
}

}  // namespace

TEST_CASE("a text is the same with a mark, in UTF-16 and with old ends of lines") {
  const std::string text = "x,y\n1,2\n";
  CHECK(plain(text) == text);
  CHECK(plain("\xEF\xBB\xBF" + text) == text);
  for (const bool big : {false, true})
    for (const bool mark : {false, true}) CHECK(plain(wide(text, big, mark)) == text);
  CHECK(plain("x,y\r1,2\r") == text);
  CHECK(plain("x,y\r\n1,2\r\n") == "x,y\r\n1,2\r\n");
  CHECK(plain(std::string("\xFF\xFE\xE9\0\x3D\xD8\0\xDE", 8)) == "\xC3\xA9\xF0\x9F\x98\x80");
  // half a letter at the end becomes '?', not a digit
  CHECK(plain(wide("1,2", false, true) + "3") == "1,2?");
  CHECK(plain("") == "");
}

TEST_CASE("units of length in millimetres") {
  CHECK(millimetres_of("mm") == 1);
  CHECK(millimetres_of("m") == 1000);
  CHECK(millimetres_of("in") == 25.4);
  CHECK(millimetres_of("furlong") == 0);
}
