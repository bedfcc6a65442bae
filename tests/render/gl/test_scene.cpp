#include "render/gl/scene.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "render/gl/mesh.h"
#include "render/gl/renderer.h"
#include "tests/render/gl/square_shell.h"
#include "tests/results.h"

using namespace gridshell::render;

namespace {

// position along the view of a triangle's middle
double depth(const Mesh& mesh, std::size_t index, const Eigen::Vector3d& forward) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k) sum += mesh.vertices[mesh.indices[index + k]].position;
  return forward.dot(sum.cast<double>() / 3);
}

// a square net seen from so high
struct View {
  View(int rods, int edges, double elevation_deg)
      : shell(test::square_shell(rods, edges)), drawing(test::square_drawing(shell)) {
    camera.elevation_deg = elevation_deg;
    auto made = value_of(make_scene(drawing, camera, 0.3));
    scene = std::move(made);
  }

  test::SquareShell shell;
  Drawing drawing;
  Camera camera;
  gridshell::render::Scene scene;
};

}  // namespace

TEST_CASE("every piece is in one layer, and layers go from far to near", "[scene]") {
  const View view(9, 6, 35);
  const gridshell::render::Scene& scene = view.scene;
  const Eigen::Vector3d forward = camera_axes(view.camera).forward;
  const auto& layers = scene.layers;
  REQUIRE(layers.size() > 8);
  CHECK(layers.front().sheets + layers.front().ribbons + layers.front().beads == 0);
  CHECK(layers.back().sheets == scene.sheets.indices.size());
  CHECK(layers.back().ribbons == scene.ribbons.indices.size());
  CHECK(layers.back().beads == scene.beads.indices.size());
  double before = INFINITY;
  for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
    double nearest = INFINITY;
    for (std::size_t i = layers[k].sheets; i < layers[k + 1].sheets; i += 3)
      nearest = std::min(nearest, depth(scene.sheets, i, forward));
    // a cell is as deep as it is wide: two neighbours overlap by less than a cell's diagonal
    if (std::isfinite(nearest)) {
      CHECK(nearest < before + 1.5 * view.shell.layout.spacing_mm);
      before = std::min(before, nearest);
    }
  }
}

TEST_CASE("a rod comes after the cells next to it, a joint after its rods", "[scene]") {
  const View view(6, 4, 25);
  const gridshell::render::Scene& scene = view.scene;
  // the layer in which a triangle that touches a point is painted, the last one
  const auto last_layer = [&](const Mesh& mesh, std::size_t Layer::*kind,
                              const Eigen::Vector3f& at) {
    int found = -1;
    for (std::size_t k = 0; k + 1 < scene.layers.size(); ++k)
      for (std::size_t i = scene.layers[k].*kind; i < scene.layers[k + 1].*kind; ++i)
        if ((mesh.vertices[mesh.indices[i]].position - at).norm() < 1e-3f) found = int(k);
    return found;
  };
  for (const auto& joint : view.shell.layout.joints) {
    const Eigen::Vector3f at = view.drawing.nodes.col(joint.node).cast<float>();
    const int sheet = last_layer(scene.sheets, &Layer::sheets, at);
    const int ribbon = last_layer(scene.ribbons, &Layer::ribbons, at);
    const int bead = last_layer(scene.beads, &Layer::beads, at);
    CHECK(ribbon >= sheet);
    CHECK(bead >= ribbon);
  }
}

TEST_CASE("a point of one rod alone is no joint, bolts of rods above one another are", "[scene]") {
  test::SquareShell shell = test::square_shell(3, 2);
  auto& layout = shell.layout;
  const auto vertices = [&] {
    return make_scene(test::square_drawing(shell), {}, 0.3)->beads.vertices.size();
  };
  const std::size_t joints = layout.joints.size(), all = vertices();
  const int node = layout.joints[0].node;
  std::erase_if(layout.rods, [&](const auto& rod) { return std::ranges::count(rod, node) > 0; });
  CHECK(vertices() < all * (joints - 1) / joints);
  for (const auto& joint : layout.joints) layout.above.push_back(joint.node);
  CHECK(vertices() == all);
}

TEST_CASE("rods throw shadows, rings and arrows only when requested, ghosts never", "[scene]") {
  const auto shell = test::square_shell(4, 3);
  Drawing drawing = test::square_drawing(shell);
  drawing.rings.clear();
  const auto count = [&] { return make_scene(drawing, {}, 0.3)->casters.size(); };
  const std::size_t rods = count();
  CHECK(rods > 0);
  Eigen::Matrix3Xd square(3, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  drawing.rings.push_back({square, 1, {}, false});
  CHECK(count() == rods);
  drawing.arrows.push_back({{0, 0, 0}, {0, 0, 20}, 1, {}, false});
  CHECK(count() == rods);
  drawing.arrows.back().shadow = true;
  CHECK(count() > rods);
  drawing.arrows.clear();
  drawing.rings.back().shadow = true;
  CHECK(count() == rods + 4 * 6);
  drawing.ghosts.push_back({drawing.nodes, shell.layout.rods, 0.5, {0, 0, 1, 1}});
  CHECK(count() == rods + 4 * 6);
}

TEST_CASE("what moves is drawn in fewer pieces, and without shadows nothing throws one",
          "[scene]") {
  const auto shell = test::square_shell(6, 8);
  const Drawing drawing = test::square_drawing(shell);
  const auto fine = make_scene(drawing, {}, 0.3),
             coarse = make_scene(drawing, {}, 0.3, {.coarse = true}),
             flat = make_scene(drawing, {}, 0.3, {.shadow = false});
  CHECK(coarse->ribbons.indices.size() < fine->ribbons.indices.size());
  CHECK(coarse->sheets.indices.size() <= fine->sheets.indices.size());
  CHECK(coarse->beads.indices.size() == fine->beads.indices.size());
  CHECK(
      make_scene(drawing, {}, drawing.joint_diameter_mm, {.coarse = true})->beads.indices.empty());
  CHECK(flat->ribbons.indices.size() == fine->ribbons.indices.size());
  CHECK(flat->casters.empty());
}

TEST_CASE("rods of other diameters are drawn thicker and thinner in proportion", "[scene]") {
  test::SquareShell shell = test::square_shell(3, 2);
  auto& layout = shell.layout;
  layout.diameters_mm.assign(layout.rods.size(), layout.rod_diameter_mm);
  layout.diameters_mm[1] *= 2;
  Drawing drawing = test::square_drawing(shell);
  drawing.layout = &layout;
  drawing.rod_diameter_mm = 3;
  drawing.rings.clear();
  const auto scene = value_of(make_scene(drawing, Camera{}, 0.3));
  std::map<int, int> widths;  // in tenths of a millimetre of the radius
  for (const Vertex& v : scene.ribbons.vertices) ++widths[int(std::lround(10 * radius_mm(v)))];
  const int points = int(layout.rods[1].size());
  CHECK(widths[30] == 2 * points);
  CHECK(widths[15] >= 2 * points * (int(layout.rods.size()) - 1));
}

TEST_CASE("arrows, marks, cells and upper rods that cannot be drawn are refused", "[scene]") {
  test::SquareShell shell = test::square_shell(3, 2);
  const Drawing good = test::square_drawing(shell);
  const auto message = [](const Drawing& drawing) {
    return gridshell::refusal(make_scene(drawing, {}, 0.3));
  };
  REQUIRE(message(good) == "none");
  Drawing wrong = good;
  wrong.arrows.push_back({{0, 0, NAN}, {0, 0, 1}, 1, {}});
  CHECK(message(wrong) == "the drawing has an arrow that is not finite");
  wrong = good;
  wrong.marks.push_back({{0, 0, NAN}, 4, {}});
  CHECK(message(wrong) == "the drawing has a mark that is not finite");
  shell.layout.above.assign(shell.layout.joints.size(), 1000);
  CHECK(message(good) == "the drawing has an upper rod outside its 21 nodes");
  shell.layout.above.clear();
  shell.layout.cells[0].joints[2] = 9;
  CHECK(message(good) == "the drawing has cell (0, 0) outside its 9 joints");
}
