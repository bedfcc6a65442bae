// Rims, holes and creases of meshes, and what crosses them.
#include "engine/geometry/mesh_lines.h"

#include "engine/geometry/surface.h"
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// A square sheet of 16 x 16 squares of 5 mm, folded along x = 40 by `turn` (rad) as far as row
/// `rows`, and less from there on.
TriangleMesh folded(double turn, int rows) {
  const DomeMesh mesh = grid_mesh(16, [&](int i, int j) {
    const double slope = std::tan(turn / 2) * (j <= rows ? 1 : std::max(0, rows + 8 - j) / 8.);
    return Eigen::Vector3d(5 * i, 5 * j, -slope * 5 * std::abs(i - 8));
  });
  return value_of(TriangleMesh::make(mesh.vertices, mesh.triangles));
}

long count(const TriangleMesh& mesh, LineKind kind) {
  return std::ranges::count(mesh.lines(), kind, &MeshLine::kind);
}

}  // namespace

TEST_CASE("a crease is a line where a mesh turns by much more than around it") {
  CHECK(count(folded(0.5, 20), LineKind::crease) == 0);
  const TriangleMesh whole = folded(1.2, 20);
  REQUIRE(count(whole, LineKind::crease) == 1);
  CHECK(Barriers(whole).tips().empty());
  const TriangleMesh half = folded(1.2, 8);
  REQUIRE(count(half, LineKind::crease) == 1);
  REQUIRE(Barriers(half).tips().size() == 1);
  CHECK(Barriers(half).tips().front().y() >= 40);
  // coarse triangles of a ball turn as much everywhere
  const DomeMesh ball = ellipsoid_mesh({60, 60, 60}, 32);
  CHECK(count(value_of(TriangleMesh::make(ball.vertices, ball.triangles)), LineKind::crease) == 0);
}

TEST_CASE("the longest closed line is the rim, others are holes, and crossings of it are found") {
  DomeMesh dome = ellipsoid_mesh({100, 100, 40}, 8, 1.2);
  std::erase_if(dome.triangles, [&](const auto& t) {
    return (dome.vertices.col(t[0]).template head<2>() - Eigen::Vector2d(30, 0)).norm() < 15;
  });
  const auto mesh = value_of(TriangleMesh::make(dome.vertices, dome.triangles));
  CHECK(count(mesh, LineKind::rim) == 1);
  CHECK(count(mesh, LineKind::hole) == 1);
  const Barriers lines(mesh);
  const auto on = [](double x, double y) {
    return Eigen::Vector3d(x, y, 40 * std::sqrt(1 - (x * x + y * y) / 1e4));
  };
  CHECK(lines.crossed(on(5, 0), on(25, 0)) == LineKind::hole);
  CHECK_FALSE(lines.crossed(on(5, 0), on(5, 12)).has_value());
  CHECK(lines.crossed(on(0, 90), on(0, 98)) == LineKind::rim);
  // another sheet above is no obstacle
  CHECK_FALSE(
      lines.crossed(on(5, 0) + Eigen::Vector3d(0, 0, 30), on(25, 0) + Eigen::Vector3d(0, 0, 30))
          .has_value());
}
