#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "render/gl/mesh.h"
#include "tests/render/gl/square_shell.h"

using namespace gridshell::render;

TEST_CASE("tangents are unit vectors, also where points coincide or reverse", "[mesh]") {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  for (const bool closed : {false, true})
    for (const Eigen::Vector3f& t : tangents(points, closed)) CHECK(t.norm() == Approx(1));
}

TEST_CASE("a ribbon has two vertices a point, one on either side, and a strip between points",
          "[mesh]") {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {10, 0, 0}, {17, 7, 0}};
  const std::vector<Eigen::Vector4f> colours(3, {0.5f, 0.25f, 1, 1});
  const float radius = 254;  // a steel tube
  Mesh mesh;
  mesh.add({9, 9, 9}, {0, 0, 1}, {});
  const std::uint32_t first = add_ribbon(mesh, {points, colours, {&radius, 1}});
  CHECK(first == 1);
  REQUIRE(mesh.vertices.size() == 7);
  for (int k = 0; k < 3; ++k)
    for (int side : {0, 1}) {
      const Vertex& v = mesh.vertices[1 + 2 * k + side];
      CHECK(v.position == points[k]);
      CHECK(radius_mm(v) == Approx(radius).epsilon(1e-3));
      CHECK((v.normal[3] > 0) == (side == 0));
      CHECK(v.colour[1] == 16384);
    }
  std::vector<std::uint32_t> indices;
  add_strip_quad(indices, first, 1, 2);
  CHECK(indices == std::vector<std::uint32_t>{3, 4, 6, 3, 6, 5});
}

TEST_CASE("a bead is a card whose corners distinguish side and shape", "[mesh]") {
  Mesh mesh;
  const auto flat = add_bead(mesh, {1, 2, 3}, {0, 0, 1}, 1.5f, BeadShape::cylinder, {1, 0, 0, 1});
  const auto ball = add_bead(mesh, {1, 2, 3}, {0, 0, 1}, 1.5f, BeadShape::ball, {1, 0, 0, 1});
  REQUIRE(mesh.vertices.size() == 8);
  CHECK(flat.size() == 6);
  CHECK(ball.front() == 4);
  const auto code = [&](int k) { return int(3.0 * mesh.vertices[k].colour[3] / 65535 + 0.5); };
  CHECK(std::vector{code(0), code(1), code(2), code(3)} == std::vector{0, 0, 1, 1});
  CHECK(std::vector{code(4), code(5), code(6), code(7)} == std::vector{2, 2, 3, 3});
  CHECK(mesh.vertices[0].normal[3] == -mesh.vertices[1].normal[3]);
}

TEST_CASE("a straight piece goes as far as it misses nothing", "[mesh]") {
  // a straight stretch, a corner, and a bow of radius 100
  std::vector<Eigen::Vector3f> points;
  for (int k = 0; k <= 4; ++k) points.push_back({float(k), 0, 0});
  for (int k = 1; k <= 4; ++k) points.push_back({4, float(k), 0});
  const float radius = 1;
  std::vector<Eigen::Vector4f> colours(points.size(), {0, 0, 0, 1});
  const Ribbon bent{points, colours, {&radius, 1}};
  // at a corner the strip is not square to its end, so the piece before it stays short
  CHECK(longest_straight_piece(bent, 0, 8, 0.01f) == 3);
  CHECK(longest_straight_piece(bent, 3, 8, 0.01f) == 4);
  CHECK(longest_straight_piece(bent, 4, 8, 0.01f) == 5);
  CHECK(longest_straight_piece(bent, 5, 8, 0.01f) == 8);
  CHECK(longest_straight_piece(bent, 0, 2, 0.01f) == 2);

  for (std::size_t k = 0; k < points.size(); ++k) {
    const float angle = 0.01f * float(k);
    points[k] = {100 * std::sin(angle), 0, 100 * std::cos(angle)};
  }
  const Ribbon bow{points, colours, {&radius, 1}};
  // a chord over n edges of 1 mm lies n^2 / 800 mm off
  CHECK(longest_straight_piece(bow, 0, 8, 0.0005f) == 1);
  CHECK(longest_straight_piece(bow, 0, 8, 0.02f) == 3);
  CHECK(longest_straight_piece(bow, 0, 8, 0.1f) == 8);
  // nor does a piece jump over a colour of its own
  colours[2] = {1, 0, 0, 1};
  CHECK(longest_straight_piece(bow, 0, 8, 0.1f) == 1);
}

TEST_CASE("a cell's sheet ends on its rods", "[skin]") {
  const auto shell = test::square_shell(2, 4, 50);
  Mesh mesh;
  const std::vector<Eigen::Vector4f> colours{{1, 0, 0, 1}};
  const auto patches = add_cell_patches(mesh, shell.layout, shell.nodes, colours, 0);
  REQUIRE(mesh.vertices.size() == 25);
  REQUIRE(patches.size() == 1);
  CHECK(patches[0].indices.size() == 3 * 2 * 16);
  // u fastest: the first row lies on the first rod, the first column on the third
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d along_x = shell.nodes.col(shell.layout.rods[0][k]);
    const Eigen::Vector3d along_y = shell.nodes.col(shell.layout.rods[2][k]);
    CHECK((mesh.vertices[k].position.cast<double>() - along_x).norm() < 1e-4);
    CHECK((mesh.vertices[5 * k].position.cast<double>() - along_y).norm() < 1e-4);
  }
}

TEST_CASE("a third rod through a cell's corners leaves its sides as they are", "[skin]") {
  auto shell = test::square_shell(2, 4, 50);
  const std::vector<Eigen::Vector4f> colours{{1, 0, 0, 1}};
  Mesh two, three;
  add_cell_patches(two, shell.layout, shell.nodes, colours, 0);
  shell.layout.rods.insert(shell.layout.rods.begin(), {0, 3});
  add_cell_patches(three, shell.layout, shell.nodes, colours, 0);
  REQUIRE(three.vertices.size() == two.vertices.size());
  for (std::size_t k = 0; k < two.vertices.size(); ++k)
    CHECK(three.vertices[k].position == two.vertices[k].position);
}

TEST_CASE("cells without alpha are left out", "[skin]") {
  const auto shell = test::square_shell(4, 1, 50);
  const std::size_t count = shell.layout.cells.size();
  std::vector<Eigen::Vector4f> colours(count, {1, 1, 1, 0.5f});
  colours[4].w() = 0;
  Mesh mesh;
  const auto patches = add_cell_patches(mesh, shell.layout, shell.nodes, colours, 0);
  CHECK(patches.size() == count - 1);
  for (const CellPatch& patch : patches) CHECK(patch.cell != 4);
}

TEST_CASE("a patch is as coarse as the tolerance allows", "[skin]") {
  const auto shell = test::square_shell(2, 4, 50);
  const std::vector<Eigen::Vector4f> colours{{1, 0, 0, 1}};
  std::size_t before = 26;
  for (const float tolerance : {0.f, 1e3f}) {
    Mesh mesh;
    add_cell_patches(mesh, shell.layout, shell.nodes, colours, tolerance);
    CHECK(mesh.vertices.size() < before);
    before = mesh.vertices.size();
  }
  CHECK(before == 4);
}
