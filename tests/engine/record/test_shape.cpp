// Tubes and the files of a shape.
#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "engine/core/json.h"
#include "tests/engine/record/sample_run.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::exports;
using record::sample_trajectory;

namespace {

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
  return found;
}

std::size_t rod_points_of(const record::Layout& layout) {
  std::size_t points = 0;
  for (const auto& rod : layout.rods) points += rod.size();
  return points;
}

}  // namespace

TEST_CASE("a tube is closed, its triangles look outwards, its volume is that of a prism") {
  Eigen::Matrix3Xd line(3, 3);
  line << 0, 1, 3, 0, 2, 6, 0, 2, 6;
  const double radius = 0.5;
  const int sides = 8;
  const Tube tube = tube_around(line, radius, sides);
  // each edge occurs twice, once in each direction
  std::map<std::pair<int, int>, int> edges;
  double volume = 0;
  for (const auto& triangle : tube.triangles) {
    const auto& [a, b, c] = triangle;
    volume +=
        tube.vertices.col(a).dot(
            Eigen::Vector3d(tube.vertices.col(b)).cross(Eigen::Vector3d(tube.vertices.col(c)))) /
        6;
    for (int k = 0; k < 3; ++k)
      ++edges[{triangle[std::size_t(k)], triangle[std::size_t((k + 1) % 3)]}];
  }
  for (const auto& [edge, times] : edges) {
    CHECK(times == 1);
    CHECK(edges.contains({edge.second, edge.first}));
  }
  const double area = sides * radius * radius * std::sin(2 * M_PI / sides) / 2;
  CHECK(volume == Approx(area * 9).epsilon(1e-12));
}

TEST_CASE("an OBJ lists every node, a line a rod, a point a joint and a face a cell") {
  const record::Trajectory run = sample_trajectory();
  const Shape shape{run.layout, run.frames.back(), run.frames.front(), "sample"};
  const std::string obj = to_obj(shape);
  CHECK(count(obj, "\nv ") == int(run.frames.back().nodes.cols()) + int(run.layout.joints.size()));
  CHECK(count(obj, "\nl ") == int(run.layout.rods.size()));
  CHECK(count(obj, "\np ") == int(run.layout.joints.size()));
  CHECK(count(obj, "\nf ") == int(run.layout.cells.size()));
  const std::string tubes = to_obj_tubes(shape);
  CHECK(count(tubes, "\ng rod_") == int(run.layout.rods.size()));
}

TEST_CASE("a VTP has as many numbers as it says") {
  const record::Trajectory run = sample_trajectory();
  const std::string vtp = to_vtp({run.layout, run.frames.back(), run.frames.front(), "sample"});
  const std::size_t points = rod_points_of(run.layout) + run.layout.joints.size();
  CHECK(vtp.find("NumberOfPoints=\"" + std::to_string(points) + "\"") != vtp.npos);
  const auto numbers = [&](const std::string& name) {
    std::size_t at = vtp.find("Name=\"" + name + "\"");
    REQUIRE(at != vtp.npos);
    at = vtp.find('>', at) + 1;
    std::istringstream words(vtp.substr(at, vtp.find('<', at) - at));
    std::size_t found = 0;
    for (std::string word; words >> word;) ++found;
    return found;
  };
  CHECK(numbers("displacement_mm") == 3 * points);
  CHECK(numbers("curvature_per_mm") == points);
  CHECK(numbers("axial_force_N") == points);
  CHECK(numbers("stress_MPa") == points);
  CHECK(numbers("reaction_N") == 3 * points);
  CHECK(numbers("K_rad") == run.layout.rods.size() + run.layout.cells.size());
  CHECK(numbers("Points") == 3 * points);
}

TEST_CASE("a GLB contains its chunks, as many key shapes as frames, and a path for each joint") {
  const record::Trajectory run = sample_trajectory();
  const auto glb = value_of(to_glb(run, "sample", 2));
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, glb.data() + at, 4);
    return value;
  };
  CHECK(glb.substr(0, 4) == "glTF");
  CHECK(word(4) == 2);
  CHECK(word(8) == glb.size());
  const std::size_t json_size = word(12);
  CHECK(glb.substr(16, 4) == "JSON");
  const Json gltf = parsed(glb.substr(20, json_size));
  REQUIRE(gltf.is_object());
  CHECK(word(20 + json_size) == glb.size() - 28 - json_size);
  CHECK(gltf["buffers"][0]["byteLength"] <= word(20 + json_size));
  const std::size_t shapes = run.frames.size();
  CHECK(gltf["meshes"][0]["primitives"][0]["targets"].size() == shapes - 1);
  CHECK(gltf["nodes"].size() ==
        2 + std::size_t(!run.layout.cells.empty()) + run.layout.joints.size());
  CHECK(gltf["animations"][0]["channels"].size() ==
        1 + std::size_t(!run.layout.cells.empty()) + run.layout.joints.size());
  for (const auto& accessor : gltf["accessors"]) {
    const auto& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t wide = accessor["type"] == "VEC4" ? 4 : accessor["type"] == "VEC3" ? 3 : 1;
    CHECK(view["byteLength"] == 4 * wide * accessor["count"].get<std::size_t>());
    CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <=
          gltf["buffers"][0]["byteLength"]);
    if (accessor.contains("min")) CHECK(accessor["min"].size() == wide);
  }
}

TEST_CASE("a GLB of many joints has fewer key shapes instead of more than 20 MB") {
  record::Trajectory run = sample_trajectory();
  run.layout.joints.resize(20'000);
  run.layout.cells.resize(1'000, run.layout.cells.front());
  for (record::Frame& frame : run.frames.edit()) frame.cell_K.setConstant(1'000, 0.01);
  const record::Frame last = run.frames.back();
  for (int k = 0; k < 60; ++k) run.frames.push_back(last);
  const std::size_t size = value_of(to_glb(run, "many", 2)).size();
  CHECK(size <= 20'000'000);
  CHECK(size > 10'000'000);
}

TEST_CASE("a page contains the run, and a title cannot end its script") {
  const record::Trajectory run = sample_trajectory();
  const std::string title = "</script><b>bold<!--<script";
  const auto page = value_of(to_page(run, title));
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(count(page, "</script>") == 2);
  CHECK(page.find("/*RUN*/") == page.npos);
  const std::size_t from = page.find("application/json\">") + 18;
  const Json json = parsed(page.substr(from, page.find("</script>", from) - from));
  REQUIRE(json.is_object());
  CHECK(page.find("<!--") == page.npos);
  CHECK(json["title"] == title);
  CHECK(json["frames"].size() == run.frames.size());
  CHECK(json["rods"].size() == run.layout.rods.size());
  // three numbers of two bytes a node, in letters of six bits
  const std::size_t bytes = 6 * std::size_t(run.frames.front().nodes.cols());
  CHECK(json["frames"][0]["nodes"].get<std::string>().size() == (bytes + 2) / 3 * 4);
}

TEST_CASE("a page has the supports, loads and braces of each frame") {
  record::Trajectory run = sample_trajectory();
  record::Frame& last = run.frames.edit().back();
  const auto supports = Eigen::Index(run.layout.supports.size());
  REQUIRE(supports > 1);
  last.reactions_N = Eigen::Matrix3Xd::Zero(3, supports);
  last.reactions_N.col(1) << 0, 0, 3;
  last.loads_N = Eigen::Matrix3Xd::Zero(3, supports);
  last.loads_N.col(0) << 0, 0, -3;
  last.brace_force_N =
      Eigen::VectorXd::Constant(2 * Eigen::Index(run.layout.cells.size()), record::unknown);
  last.brace_force_N[1] = 7;
  const auto page = value_of(to_page(run, "braced"));
  const std::size_t from = page.find("application/json\">") + 18;
  const Json frame =
      parsed(page.substr(from, page.find("</script>", from) - from))["frames"].back();
  REQUIRE(frame["held"].size() == 1);
  CHECK(frame["held"][0] == run.layout.supports[1]);
  REQUIRE(frame["loads"].size() == 1);
  CHECK(frame["loads"][0][0] == run.layout.supports[0]);
  CHECK(frame["loads"][0][3] == -3);
  REQUIRE(frame["braces"].size() == 1);
  const auto& corners = run.layout.cells[0].joints;
  CHECK(frame["braces"][0][0] == run.layout.joints[std::size_t(corners[1])].node);
  CHECK(frame["braces"][0][1] == run.layout.joints[std::size_t(corners[3])].node);
}

TEST_CASE("reactions are those of the supports, and unknown where not recorded") {
  const record::Trajectory run = sample_trajectory();
  CHECK(reactions_N(run.layout, run.frames.back()) == run.frames.back().reactions_N);
  const record::Frame& between = run.frames[1];
  CHECK(reactions_N(run.layout, between).array().isNaN().all());
}

TEST_CASE("XDMF speaks of forces where the run's end has them") {
  record::Trajectory run = sample_trajectory();
  const auto xdmf = [&] { return to_xdmf(run.layout, run.frames, "run/trajectory.h5"); };
  CHECK(count(xdmf(), ":/axial_force_N") == 3);
  CHECK(count(xdmf(), ":/reactions_N") == 3);
  for (record::Frame& frame : run.frames.edit()) frame.axial_force_N.resize(0);
  CHECK(count(xdmf(), ":/axial_force_N") == 0);
  CHECK(count(xdmf(), ":/nodes") == 3);
}

TEST_CASE("names and titles of users stay text in every format") {
  const record::Trajectory run = sample_trajectory();
  const Shape shape{run.layout, run.frames.back(), run.frames.front(), "a\nf 1 2 3"};
  for (const std::string& text : {to_obj(shape), to_obj_tubes(shape)})
    CHECK_THAT(text, Catch::StartsWith("# a f 1 2 3, mm, z up\no gridshell\n"));
  CHECK_THAT(to_pvd({0}, {"a&\"b\".vtp"}), Catch::Contains("file=\"a&amp;&quot;b&quot;.vtp\""));
  CHECK_THAT(to_xdmf(run.layout, run.frames, "a&b.h5"), Catch::Contains(">a&amp;b.h5:/nodes<"));
}

TEST_CASE("a run without frames has neither a model nor a page") {
  record::Trajectory run = sample_trajectory();
  run.frames = {};
  CHECK(refusal(to_glb(run, "none", 1)) == "got no frame, expected at least one");
  CHECK(refusal(to_page(run, "none")) == "got no frame, expected at least one");
}
