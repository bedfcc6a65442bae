#include "render/canvas/short_svg.h"

#include <catch2/catch.hpp>

using gridshell::render::short_svg;

namespace {

const std::string stroke =
    "fill:none;stroke-width:1.4;stroke-linecap:butt;stroke-linejoin:round;"
    "stroke:rgb(26.666668%,46.666667%,66.666669%);stroke-opacity:1;stroke-miterlimit:10;";

}  // namespace

TEST_CASE("strokes of one style are one path of short numbers") {
  const std::string svg = "<g>\n<path style=\"" + stroke +
                          "\" d=\"M 1.234567 2 L 3.5 -0.001 L 4 5.1 \"/>\n<path style=\"" + stroke +
                          "\" d=\"M 7 8 L 9 10 \"/>\n</g>\n";
  CHECK(short_svg(svg) ==
        "<g>\n<path style=\"fill:none;stroke-width:1.4;stroke-linejoin:round;stroke:#4477aa\" "
        "d=\"M1.23 2 3.5 0 4 5.1M7 8 9 10\"/>\n</g>\n");
}

TEST_CASE("what is filled and stroked, or lets shine through, stays by itself") {
  for (const std::string& style :
       {std::string("fill:rgb(0%,0%,0%);stroke:rgb(100%,0%,0%);"), stroke + "fill-opacity:0.5;"}) {
    const std::string path = "<path style=\"" + style + "\" d=\"M 1 2 L 3 4 \"/>\n";
    const std::string found = short_svg(path + path);
    CHECK(found.find("<path", found.find("<path") + 1) != found.npos);
  }
}

TEST_CASE("curves keep their letters, a closed path loses the move that follows it") {
  const std::string svg =
      "<path style=\"stroke:none;\" d=\"M 1 2 C 3 4 5 6 7 8 L 9 9 C 1 1 2 2 3 3 Z M 1 2 \" "
      "transform=\"matrix(2,0,0,2,0,0)\"/>\n";
  CHECK(short_svg(svg) ==
        "<path style=\"stroke:none\" d=\"M1 2C3 4 5 6 7 8L9 9C1 1 2 2 3 3Z\" "
        "transform=\"matrix(2,0,0,2,0,0)\"/>\n");
}

TEST_CASE("text and pictures stay as they are") {
  const std::string svg = "<text x=\"1.23456\">a</text>\n<image d=\"M 1.23456\"/>\n";
  CHECK(short_svg(svg) == svg);
}
