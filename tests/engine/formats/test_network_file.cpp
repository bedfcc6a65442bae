// Networks of rods in files: three formats, and all that may be wrong.
#include "engine/formats/network_file.h"

#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

void wrong(const std::string& bytes, const std::string& name, const std::string& reason) {
  CHECK_THAT(refusal(read_network(bytes, name)), Catch::Contains(reason));
}

void same(const NetworkData& a, const NetworkData& b) {
  CHECK(a.points == b.points);
  CHECK(a.rods == b.rods);
  CHECK(a.diameters == b.diameters);
  CHECK(a.own.size() == b.own.size());
  for (std::size_t k = 0; k < std::min(a.own.size(), b.own.size()); ++k)
    CHECK((a.own[k].rod == b.own[k].rod && a.own[k].key == b.own[k].key &&
           a.own[k].value == b.own[k].value));
  CHECK(a.supports == b.supports);
  CHECK(a.springs == b.springs);
  CHECK(a.free == b.free);
}

const std::string crossed = R"({
  "points_mm": [[-10, 0], [10, 0], [0, -10], [0, 10], [0, 0], [0.0005, 0]],
  "rods": [
    [0, 4, 1],
    {"points": [2, [0.0005, 0], [0, 10]], "diameter_mm": 0.5, "young_GPa": 70, "as_drawn": false}
  ],
  "supports": [
    {"point": 0, "to_mm": [-8, 0, 1], "spring_N_per_mm": [2, 0.125, 0]},
    {"point": [10, 0], "spring_N_per_mm": 3},
    {"point": 3, "to_mm": "free"}
  ]
})";

std::string with(const std::string& from, const std::string& to) {
  auto text = crossed;
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a network in JSON: points by number or position, nearby ones are one") {
  const auto read = value_of(read_network(crossed, "net.json"));
  CHECK(read.points.size() == 6);
  CHECK(read.rods == std::vector<std::vector<int>>{{0, 4, 1}, {2, 4, 3}});
  CHECK(read.diameters == std::vector<double>{0, 0.5});
  REQUIRE(read.own.size() == 2);
  CHECK((read.own[1].rod == 1 && read.own[1].key == "young_GPa" && read.own[1].value == 70));
  CHECK(read.supports == Points{{0, -8, 0, 1}, {1}});
  CHECK(read.springs == Points{{0, 2, 0.125, 0}, {1, 3, 3, 3}});
  CHECK(read.free == std::vector<int>{3});
}

TEST_CASE("a network comes through a preset's text unchanged") {
  Preset p;
  p.footprint.kind = FootprintKind::network;
  p.footprint.file = value_of(read_network(crossed, "net.json"));
  const auto read = good(to_toml(p));
  same(read.base.footprint.file, p.footprint.file);
}

TEST_CASE("drawings: rods are joined where they cross or touch, a ring ends where it begins") {
  const std::string obj =
      "# square\nv -10 0 0\nv 10 0 0\nv 0 -10 0\nv 0 10 0\nl 1 2\nl 3 4\nf 1 2 3\n"
      "v 5 0 0\nv 5 5 0\nl -2 -1\nv 20 0 0\nv 30 0 0\nv 30 9 0\nl 7 8 9 7\n";
  const auto lines = value_of(read_network(obj, "net.obj"));
  CHECK(lines.rods == std::vector<std::vector<int>>{{0, 9, 4, 1}, {2, 9, 3}, {4, 5}, {6, 7, 8, 6}});
  CHECK(lines.points.back() == std::vector<double>{0, 0, 0});

  const std::string dxf =
      "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nrods\n10\n-10\n20\n0\n30\n0\n11\n10\n21\n0\n31\n0\n"
      "0\nLWPOLYLINE\n8\nrods\n90\n1000000000\n70\n0\n10\n0\n20\n-10\n10\n0\n20\n10\n"
      "0\nPOLYLINE\n8\nrods\n66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n0\nVERTEX\n8\nrods\n10\n20\n20\n0\n"
      "0\nVERTEX\n8\nrods\n10\n30\n20\n0\n0\nVERTEX\n8\nrods\n10\n30\n20\n9\n0\nSEQEND\n"
      "0\nLINE\n8\nlabels\n10\n0\n20\n0\n11\n99\n21\n99\n0\nENDSEC\n0\nEOF\n";
  const auto drawn = value_of(read_network(dxf, "net.dxf"));
  CHECK(drawn.rods == std::vector<std::vector<int>>{{0, 7, 1}, {2, 7, 3}, {4, 5, 6, 4}});
}

TEST_CASE("drawings in space: rods that pass over one another are not joined") {
  // two lines of an upright plane, one that crosses both, and one that passes them 1 mm off
  const auto read = value_of(
      read_network("v 0 0 0\nv 0 4 4\nv 0 0 4\nv 0 4 0\nl 1 2\nl 3 4\nv -5 2 2\nv 5 2 2\nl 5 6\n"
                   "v -5 2 3\nv 5 2 3\nl 7 8\n",
                   "net.obj"));
  REQUIRE(read.points.size() == 9);
  CHECK(read.points[8] == std::vector<double>{0, 2, 2});
  CHECK(read.rods == std::vector<std::vector<int>>{{0, 8, 1}, {2, 8, 3}, {4, 8, 5}, {6, 7}});
}

// more of JSON: tests/engine/scene/test_network_damage.cpp
TEST_CASE("files of networks that are broken say where") {
  const auto changed = [](const char* here, const char* to, const char* reason) {
    wrong(with(here, to), "n.json", reason);
  };
  wrong("", "n.json", "n.json:1: got an empty file");
  wrong("{\n\"rods\": [\n[0, 1,]]}", "n.json", "n.json:3: got no JSON");
  wrong("[1, 2]", "n.json", "expected an object");
  wrong("{}", "n.json", "got no rods");
  changed("\"rods\"", "\"rod\"", "did you mean 'rods'");
  changed("\"points_mm\"", "\"points\"", "did you mean 'points_mm'");
  changed("[-10, 0]", "[-10, 1e10]", "n.json:2: points_mm[0]: got a coordinate");
  changed("[-10, 0]", "[-10, \"0\"]", "n.json:2: points_mm[0]: got [-10,\"0\"], expected a point");
  changed("[0, 4, 1]", "[0, 4, 1000000000]", "n.json:4: rods[0]: got a point");
  changed("[0, 4, 1]", "[0, -1]", "got point -1, expected 0");
  changed("[0, 4, 1]", "[0]", "n.json:4: rods[0]: got a rod of one point");
  changed("[0, 4, 1]", "[4, [0, 0.0005]]", "a rod of one point");
  changed("[0, 4, 1]", "[0, 5, 1]",
          "n.json:4: rods[0]: got point 5 at the position of point 4, expected that number");
  changed("\"point\": 3", "\"point\": 5", "n.json:10: supports[2]: got point 5 at the position");
  changed("[0, 4, 1]", "[0, 4, 4, 1]", "n.json:4: rods[0]: got a segment of no length");
  changed("[0, 4, 1]", "[0, 4, [0, 0], 1]", "and point 4 follows itself");
  changed("[0, 4, 1]", "[]", "a rod of one point");
  changed("[0, 4, 1]", "[[[[[[[[[[1]]]]]]]]]]", "rods[0]");
  changed("0.5,", "-1,", "n.json:5: rods[1]");
  changed("0.5,", "1e300,", "a diameter of 1e+300");
  changed("\"point\": 0,", "\"point\": 9,", "n.json:8: supports[0]: got a point");
  changed("\"point\": 0,", "", "n.json:8: supports[0]: got {");
  changed("[-8, 0, 1]", "[-8, 0]", "to_mm: got [-8,0], expected [x, y, z]");
  changed("mm\": 3", "mm\": 0", "n.json:9: supports[1]: a spring of 0 N/mm");
  changed("mm\": 3", "mm\": 1e7", "a spring of 1e+07 N/mm");
  changed("mm\": 3", "mm\": [3, 3]", "spring_N_per_mm: got [3,3], expected a number, or [kx");
  changed("mm\": 3", "mm\": \"soft\"", "spring_N_per_mm: got \"soft\", expected a number");
  changed("\"spring_N_per_mm\": 3", "\"spring\": 3", "n.json:9: supports[1]: got {");
  changed("\"free\"", "\"free\", \"spring_N_per_mm\": 1",
          "n.json:10: supports[2]: an end that is free has no spring_N_per_mm");
  wrong("v 0 0\nl 1 2\n", "n.obj", "n.obj:1: expected a vertex");
  wrong("v 0 0 nan\n", "n.obj", "n.obj:1: expected a vertex");
  wrong("v 0 0 0\nl 1 2\n", "n.obj", "n.obj:2: got point 1, expected 0 to 0");
  wrong("v 0 0 0\nv 1 0 0\nl 1 x\n", "n.obj", "n.obj:3: got 'x', expected the number");
  wrong("v 0 0 0\nv 9 0 0\nv 9 0 0\nl 1 2 3\n", "n.obj", "n.obj:4: got a segment of no length");
  wrong("v 0 0 0\n", "n.obj", "got no rods");
  wrong("hello\nworld\n", "n.dxf", "n.dxf:1: got no DXF");
  wrong("", "n.dxf", "got no rods");
  wrong("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nnan\n", "n.dxf",
        "n.dxf:8: expected a finite number");
  wrong("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n1\n20\n1\n11\n1\n21\n1\n0\nENDSEC\n", "n.dxf",
        "n.dxf:6: got a rod of one point");
  wrong(
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n10\n1\n20\n1\n10\n1\n20\n1\n10\n9\n20\n1\n0\nENDSEC"
      "\n",
      "n.dxf", "n.dxf:6: got a segment of no length");
  wrong("x", "n.txt", "ends in .json");
}

TEST_CASE("a network is needed, and what names rods of a square grid is refused") {
  const auto message = [](const std::string& keys) {
    return errors_of("[footprint]\nkind = \"network\"\n" + keys);
  };
  const std::string file =
      "file = {points_mm = [[-9, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 0]], "
      "rods = [[0, 3, 1], [3, 2]]}\n";
  CHECK(message(file) == "none");
  CHECK(message("").find("needs rods") != std::string::npos);
  CHECK(message("file = \"none.json\"\n").find("none.json") != std::string::npos);
  const auto sprung = [&](const std::string& rows) {
    return message(file.substr(0, file.size() - 2) + ", supports_mm = [[0]], springs_N_per_mm = [" +
                   rows + "]}\n");
  };
  CHECK(sprung("[0, 1, 1, 0.5]") == "none");
  CHECK(sprung("[0, 1, 1]").find("[point, kx, ky, kz]") != std::string::npos);
  CHECK(sprung("[1, 1, 1, 1]").find("expected a support") != std::string::npos);
  CHECK(sprung("[0, 0, 0, 0]").find("supports nothing") != std::string::npos);
  CHECK(message(file + "spacing_mm = 30.0\n").find("spacing_mm") != std::string::npos);
  CHECK_THAT(message("file = {points_mm = [[0, 0, 0]], rods = [[0, 1]]}\n"),
             Catch::Contains("rods[0]: got point 1, expected 0 to"));
  CHECK_THAT(message(file + "[rod]\ntable = [[\"u\", 0, 0.3]]\n"), Catch::Contains("square grid"));
}
