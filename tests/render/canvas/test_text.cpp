#include <catch2/catch.hpp>

#include "render/canvas/canvas.h"
#include "render/canvas/text.h"

using namespace gridshell::render;

TEST_CASE("marks lower, raise and slant, the letters stay") {
  const auto runs = parse_marked("*R*_{a} = 10^{−3} mm");
  REQUIRE(runs.size() == 5);
  CHECK(runs[0].text == "R");
  CHECK(runs[0].slanted);
  CHECK(runs[1].text == "a");
  CHECK(runs[1].level == -1);
  CHECK_FALSE(runs[1].slanted);
  CHECK(runs[2].text == " = 10");
  CHECK(runs[3].level == 1);
  CHECK(runs[4].text == " mm");
  CHECK(without_marks("*K*_{□} (rad)") == "K□ (rad)");
}

TEST_CASE("a mark without its partner is a letter") {
  CHECK(without_marks("2 * 3") == "2 * 3");
  CHECK(without_marks("s1_actuation") == "s1_actuation");
  CHECK(without_marks("R_{a") == "R_{a");
  CHECK(without_marks("end\\") == "end\\");
}

TEST_CASE("plain text is shown as it is") {
  for (const std::string text : {"R_{a}*x*^{2}", "a\\b", "out/s1_actuation", "\\", "*"})
    CHECK(without_marks(plain(text)) == text);
}
