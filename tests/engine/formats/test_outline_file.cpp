#include "engine/formats/outline_file.h"

#include <cmath>

#include "tests/engine/formats/drawn_dxf.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;
using Catch::Contains;

namespace {

struct Outline {
  Eigen::Vector2d low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  double area = 0;
  std::string text;
};

/// Reads an outline: its extent, its area and the text of the report.
Outline outline(const std::string& text, const std::string& name,
                const NetworkOptions& options = {}) {
  FileReport report;
  const NetworkData data = value_of(read_outline(text, name, options, &report));
  REQUIRE(data.rods.size() == 1);
  REQUIRE(data.rods[0].front() == data.rods[0].back());
  CHECK(network_error(data).empty());
  Outline found;
  for (std::size_t k = 0; k + 1 < data.rods[0].size(); ++k) {
    const Eigen::Vector2d a = position_of(data, data.rods[0][k]).head<2>(),
                          b = position_of(data, data.rods[0][k + 1]).head<2>();
    found.low = found.low.cwiseMin(a), found.high = found.high.cwiseMax(a);
    found.area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  found.area = std::abs(found.area);
  found.text = report.text;
  return found;
}

std::string refused(const std::string& text, const std::string& name) {
  return refusal(read_outline(text, name, {}, nullptr));
}

std::string dxf(const std::string& entities) {
  return drawn_dxf(entities, section("HEADER", "9\n$INSUNITS\n70\n4\n"));
}

std::string line_dxf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return entity("LINE", fmt::format("8 0 10 {} 20 {} 11 {} 21 {}", a.x(), a.y(), b.x(), b.y()));
}

std::string arc_dxf(const Eigen::Vector2d& middle, double radius, double from, double to) {
  return entity("ARC", fmt::format("8 0 10 {} 20 {} 40 {} 50 {} 51 {}", middle.x(), middle.y(),
                                   radius, from, to));
}

std::string svg(const std::string& inner, const std::string& size = "width=\"200mm\"") {
  return "<?xml version=\"1.0\"?>\n<!-- <path d=\"x\"/> -->\n<svg xmlns=\"http://x/\" " + size +
         " viewBox=\"0 0 200 100\">" + inner + "</svg>";
}

}  // namespace

TEST_CASE("the commands of an SVG path close an outline, relative or not") {
  // a stadium: two straight sides of 100 mm, two half circles of radius 50 mm
  const double stadium = 100 * 100 + M_PI * 50 * 50;
  for (const char* path : {"M50,0H150A50 50 0 0 1 150 100L50,100A50,50,0,0,1,50,0Z",
                           "m50 0h100a50 50 0 01 0 100l-100 0a50 50 0 0 1 0-100z"}) {
    const Outline found = outline(svg("<path d=\"" + std::string(path) + "\"/>"), "a.svg");
    CHECK(found.area == Approx(stadium).epsilon(1e-3));
    CHECK(found.high.x() - found.low.x() == Approx(200));
    CHECK_THAT(found.text, Contains("200 x 100 mm") && Contains("200mm wide as it says"));
  }
  // the area under one cubic and under one quadratic curve, by their control polygons
  CHECK(outline(svg("<path d=\"M0 0 C 0 60 100 60 100 0 Z\"/>"), "a.svg").area ==
        Approx(0.6 * 60 * 100).epsilon(1e-3));
  CHECK(outline(svg("<path d=\"M0 0 Q 50 60 100 0 Z\"/>"), "a.svg").area ==
        Approx(2.0 / 3 * 100 * 30).epsilon(1e-3));
  // smooth commands continue with the mirrored control point
  CHECK(outline(svg("<path d=\"M0 0 Q 25 30 50 0 T 100 0 L 100 50 H 0 z\"/>"), "a.svg").area ==
        Approx(5000).epsilon(1e-3));
}

TEST_CASE("shapes of an SVG have their transforms, what is not drawn does not count") {
  const Outline found = outline(
      svg("<defs><rect width=\"500\" height=\"500\"/></defs>"
          "<g transform=\"translate(10 20) scale(2)\"><rect width=\"30\" height=\"20\"/></g>"
          "<circle cx=\"5\" cy=\"5\" r=\"5\"/><g style=\"display: none\"><circle r=\"400\"/></g>"
          "<text>terrace</text>"),
      "a.svg");
  CHECK(found.area == Approx(60 * 40));
  CHECK(found.low.isApprox(Eigen::Vector2d(10, -60)));
  CHECK_THAT(found.text, Contains("the largest of 2 closed lines; not used: 1 text"));
  CHECK(outline(svg("<ellipse rx=\"40\" ry=\"20\"/>", "width=\"20cm\""), "a.svg").area ==
        Approx(M_PI * 40 * 20).epsilon(1e-3));
  // a quoted ">" ends no tag
  CHECK(outline(svg("<rect aria-label=\"a>b\" width='30' height=\"20\"/>"), "a.svg").area ==
        Approx(600));
  // without a unit a pixel is 1/96 inch, and file_unit is believed
  const std::string bare = svg("<polygon points=\"0,0 96,0 96,96 0 96\"/>", "");
  CHECK(outline(bare, "a.svg").high.x() == Approx(25.4));
  CHECK(outline(bare, "a.svg", {.unit_mm = 1000}).high.x() == Approx(96000));
}

TEST_CASE("lengths of an SVG have their units, lengths relative to something else are refused") {
  const auto size = [](const std::string& text) {
    const Outline found = outline(text, "a.svg");
    return Eigen::Vector2d(found.high - found.low);
  };
  const auto sized = [](const std::string& attributes, const std::string& shape) {
    return "<svg " + attributes + ">" + shape + "</svg>";
  };
  const std::string rect = "<rect width=\"400\" height=\"320\"/>";
  const double pixel = 25.4 / 96;
  // the width is that of the sheet: only a viewBox relates it to the numbers of the shapes
  CHECK(size(sized("width=\"200mm\" height=\"160mm\"", rect))
            .isApprox(pixel * Eigen::Vector2d(400, 320)));
  CHECK(size(sized("width=\"200mm\" viewBox=\"0 0 400 320\"", rect))
            .isApprox(Eigen::Vector2d(200, 160)));
  CHECK(size(sized("width=\"800\" viewBox=\"0 0 400 320\"", rect))
            .isApprox(pixel * Eigen::Vector2d(800, 640)));
  // the drawing is as large as both sides permit
  CHECK(size(sized("width=\"400mm\" height=\"80mm\" viewBox=\"0 0 400 320\"", rect))
            .isApprox(Eigen::Vector2d(100, 80)));
  // a millimetre is 96/25.4 units of the viewBox
  const std::string units = "<rect x=\"1in\" width=\"100mm\" height=\"6pc\"/>";
  CHECK(size(sized("", units)).isApprox(Eigen::Vector2d(100, 25.4)));
  CHECK(size(svg(units)).isApprox(Eigen::Vector2d(100, 25.4) / pixel));
  CHECK(size(svg("<circle r=\"10mm\"/>")).isApprox(Eigen::Vector2d(20, 20) / pixel));
  CHECK_THAT(refused(svg("\n<rect width=\"50%\" height=\"3\"/>"), "a.svg"),
             Contains("a.svg:4: <rect> has width = \"50%\", expected a number or a length in mm") &&
                 Contains("convert the shape to a path"));
  CHECK_THAT(refused(svg("<svg viewBox=\"0 0 1 1\">" + rect + "</svg>"), "a.svg"),
             Contains("a.svg:3: got an <svg> within an <svg>, expected one: ungroup it"));
  CHECK(size(svg("<svg>" + rect + "</svg>")).isApprox(Eigen::Vector2d(400, 320)));
}

TEST_CASE("hidden shapes of an SVG do not count, whatever hides them") {
  const std::string seen = "<rect width=\"30\" height=\"20\"/>";
  const auto area = [&](const std::string& other) {
    return outline(svg(seen + other), "a.svg").area;
  };
  const std::string wide = " width=\"90\" height=\"90\"/>";
  for (const std::string shape :
       {"<rect visibility=\"hidden\"", "<rect style=\"fill:none; visibility : collapse\"",
        "<rect style=\"display:\nnone\"",
        "<style>.a{fill:red} .b, .c {display:none}</style><rect class=\"a c\"",
        "<style><![CDATA[/* a */ #own { visibility: hidden }]]></style><rect id=\"own\""})
    CHECK(area(shape + wide) == Approx(600));
  CHECK(area("<rect class=\"late\"" + wide + "<style>.late{display:none}</style>") == Approx(600));
  for (const std::string shape :
       {"<rect visibility=\"visible\"", "<rect display=\"none\" style=\"display:inline\"",
        "<style>.b{display:none}</style><rect class=\"a\"",
        "<style>@media print{*{fill:red}} g > path{fill:red}</style><rect"})
    CHECK(area(shape + wide) == Approx(8100));
  // visibility is inherited, and a part of a hidden group may be visible
  const auto group = [&](const std::string& inner) {
    return area("<g visibility=\"hidden\"><rect" + inner + wide + "</g>");
  };
  CHECK(group("") == Approx(600));
  CHECK(group(" visibility=\"visible\"") == Approx(8100));
  CHECK_THAT(refused(svg(seen + "<style>g > rect{display:none}</style>"), "a.svg"),
             Contains("a.svg:3: <style> may hide or move shapes by \"g > rect\", expected"));
}

TEST_CASE("lines of a drawing that meet end to end are one outline, in any order") {
  // a stadium of two lines and two arcs, one line drawn in reverse
  const std::string pieces = line_dxf({100, 0}, {0, 0}) + arc_dxf({0, 60}, 60, 90, 270) +
                             line_dxf({0, 120}, {100, 120}) + arc_dxf({100, 60}, 60, 270, 90);
  const double stadium = 100 * 120 + M_PI * 60 * 60;
  const Outline found = outline(dxf(pieces), "a.dxf");
  CHECK(found.area == Approx(stadium).epsilon(1e-3));
  CHECK_THAT(outline(dxf(pieces + line_dxf({300, 0}, {400, 0})), "a.dxf").text,
             Contains("in addition to 1 open line"));
  const std::string open =
      line_dxf({100, 0}, {0, 0}) + line_dxf({0, 0}, {50, 100}) + line_dxf({50.5, 100}, {100, 0});
  CHECK_THAT(refused(dxf(open), "a.dxf"),
             Contains("no closed outline: 1 open line, the smallest gap 0.5 mm"));
  CHECK(outline(dxf(open), "a.dxf", {.join_mm = 0.6}).area == Approx(5000).epsilon(0.01));
}

TEST_CASE("an OBJ is an outline by its lines, else by its faces") {
  const std::string points = "v 0 0 0\nv 10 0 0\nv 10 10 3\nv 0 10 0\n";
  CHECK(outline(points + "l 1 2 3 4 1\n", "a.obj").area == Approx(100));
  CHECK(outline(points + "f 1 2 3 4\n", "a.obj").area == Approx(100));
  CHECK_THAT(refused(points + "l 1 2 9\n", "a.obj"), Contains("got vertex 9"));
}

TEST_CASE("coordinates that cannot be computed with are refused") {
  const char* large = "got a coordinate that is too large, expected at most 1e9 mm";
  CHECK_THAT(refused("v 0 0 0\nv 1e200 0 0\nl 1 2\n", "a.obj"), Contains(large));
  CHECK_THAT(refused("v 0 0 0\nv 2e9 0 0\nl 1 2\n", "a.obj"), Contains(large));
  CHECK_THAT(refused(svg("<path d=\"M0 0 A 1 1 0 0 1 1e200 1e200\"/>"), "a.svg"), Contains(large));
  CHECK_THAT(refused(svg("<path d=\"M0 0 L 1 2\"/>", "width=\"0mm\""), "a.svg"),
             Contains("1 open line"));
}

TEST_CASE("many lines take time in proportion to their number") {
  // the pieces of a polygon in mixed order, each in a line of its own
  constexpr int sides = 40000, step = 10007;
  std::string pieces;
  for (int k = 0; k < sides; ++k) {
    const auto at = [](int n) { return 2 * M_PI * n / sides; };
    const int n = int(std::int64_t(k) * step % sides);
    pieces += fmt::format("<line x1=\"{:.9f}\" y1=\"{:.9f}\" x2=\"{:.9f}\" y2=\"{:.9f}\"/>\n",
                          900 * std::cos(at(n)), 900 * std::sin(at(n)), 900 * std::cos(at(n + 1)),
                          900 * std::sin(at(n + 1)));
  }
  CHECK(outline(svg(pieces), "a.svg", {.join_mm = 1e-4}).area ==
        Approx(M_PI * 900 * 900).epsilon(1e-6));
}

TEST_CASE("an SVG in UTF-16 is read") {
  const std::string text = svg("<rect width=\"30\" height=\"20\"/>");
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide.append({c, '\0'});
  CHECK(outline(wide, "a.svg").area == Approx(600));
}

TEST_CASE("what is no outline is refused with its position") {
  CHECK_THAT(refused("<html/>", "a.svg"), Contains("a.svg: got no <svg>"));
  CHECK_THAT(refused(svg("\n<path d=\"M 0 0 L 5\"/>"), "a.svg"),
             Contains("a.svg:4: <path> has a 'L' with fewer numbers than 2"));
  CHECK_THAT(refused(svg("<path d=\"M0 0 X 5\"/>"), "a.svg"), Contains("a command 'X'"));
  CHECK_THAT(refused(svg("<g transform=\"fold(3)\"/>"), "a.svg"), Contains("is not understood"));
  CHECK_THAT(refused(svg(""), "a.svg"), Contains("no closed outline, and no line"));
  CHECK_THAT(refused(svg("<path d=\"M0 0 H9 H4 z\"/>"), "a.svg"),
             Contains("no closed outline: 1 closed line without area"));
  CHECK_THAT(refused("<svg", "a.svg"), Contains("a tag does not end"));
  CHECK_THAT(refused("", "plan.pdf"), Contains("ends in .dxf, .svg or .obj"));
}
