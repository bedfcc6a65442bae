// Networks as drawings: which lines are rods, where rods are joined, and in which unit they are.
#include "engine/formats/network_file.h"
#include "engine/formats/outline_file.h"
#include "tests/engine/formats/drawn_dxf.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

std::string line(double x0, double y0, double x1, double y1, const std::string& layer = "0") {
  return entity("LINE", fmt::format("8 {} 10 {} 20 {} 11 {} 21 {}", layer, x0, y0, x1, y1));
}

/// Three rods along x and three along y, at distances of 20 mm.
std::string grid(const std::string& layer = "0") {
  std::string text;
  for (const int k : {-20, 0, 20}) text += line(-30, k, 30, k, layer) + line(k, -30, k, 30, layer);
  return text;
}

struct Read {
  NetworkData network;
  FileReport report;
};

Read read(const std::string& entities, const NetworkOptions& options = {},
          const std::string& before = "") {
  Read read;
  read.network =
      value_of(read_network(drawn_dxf(entities, before), "d.dxf", options, &read.report));
  return read;
}

std::string refused(const std::string& entities) {
  return refusal(read_network(drawn_dxf(entities), "d.dxf"));
}

/// The coordinates of a rod's points.
Points places(const NetworkData& network, std::size_t rod) {
  Points all;
  for (const int point : network.rods[rod]) all.push_back(network.points[std::size_t(point)]);
  return all;
}

std::string units(int number) {
  return section("HEADER", fmt::format("9\n$INSUNITS\n70\n{}\n", number));
}

}  // namespace

TEST_CASE("lines that meet end to end are one rod, in a drawing and as edges of a mesh") {
  const auto whole = read(grid());
  REQUIRE(whole.network.rods.size() == 6);
  std::string halves;
  for (const int k : {-20, 0, 20})
    halves += line(-30, k, 5, k) + line(30, k, 5, k) + line(k, -30, k, 7) + line(k, 7, k, 30);
  const auto broken = read(halves);
  REQUIRE(broken.network.rods.size() == 6);
  for (std::size_t r = 0; r < 6; ++r) CHECK(places(broken.network, r) == places(whole.network, r));
  CHECK_THAT(broken.report.text, Catch::Contains("12 lines, which meet end to end at 6 points"));

  const auto obj = [](const std::string& lines) {
    return value_of(
        read_network("v -30 0 0\nv -10 0 0\nv 10 0 0\nv 30 0 0\nv -10 -20 0\nv -10 20 0\n"
                     "v 10 -20 0\nv 10 20 0\n" +
                         lines,
                     "n.obj"));
  };
  const auto edges = obj("l 3 2\nl 1 2\nl 3 4\nl 5 2\nl 2 6\nl 7 3\nl 8 3\n");
  const auto rods = obj("l 1 2 3 4\nl 5 2 6\nl 7 3 8\n");
  REQUIRE(edges.rods.size() == 3);
  CHECK(edges.rods[0] == std::vector<int>{0, 1, 2, 3});
  CHECK(edges.rods[1] == rods.rods[1]);
  CHECK(edges.rods[2] == rods.rods[2]);
  // four arcs of a circle are a ring, lines that meet at a right angle are not one rod
  std::string arcs;
  for (const int k : {0, 90, 180, 270})
    arcs += entity("ARC", fmt::format("10 0 20 0 40 25 50 {} 51 {}", k, k + 90));
  const auto ring = read(grid() + arcs).network;
  REQUIRE(ring.rods.size() == 7);
  CHECK(ring.rods[6].front() == ring.rods[6].back());
  CHECK(read(line(0, 0, 10, 0) + line(10, 0, 10, 10) + line(0, 5, 20, 5)).network.rods.size() == 3);
}

TEST_CASE("a curve has as many points as it turns, and one at each crossing") {
  const auto arc = read(grid() + entity("ARC", "10 0 20 100 40 110 50 254 51 286")).network;
  REQUIRE(arc.rods.size() == 7);
  const Points points = places(arc, 6);
  int joints = 0;
  for (const auto& point : points) {
    CHECK(std::hypot(point[0], point[1] - 100) == Approx(110).epsilon(1e-4));
    for (const double x : {-20.0, 0.0, 20.0}) joints += std::abs(point[0] - x) < 1e-9;
  }
  CHECK(joints == 3);
  CHECK(points.size() >= 11);
  CHECK(points.size() <= 16);
  double shortest = INFINITY;
  for (std::size_t k = 1; k < points.size(); ++k)
    shortest = std::min(
        shortest, std::hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]));
  CHECK(shortest > 1);
}

TEST_CASE("layers, sheets and marks are left out by rules that are reported") {
  const std::string before =
      section("TABLES", entity("LAYER", "2 dims 70 1 62 7") + entity("LAYER", "2 aux 70 0 62 -7"));
  const auto shown = read(grid() + line(-30, -33, 30, 33, "dims") + line(-30, -33, 30, 33, "AUX") +
                              entity("LINE", "67 1 10 0 20 0 11 297 21 0") + entity("TEXT", "1 a") +
                              entity("MTEXT", "1 b") + entity("CIRCLE", "10 20 20 20 40 1.5"),
                          {}, before);
  CHECK(shown.network.rods.size() == 6);
  for (const char* part : {"2 lines on layers that are frozen or switched off",
                           "1 line of paper space", "2 texts", "1 circle that mark points of rods"})
    CHECK_THAT(shown.report.text, Catch::Contains(part));
  const auto layered = read(grid("RODS") + line(-30, -33, 30, 33) + entity("MLINE", "8 0"));
  CHECK(layered.network.rods.size() == 6);
  CHECK_THAT(layered.report.text, Catch::Contains("1 line, 1 mline on other layers than \"rods\""));
  CHECK(read(grid() + entity("CIRCLE", "10 0 20 0 40 25")).network.rods.size() == 7);
  CHECK(refused(grid() + entity("MLINE", "8 0")) ==
        "d.dxf:78: MLINE is not read, expected lines and polylines: explode it");
  CHECK_THAT(refused(grid() + line(-30, 0, 25, 0)),
             Catch::Contains("got a rod on the rod at d.dxf:"));
}

TEST_CASE("the unit is that of the key, else that of the drawing, else mm") {
  const auto width = [](const Read& read) {
    double low = 0, high = 0;
    for (const auto& point : read.network.points)
      low = std::min(low, point[0]), high = std::max(high, point[0]);
    return high - low;
  };
  CHECK(width(read(grid())) == 60);
  const auto inches = read(grid(), {}, units(1));
  CHECK(width(inches) == Approx(60 * 25.4));
  CHECK_THAT(inches.report.text, Catch::StartsWith("d.dxf: in in ($INSUNITS)"));
  CHECK(width(read(grid(), {.unit_mm = 10}, units(1))) == Approx(600));
  // metres that would make rods of 0.25 mm 60 m long are a program's default
  const auto likely = read(grid(), {.rod_mm = 0.25}, units(6));
  CHECK(width(likely) == 60);
  REQUIRE(likely.report.notes.size() == 1);
  CHECK_THAT(likely.report.notes[0], Catch::Contains("says that it is in m") &&
                                         Catch::Contains("; file_unit = \"m\" reads"));
  // units that file_unit does not have
  const auto yards = read(grid(), {.rod_mm = 0.25}, units(10));
  REQUIRE(yards.report.notes.size() == 1);
  CHECK_THAT(yards.report.notes[0],
             Catch::Contains("; file_unit = \"m\" with the drawing scaled by 0.9144 reads"));
  CHECK(width(read(grid(), {.rod_mm = 25}, units(6))) == Approx(60000));
  CHECK(value_of(read_network("v 0 0 0\nv 0.5 0 0\nl 1 2\n", "n.obj", {.unit_mm = 1000}))
            .points[1][0] == 500);
  CHECK_THAT(refusal(read_network("{}", "n.json", {.unit_mm = 1000})),
             Catch::Contains("expected file_unit"));
}

TEST_CASE("what is near and not joined is reported, and join_mm joins it") {
  // rods that fall 0.4 mm short of the outer ones, and one that was surveyed in two pieces
  const std::string loose = line(-20, -30, -20, 30) + line(20, -30, 20, 30) +
                            line(-30, -20, 30, -20) + line(-19.6, 0, 19.6, 0) +
                            line(-30, 20, -0.003, 20) + line(0.003, 20, 30, 20);
  const auto apart = read(loose);
  REQUIRE(apart.report.notes.size() == 1);
  CHECK_THAT(apart.report.notes[0], Catch::Contains("3 pairs of points lie nearer than a tenth") &&
                                        Catch::Contains("join_mm = 0.44"));
  const auto joined = read(loose, {.join_mm = 0.5});
  CHECK(joined.report.notes.empty());
  REQUIRE(joined.network.rods.size() == 5);
  CHECK_THAT(joined.report.text, Catch::Contains("5 rods, 6 joints, 8 supports"));
  CHECK(places(joined.network, 3).front() == std::vector<double>{-20, 0, 0});
  // also in a file of numbers
  const std::string twice = R"({"points_mm": [[-9, 0], [0, 0], [9, 0], [0, -9], [0.004, 0], [0, 9]],
    "rods": [[0, 1, 2], [3, 4, 5]]})";
  FileReport report;
  CHECK(value_of(read_network(twice, "n.json", {}, &report)).rods[1] == std::vector<int>{3, 4, 5});
  REQUIRE(report.notes.size() == 1);
  CHECK_THAT(report.notes[0], Catch::StartsWith("a pair of points lies nearer"));
  CHECK(value_of(read_network(twice, "n.json", {.join_mm = 0.01}, &report)).rods[1] ==
        std::vector<int>{3, 1, 5});
  CHECK(report.notes.empty());
}

TEST_CASE("the edges of a mesh are rods, those in line one, in OBJ, PLY and OFF") {
  // 3 x 2 squares of 20 mm, bent along x
  std::string vertices, faces;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 3; ++i)
      vertices += fmt::format("{} {} {}\n", 20 * i, 20 * j, 2 * i * (3 - i));
  std::string obj;
  for (const auto& row : {"1 2 6 5", "2 3 7 6", "3 4 8 7", "5 6 10 9", "6 7 11 10", "7 8 12 11"})
    obj += fmt::format("f {}\n", row);
  for (const auto& row : {"0 1 5 4", "1 2 6 5", "2 3 7 6", "4 5 9 8", "5 6 10 9", "6 7 11 10"})
    faces += fmt::format("4 {}\n", row);
  std::string rows = vertices;
  for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1) rows.insert(at, "v ");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
      "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string lone_edges =
      "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
      "property float z\nelement edge 3\nproperty int vertex1\nproperty int vertex2\n"
      "end_header\n";
  for (const auto& [text, name] : {std::pair(rows + obj, "q.obj"),
                                   {ply + vertices + faces, "q.ply"},
                                   {"OFF\n12 6 0 # remark\n" + vertices + faces, "q.off"}}) {
    FileReport report;
    const NetworkData network = value_of(read_network(text, name, {}, &report));
    REQUIRE(network.rods.size() == 7);
    std::vector<std::size_t> sizes;
    for (const auto& rod : network.rods) sizes.push_back(rod.size());
    CHECK(std::ranges::count(sizes, 4u) == 3);
    CHECK(std::ranges::count(sizes, 3u) == 4);
    CHECK_THAT(report.text, Catch::Contains("the edges of 6 faces (6 of four corners); rods of 17 "
                                            "edges, which meet in line at 10 points; 7 rods, "
                                            "8 joints"));
  }
  FileReport report;
  const auto edges =
      value_of(read_network(lone_edges + vertices + "0 1\n1 2\n1 5\n", "e.ply", {}, &report));
  CHECK(edges.rods.size() == 2);
  CHECK_THAT(report.text, Catch::Contains("rods of 3 edges"));
  // in metres
  CHECK(value_of(read_network(rows + obj, "q.obj", {.unit_mm = 1000})).points[1][0] == 20000);
  CHECK(refusal(read_network("OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 2\n", "q.off")) ==
        "q.off:5: got point 2, expected 0 to 1");
  CHECK_THAT(refusal(read_network("OFF\n2 1 0\n0 0 0\n", "q.off")),
             Catch::Contains("ends after 1 of its 2 vertices and 1 faces"));
  CHECK_THAT(refusal(read_network("2 x\n", "q.off")), Catch::Contains("no OFF"));
}

TEST_CASE("a polyline without points is no mark of a point, and no crash") {
  for (const char* kind : {"LWPOLYLINE", "POLYLINE"}) {
    const std::string empty = entity(kind, "8 0 66 1 70 0 90 0") + entity("SEQEND", "8 0");
    CHECK_THAT(refused(empty + line(0, 0, 30, 0)), Catch::Contains("d.dxf:"));
    CHECK_THAT(refusal(read_outline(drawn_dxf(empty + line(0, 0, 30, 0)), "d.dxf", {}, nullptr)),
               Catch::Contains("got no closed outline: 1 open line"));
  }
  // numbers outside the range of integers
  CHECK(read(grid(), {}, section("HEADER", "9\n$INSUNITS\n70\n1e300\n")).network.rods.size() == 6);
  CHECK_THAT(refused(entity("SPLINE", "8 0 71 1e300 10 0 20 0 10 9 20 0") + grid()),
             Catch::Contains("numbers of knots and points"));
  CHECK_THAT(
      refusal(read_network("OFF\n9223372036854775807 9223372036854775807 0\n0 0 0\n", "a.off")),
      Catch::Contains("a.off:2: got no OFF"));
}
