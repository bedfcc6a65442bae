#include "render/gl/mesh.h"

#include <catch2/catch.hpp>

#include "tests/render/gl/square_shell.h"

using namespace gridshell::render;

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
