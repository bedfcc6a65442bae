// Surfaces in files: heights over a grid, meshes of three formats, and all that may be wrong.
#include <cstring>

#include "engine/formats/surface_file.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

void wrong(const std::string& bytes, const std::string& name, const std::string& reason) {
  CHECK_THAT(refusal(read_surface(bytes, name)), Catch::Contains(reason));
}

std::string heights() {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) text += std::to_string(i) + ",2." + std::to_string(j) + ",7\n";
  return text;
}

/// two triangles on a square, doubled vertices as STL has them
const std::string corners[] = {"0 0 0", "1 0 0", "1 1 0.5", "0 0 0", "1 1 0.5", "0 1 0"};

std::string stl_text() {
  std::string text = "solid square\n";
  for (int k = 0; k < 6; ++k) text += "  vertex " + corners[k] + "\n";
  return text + "endsolid\n";
}

std::string stl_bytes() {
  std::string bytes(80, ' ');
  const auto put = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  put(std::uint32_t(2));
  const float xyz[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  for (int k = 0; k < 6; ++k) {
    for (int n = 0; n < 3 && k % 3 == 0; ++n) put(0.0f);
    for (const float value : xyz[k]) put(value);
    if (k % 3 == 2) put(std::uint16_t(0));
  }
  return bytes;
}

const char* const ply_head =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string ply_text() {
  return std::string("ply\nformat ascii 1.0\ncomment a square\n") + ply_head +
         "0 0 0 9\n1 0 0 9\n1 1 0.5 9\n0 1 0 9\n4 0 1 2 3\n";
}

std::string ply_bytes(bool big) {
  std::string bytes = "ply\nformat " +
                      std::string(big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
                      ply_head;
  const auto put = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    if (big) std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof(value));
  };
  const float xyz[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  for (const auto& vertex : xyz) {
    for (const float value : vertex) put(value);
    put(std::uint8_t(9));
  }
  put(std::uint8_t(4));
  for (int k = 0; k < 4; ++k) put(k);
  return bytes;
}

const std::string obj =
    "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0.5 1 0 0\nvn 0 0 1\nv 0 1 0\nf 1/1/1 2//1 3 -1\n";

}  // namespace

TEST_CASE("every format gives the same square") {
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>("a.obj", obj),
                                    {"a.ply", ply_text()},
                                    {"a.PLY", ply_bytes(false)},
                                    {"b.ply", ply_bytes(true)},
                                    {"a.stl", stl_text()},
                                    {"b.stl", stl_bytes()}}) {
    INFO(name);
    const auto mesh = value_of(read_surface(bytes, name));
    CHECK(mesh.vertices == Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("every spelling of OBJ and STL gives the same square") {
  const auto upper = [](std::string text) {
    for (char& c : text) c = char(std::toupper((unsigned char)c));
    return text;
  };
  const std::string wrapped =
      "\xEF\xBB\xBFv 0\t0 0 # the first\nv 1 0 \\\n  0\nv 1 1 0.5 1 0 0\nv 0 1 0  \nf 1 2 \\\r\n 3 "
      "-1 # all\n";
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>("a.obj", wrapped),
                                    {"a.stl", upper(stl_text())},
                                    {"b.stl", "\xEF\xBB\xBF \n" + stl_text()}}) {
    INFO(name);
    const auto mesh = value_of(read_surface(bytes, name));
    CHECK(mesh.vertices == Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}});
  }
  CHECK(value_of(read_surface(obj, "a.obj", 1000)).vertices[2] ==
        std::vector<double>{1000, 1000, 500});
  CHECK(value_of(read_surface(heights(), "h.csv", 10)).z[0][0] == 70);
  wrong("v 1,5 0 0\n", "a.obj",
        "a.obj:1: expected a vertex of three numbers, v x y z, with decimal");
  wrong("v 0 0 0\nsurf 0 1 0 1\n", "a.obj", "a.obj:2: got 'surf', a free-form surface");
  wrong(stl_text().substr(0, stl_text().size() - 9), "a.stl", "is it cut short?");
}

TEST_CASE("heights come in any order, and a position without one is reported") {
  const auto grid = read_surface(heights(), "h.csv");
  REQUIRE(grid.has_value());
  CHECK(grid->x == std::vector<double>{0, 1, 2, 3, 4});
  CHECK(grid->y == std::vector<double>{2.0, 2.1, 2.2, 2.3});
  CHECK(grid->z.size() == 4);
  CHECK(grid->z[3].size() == 5);
  auto hole = heights();
  hole.erase(hole.find("2,2.1,7\n"), 8);
  wrong(hole, "h.csv", "h.csv: got 19 points on a grid of 5 x 4, and none at (2, 2.1)");
  wrong(heights() + "3,2.1,8\n", "h.csv", "h.csv:22: got a second point at (3, 2.1)");
  wrong(heights() + "3,2.1\n", "h.csv", "h.csv:22: got 2 values");
  wrong(heights() + "3,2.1,nan\n", "h.csv", "h.csv:22: got 'nan'");
  wrong(heights() + "3,2.1,-9999\n", "h.csv",
        "h.csv:22: got a height of -9999, which marks a hole");
  // the number as it is written, whatever the unit of its column
  for (const char* unit : {" [m]", "_mm", " [in]"}) {
    std::string units = heights() + "3,2.1,-32767\n";
    units.replace(0, 5, fmt::format("x{0},y{0},z{0}", unit));
    wrong(units, "h.csv", "h.csv:22: got a height of -32767, which marks a hole");
  }
  wrong("0 0 1\n1 1 1\n2 2 1\n", "h.txt", "at least 4 x 4");
  std::string scattered;
  for (int k = 0; k < 40; ++k)
    scattered += std::to_string(k) + " " + std::to_string(k * k) + " 1\n";
  wrong(scattered, "h.txt", "expected a complete rectangle");
}

TEST_CASE("what is no mesh is refused with its position") {
  wrong(obj, "a.step", "ends in .csv or .txt");
  wrong("", "a.obj", "got no triangle");
  wrong("v 1 2\n", "a.obj", "a.obj:1: expected a vertex of three numbers");
  wrong("v 1 2 nan\n", "a.obj", "a.obj:1: expected a vertex of three numbers");
  wrong("v 1 2 1e300\n", "a.obj", "too large");
  wrong(obj + "f 1 2 7\n", "a.obj", "a.obj:8: got the number of no vertex, expected one of the 4");
  wrong(obj + "f 1 2 x\n", "a.obj", "a.obj:8: got 'x', expected the number");
  wrong(obj + "f 1 2\n", "a.obj", "a polygon of 2 corners");
  wrong("a mesh", "a.stl", "no STL");
  wrong(stl_bytes() + "x", "a.stl", "no STL");
  wrong("solid\nvertex 1 2 3\nendsolid\n", "a.stl", "vertices, expected three per triangle");
  wrong("solid\nvertex 1 2 inf\n", "a.stl", "a.stl:2: expected a vertex of three numbers");
  wrong("plywood\n", "a.ply", "a.ply:1: got no PLY");
  wrong("ply\nformat ascii 1.0\nelement vertex 3\n", "a.ply", "ends within its header");
  wrong("ply\nformat morse 1.0\n", "a.ply", "a.ply:2: got no line of a PLY header");
  wrong("ply\nformat ascii 1.0\nelement vertex 1\nproperty quaternion x\n", "a.ply",
        "a type that PLY does not have");
  const auto cut = ply_bytes(false);
  wrong(cut.substr(0, cut.size() - 3), "a.ply", "face 1: got the end of the file");
  // sizes that a header claims cost nothing
  wrong("ply\nformat ascii 1.0\nelement vertex 999999999\nproperty float x\nend_header\n1\n",
        "a.ply", "not a number");
}

TEST_CASE("a preset contains the surface of its file, and its text reads back as the same") {
  const std::string text =
      "[footprint]\nkind = \"net\"\n[net]\nkind = \"surface\"\nfile = \"NAME\"\n";
  const std::map<std::string, std::string> files{{"h.csv", heights()}, {"a.obj", obj}};
  for (const auto& file : files) {
    auto named = text;
    named.replace(named.find("NAME"), 4, file.first);
    const auto read = value_of(read_preset_text(named, "built-in p", "p", {}, files));
    CHECK_FALSE(read.base.net.file.empty());
    const auto again = value_of(read_preset_text(to_toml(read), "p.toml", "p"));
    CHECK(to_toml(again) == to_toml(read));
    CHECK(again.base.net.file.vertices == read.base.net.file.vertices);
    CHECK(again.base.net.file.z == read.base.net.file.z);
  }
  const auto refused = [&](const std::string& value, const char* reason) {
    CHECK_THAT(refusal(read_preset_text(
                   "[footprint]\nkind = \"net\"\n[net]\nkind = \"surface\"\nfile = " + value + "\n",
                   "/nonexistent/p.toml", "p")),
               Catch::Contains(reason));
  };
  refused("\"a.obj\"", "/nonexistent/a.obj");
  refused("\"\"", "needs an expression");
  refused("3", "an integer), expected the name of a file");
  refused("{x_mm = [1, 2, 3, 4]}", "(no list y_mm)");
  refused("{x_mm = [1, 2, 4, 3], y_mm = [1, 2, 3, 4], z_mm = []}", "expected rising numbers");
  refused("{x_mm = [1, 2, 3, 4], y_mm = [1, 2, 3, 4], z_mm = [[1]]}", "z_mm: got 1 rows");
  refused("{vertices_mm = [[0, 0, 0]], triangles = [[0, 1, 2]]}",
          "expected one of the 1 before it");
  refused("{vertices_mm = [[0, 0]], triangles = [[0, 0, 0]]}", "expected points [x, y, z]");
}

TEST_CASE("the message on too many vertices of a mesh has the limit that was met") {
  MeshBuilder builder(1);
  const std::string where = "many.stl";
  std::string refused = "none";
  // all at one position, as in a file of separate triangles
  for (std::size_t k = 0; k <= 3 * MeshBuilder::most_triangles && refused == "none"; ++k)
    if (const auto added = builder.add_vertex({0, 0, 0}, where); !added)
      refused = added.error().message;
  CHECK(refused == "many.stl: got more than 3000000 vertices, expected fewer");
}
