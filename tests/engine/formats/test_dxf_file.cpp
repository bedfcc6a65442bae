// Contents of a DXF drawing: every entity is a curve, a mark, or refused.
#include "engine/formats/dxf_file.h"

#include "tests/engine/formats/drawn_dxf.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

DxfDrawing read(const std::string& entities, const std::string& before = "") {
  return value_of(read_dxf(drawn_dxf(entities, before), "d.dxf"));
}

DrawnEntity only(const std::string& entities, const std::string& before = "") {
  auto drawing = read(entities, before);
  REQUIRE(drawing.entities.size() == 1);
  return drawing.entities[0];
}

/// Largest distance of a curve's points from a circle about the origin.
double off_circle(const DrawnEntity& curve, double radius) {
  double off = 0;
  for (const Eigen::Vector3d& point : curve.points)
    off = std::max(off, std::abs(point.norm() - radius));
  return off;
}

}  // namespace

TEST_CASE("arcs, circles, ellipses and bulges are polylines on their curves") {
  const auto arc = only(entity("ARC", "10 0 20 0 40 50 50 350 51 20"));
  CHECK(arc.points.size() == 31);
  CHECK(off_circle(arc, 50) < 1e-12);
  CHECK(arc.points.back().y() == Approx(50 * std::sin(20 * std::numbers::pi / 180)));
  CHECK_FALSE(arc.closed);
  const auto circle = only(entity("CIRCLE", "10 0 20 0 40 50"));
  CHECK(circle.points.size() == 360);
  CHECK(circle.closed);
  const auto ellipse =
      only(entity("ELLIPSE", "10 0 20 0 11 40 21 0 40 0.5 41 0 42 3.141592653589793"));
  CHECK(ellipse.points[90].isApprox(Eigen::Vector3d(0, 20, 0), 1e-9));
  const auto bulge = only(entity("LWPOLYLINE", "90 2 70 0 10 -50 20 0 42 1 10 50 20 0"));
  CHECK(off_circle(bulge, 50) < 1e-9);
  // left of a line is up: an arc to its right goes down
  CHECK(bulge.points[90].isApprox(Eigen::Vector3d(0, -50, 0), 1e-9));
  CHECK(bulge.sampled.front() == 0);
  CHECK(bulge.sampled[1] == 1);
}

TEST_CASE("splines: by control points, with weights, and through points") {
  // a quarter of a circle as a rational spline of the second degree
  const auto quarter = only(
      entity("SPLINE",
             "70 4 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.7071067811865476 41 1 "
             "10 50 20 0 30 0 10 50 20 50 30 0 10 0 20 50 30 0"));
  CHECK(off_circle(quarter, 50) < 1e-9);
  CHECK(quarter.points.size() > 60);
  const auto straight =
      only(entity("SPLINE", "71 3 74 3 11 -60 21 -58 31 0 11 0 21 2 31 0 11 58 21 60 31 0"));
  CHECK(straight.points.back() == Eigen::Vector3d(58, 60, 0));
  for (const Eigen::Vector3d& point : straight.points) CHECK(point.y() == Approx(point.x() + 2));
  const auto wave =
      only(entity("SPLINE", "71 3 74 3 11 0 21 0 31 0 11 10 21 5 31 0 11 20 21 0 31 0"));
  CHECK(std::ranges::find(wave.points, Eigen::Vector3d(10, 5, 0)) != wave.points.end());
  CHECK(only(entity("SPLINE", "71 3 72 2 73 1 40 0 40 1 10 0 20 0 30 0")).use ==
        EntityUse::refused);
}

TEST_CASE("polylines of all kinds, in planes that are turned") {
  const auto turned =
      only(entity("LWPOLYLINE", "90 2 70 1 38 5 210 0 220 0 230 -1 10 1 20 2 10 3 20 4"));
  CHECK(turned.points[0].isApprox(Eigen::Vector3d(-1, 2, -5)));
  CHECK(turned.closed);
  const std::string corners =
      entity("VERTEX", "10 0 20 0 30 1") + entity("VERTEX", "10 9 20 0 30 2");
  CHECK(only(entity("POLYLINE", "66 1 70 8") + corners + entity("SEQEND", "")).points[1].z() == 2);
  // the frame of a fitted spline is none of its points
  const auto fitted = only(entity("POLYLINE", "66 1 70 4") + entity("VERTEX", "70 16 10 5 20 99") +
                           entity("VERTEX", "70 8 10 0 20 0") + entity("VERTEX", "70 8 10 1 20 1") +
                           entity("SEQEND", ""));
  CHECK(fitted.points.size() == 2);
  CHECK(only(entity("POLYLINE", "66 1 70 64") + corners + entity("SEQEND", "")).use ==
        EntityUse::refused);
}

TEST_CASE("blocks are drawn where they are inserted, turned, scaled, in rows, one in another") {
  const std::string blocks = section(
      "BLOCKS",
      entity("BLOCK", "2 Bar 70 0 10 1 20 0 30 0") + entity("LINE", "8 0 10 1 20 0 11 3 21 0") +
          entity("ENDBLK", "") + entity("BLOCK", "2 two 70 0 10 0 20 0 30 0") +
          entity("INSERT", "8 0 2 bar 10 0 20 10") + entity("ENDBLK", "") +
          entity("BLOCK", "2 self 70 0 10 0 20 0") + entity("INSERT", "2 self") +
          entity("ENDBLK", "") + entity("BLOCK", "2 other 70 4 10 0 20 0") + entity("ENDBLK", ""));
  const auto bar = only(entity("INSERT", "8 Rods 2 BAR 10 5 20 6 41 2 50 90"), blocks);
  CHECK(bar.points[0].isApprox(Eigen::Vector3d(5, 6, 0)));
  CHECK(bar.points[1].isApprox(Eigen::Vector3d(5, 10, 0)));
  CHECK(bar.layer == "rods");
  const auto inner = only(entity("INSERT", "2 two 10 100 20 0"), blocks);
  CHECK(inner.points[1].isApprox(Eigen::Vector3d(102, 10, 0)));
  const auto rows = read(entity("INSERT", "2 bar 10 0 20 0 70 3 71 2 44 20 45 30"), blocks);
  REQUIRE(rows.entities.size() == 6);
  CHECK(rows.entities[5].points[0].isApprox(Eigen::Vector3d(40, 30, 0)));
  CHECK(only(entity("INSERT", "2 other 10 0 20 0"), blocks).use == EntityUse::refused);
  const auto refused = [&](const std::string& name) {
    return refusal(read_dxf(drawn_dxf(entity("INSERT", "2 " + name), blocks), "d.dxf"));
  };
  CHECK_THAT(refused("none"), Catch::Contains("INSERT of block 'none', which is not in the file"));
  CHECK_THAT(refused("self"), Catch::Contains("which contains itself"));
}

TEST_CASE("where an entity is, what it may be, and the unit of a drawing") {
  const std::string before = section("HEADER", "9\n$INSUNITS\n70\n1\n") +
                             section("TABLES", entity("LAYER", "2 Hidden 70 1 62 7") +
                                                   entity("LAYER", "2 Off 70 0 62 -3"));
  const auto drawing = read(
      entity("LINE", "8 A 10 0 20 0 11 1 21 0") + entity("LINE", "67 1 8 A 10 0 20 0 11 1 21 0") +
          entity("LINE", "8 HIDDEN 10 0 20 0 11 1 21 0") + entity("TEXT", "8 off 1 hello") +
          entity("POINT", "10 0 20 0") + entity("MLINE", "8 A") + entity("SOMETHING", "8 A"),
      before);
  REQUIRE(drawing.entities.size() == 7);
  CHECK(drawing.unit == "in");
  CHECK(drawing.unit_mm == 25.4);
  CHECK(drawing.entities[0].space == DrawingSpace::model);
  CHECK(drawing.entities[1].space == DrawingSpace::paper);
  CHECK(drawing.entities[2].space == DrawingSpace::hidden);
  CHECK(drawing.entities[3].space == DrawingSpace::hidden);
  CHECK(drawing.entities[4].use == EntityUse::mark);
  CHECK(drawing.entities[5].use == EntityUse::refused);
  CHECK(drawing.entities[6].use == EntityUse::refused);
  CHECK(read("").unit_mm == 0);
  CHECK(read("", section("HEADER", "9\n$INSUNITS\n70\n21\n")).unit_mm ==
        Approx(1200e3 / 3937));  // US survey foot
  for (const auto& [number, name, mm] : {std::tuple(15, "dam", 1e4), {17, "Gm", 1e12}}) {
    const auto far = read("", section("HEADER", fmt::format("9\n$INSUNITS\n70\n{}\n", number)));
    CHECK(far.unit == name);
    CHECK(far.unit_mm == mm);
  }
}

TEST_CASE("what is no whole drawing is refused") {
  const std::string whole = drawn_dxf(entity("LINE", "10 0 20 0 11 1 21 0"));
  const auto refused = [](const std::string& bytes) { return refusal(read_dxf(bytes, "d.dxf")); };
  CHECK(refused(whole) == "none");
  CHECK(refused(whole + "\x1a") == "none");
  CHECK(refused(whole + std::string(200, '\n')) == "none");
  CHECK(refused(whole.substr(0, whole.find("ENDSEC"))).ends_with("is it cut short?"));
  CHECK(refused(whole.substr(0, whole.find("11\n1") + 5)) ==
        "d.dxf: ends within its section ENTITIES: is it cut short?");
  CHECK(refused("AutoCAD Binary DXF\r\n\x1a") ==
        "d.dxf: got a binary DXF, expected text: save it as ASCII DXF");
  CHECK(refused("AC1032") == "d.dxf: got a DWG, expected a DXF: save it as one");
  CHECK(refused("hello\nworld\n") ==
        "d.dxf:1: got no DXF text, expected a code and a value in turn");
}
