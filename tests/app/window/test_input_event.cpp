// Letters that are typed, as UTF-8.
#include "app/window/input_event.h"

#include <catch2/catch.hpp>

TEST_CASE("a letter is one to four bytes of UTF-8") {
  using gridshell::window::utf8_of;
  CHECK(utf8_of('a') == "a");
  CHECK(utf8_of(0xe4) == "ä");
  CHECK(utf8_of(0x20ac) == "€");
  CHECK(utf8_of(0x1f600) == "😀");
}
