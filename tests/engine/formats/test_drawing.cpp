// Drawings to scale: the file has the drawn numbers, to the digit.
#include <catch2/catch.hpp>

#include "engine/formats/drawing.h"

using namespace gridshell::exports;

namespace {

Drawing small_drawing() {
  Layer rods{"rods", 7}, holes{"holes", 1};
  rods.lines.push_back({{{0, 0, 0}, {100, 50.123456, 0}}});
  rods.lines.push_back({{{0, 0, 0}, {1, 0, 2}, {1, 1, 3}}, true});
  holes.circles.push_back({{10, -20}, 2.5});
  holes.texts.push_back({{5, 5}, 3, "u+1 <&"});
  return {"a & b", {rods, holes}};
}

}  // namespace

TEST_CASE("a drawing as SVG has its true size and nothing that XML takes for itself") {
  const std::string svg = to_svg(small_drawing());
  // from the text, which is at most 18 mm wide, to the end of the line, and margins
  CHECK_THAT(svg, Catch::Contains("width=\"114.000000mm\""));
  CHECK_THAT(svg,
             Catch::Contains("<polyline points=\"0.000000,-0.000000 100.000000,-50.123456\"/>"));
  CHECK_THAT(svg, Catch::Contains("<polygon points="));
  CHECK_THAT(svg, Catch::Contains("<circle cx=\"10.000000\" cy=\"20.000000\" r=\"2.500000\"/>"));
  CHECK_THAT(svg, Catch::Contains("a &amp; b"));
  CHECK_THAT(svg, Catch::Contains(">u+1 &lt;&amp;</text>"));
  CHECK_THAT(svg, Catch::Contains("<g id=\"holes\""));
}

TEST_CASE("a drawing as DXF has a line, a closed polyline in space, a circle and a text") {
  const std::string dxf = to_dxf(small_drawing());
  CHECK(dxf.starts_with("  0\nSECTION\n  2\nHEADER\n"));
  CHECK(dxf.ends_with("  0\nENDSEC\n  0\nEOF\n"));
  CHECK_THAT(dxf, Catch::Contains("$INSUNITS\n 70\n4\n"));
  CHECK_THAT(
      dxf, Catch::Contains("LINE\n  8\nrods\n 10\n0.000000000\n 20\n0.000000000\n 30\n0.000000000\n"
                           " 11\n100.000000000\n 21\n50.123456000\n"));
  // closed and in space
  CHECK_THAT(
      dxf, Catch::Contains("POLYLINE\n  8\nrods\n 66\n1\n 10\n0.000000000\n 20\n0.000000000\n 30\n"
                           "0.000000000\n 70\n9\n"));
  CHECK_THAT(dxf, Catch::Contains("CIRCLE\n  8\nholes\n 10\n10.000000000\n 20\n-20.000000000\n"));
  CHECK_THAT(dxf, Catch::Contains("  1\nu+1 <&\n"));
}

TEST_CASE("an empty drawing is still a drawing") {
  CHECK_THAT(to_svg({"nothing", {}}), Catch::Contains("</svg>"));
  CHECK_THAT(to_dxf({"nothing", {}}), Catch::Contains("EOF"));
}
