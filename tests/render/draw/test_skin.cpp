#include "render/draw/skin.h"

#include <catch2/catch.hpp>

#include "tests/render/draw/square_shell.h"

using namespace gridshell::render;

TEST_CASE("a cell's sheet ends on its rods", "[skin]") {
  const auto shell = test::square_shell(2, 4, 50);
  Mesh mesh;
  const std::vector<Eigen::Vector4f> colours{{1, 0, 0, 1}};
  add_cells(mesh, shell.layout, shell.nodes, colours, -Eigen::Vector3d::UnitZ());
  REQUIRE(mesh.vertices.size() == 25);
  CHECK(mesh.indices.size() == 3 * 2 * 16);
  // u fastest: the first row lies on the first rod, the first column on the third
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d along_x = shell.nodes.col(shell.layout.rods[0][k]);
    const Eigen::Vector3d along_y = shell.nodes.col(shell.layout.rods[2][k]);
    CHECK((mesh.vertices[k].position.cast<double>() - along_x).norm() < 1e-4);
    CHECK((mesh.vertices[5 * k].position.cast<double>() - along_y).norm() < 1e-4);
  }
}

TEST_CASE("cells come from far to near, and those without alpha not at all", "[skin]") {
  const auto shell = test::square_shell(4, 1, 50);
  const std::size_t count = shell.layout.cells.size();
  std::vector<Eigen::Vector4f> colours(count, {1, 1, 1, 0.5f});
  colours[4].w() = 0;
  Mesh mesh;
  const Eigen::Vector3d forward = Eigen::Vector3d(1, 0.3, -0.2).normalized();
  add_cells(mesh, shell.layout, shell.nodes, colours, forward);
  REQUIRE(mesh.vertices.size() == 4 * (count - 1));
  double before = 1e9;
  for (std::size_t c = 0; c + 1 < count; ++c) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k) middle += mesh.vertices[4 * c + k].position.cast<double>() / 4;
    CHECK(forward.dot(middle) <= before + 1e-4);
    before = forward.dot(middle);
  }
}
