// Meshes with the errors that programs write, of which one sheet is taken.
#include "engine/geometry/mesh_repair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>

#include "engine/geometry/surface.h"
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// A sheet of 120 mm, n x n squares, halved.
DomeMesh sheet(int n = 12) {
  return grid_mesh(n, [n](int i, int j) {
    const double x = 120.0 * i / n - 60, y = 120.0 * j / n - 60;
    return Eigen::Vector3d(x, y, 30 - (x * x + y * y) / 300);
  });
}

int add(DomeMesh& mesh, const Eigen::Vector3d& p) {
  mesh.vertices.conservativeResize(3, mesh.vertices.cols() + 1);
  mesh.vertices.rightCols<1>() = p;
  return int(mesh.vertices.cols()) - 1;
}

/// The sheet that is taken of a mesh which TriangleMesh refuses; checks that the list of what was
/// done contains `said`.
TriangleMesh sheet_of(const DomeMesh& mesh, const std::string& said) {
  CHECK(!TriangleMesh::make(mesh.vertices, mesh.triangles));
  MendedMesh mend = mended(mesh.vertices, mesh.triangles);
  CHECK_THAT(fmt::format("{}", fmt::join(mend.done, "\n")), Catch::Contains(said));
  return value_of(TriangleMesh::make(mend.vertices, mend.triangles));
}

}  // namespace

TEST_CASE("separate triangles, turned at random, are joined") {
  const DomeMesh whole = sheet();
  DomeMesh loose{Eigen::Matrix3Xd(3, 3 * Eigen::Index(whole.triangles.size())), {}};
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const int first = int(3 * t);
    for (int k = 0; k < 3; ++k)
      loose.vertices.col(first + k) = whole.vertices.col(whole.triangles[t][std::size_t(k)]) +
                                      1e-5 * Eigen::Vector3d(std::sin(first + k), 0, 1);
    loose.triangles.push_back({first, first + 1 + int(t % 3 == 0), first + 2 - int(t % 3 == 0)});
  }
  const TriangleMesh mesh = sheet_of(loose, "vertices at the positions of others are joined");
  CHECK(mesh.vertices().cols() == 13 * 13);
  CHECK(mesh.lines().size() == 1);
  CHECK(mesh.area() ==
        Approx(value_of(TriangleMesh::make(whole.vertices, whole.triangles)).area()).epsilon(1e-4));
}

TEST_CASE("of several pieces the largest is taken, and how much the others are is said") {
  DomeMesh mesh = sheet();
  const int a = add(mesh, {200, 0, 0}), b = add(mesh, {230, 0, 0}), c = add(mesh, {200, 30, 0});
  mesh.triangles.insert(mesh.triangles.begin(), {a, b, c});
  CHECK(sheet_of(mesh, "in 2 pieces: the largest is taken, 2.9 % of the area").triangles().size() ==
        288);
}

TEST_CASE("a fin on a sheet is left out, and the sheet stays whole") {
  DomeMesh mesh = sheet();
  const int a = 13 * 6 + 4, b = a + 1;
  const int c = add(mesh, mesh.vertices.col(a) + Eigen::Vector3d(0, 0, 9)),
            d = add(mesh, mesh.vertices.col(b) + Eigen::Vector3d(0, 0, 9));
  mesh.triangles.insert(mesh.triangles.begin(), {{a, b, d}, {a, d, c}});
  const TriangleMesh taken = sheet_of(mesh, "1 edge has more than two triangles");
  CHECK(taken.triangles().size() == 288);
  CHECK(taken.lines().size() == 1);
}

TEST_CASE("triangles without area and those there twice are left out") {
  DomeMesh mesh = sheet();
  mesh.triangles.push_back(mesh.triangles[5]);
  // a corner on the edge between two triangles, one of which is divided there
  const auto [a, b, c] = mesh.triangles[40];
  const int middle = add(mesh, 0.5 * (mesh.vertices.col(a) + mesh.vertices.col(c)));
  mesh.triangles[40] = {a, b, middle};
  mesh.triangles.push_back({b, c, middle});
  mesh.triangles.push_back({a, middle, c});
  const TriangleMesh taken = sheet_of(mesh, "2 triangles without area, or there twice, are left");
  CHECK(taken.triangles().size() == 290);
  CHECK(taken.lines().size() == 1);
}

TEST_CASE("parts that touch in one vertex have vertices of their own") {
  DomeMesh mesh = sheet();
  for (const int square : {12 * 5 + 5, 12 * 6 + 6})
    mesh.triangles[std::size_t(2 * square)] =
        mesh.triangles[std::size_t(2 * square + 1)] = {0, 0, 0};
  std::erase(mesh.triangles, std::array{0, 0, 0});
  CHECK(!TriangleMesh::make(mesh.vertices, mesh.triangles));
  const MendedMesh mend = mended(mesh.vertices, mesh.triangles);
  const auto taken = value_of(TriangleMesh::make(mend.vertices, mend.triangles));
  CHECK(taken.triangles().size() == 284);
  CHECK(taken.vertices().cols() == 13 * 13 + 1);
  // the vertices are separated by less than a thousandth of their triangles' size
  const Eigen::VectorXd distance =
      (taken.vertices().colwise() - Eigen::Vector3d(0, 0, 30)).colwise().norm();
  CHECK((distance.array() < 0.01).count() == 2);
}

TEST_CASE("of a closed mesh the part that faces up is taken") {
  DomeMesh mesh = sheet();
  const auto above = mesh.triangles;
  const int count = int(mesh.vertices.cols());
  for (int k = 0; k < count; ++k)
    add(mesh, Eigen::Vector3d(mesh.vertices.col(k)) - Eigen::Vector3d(0, 0, 4));
  for (const auto& [a, b, c] : above) mesh.triangles.push_back({a + count, c + count, b + count});
  for (int k = 0; k < 12; ++k)
    for (const auto& [a, b] :
         {std::array{k, k + 1}, std::array{13 * 12 + k + 1, 13 * 12 + k},
          std::array{13 * (k + 1), 13 * k}, std::array{13 * k + 12, 13 * (k + 1) + 12}}) {
      mesh.triangles.push_back({a, a + count, b});
      mesh.triangles.push_back({b, a + count, b + count});
    }
  for (const bool turned : {false, true}) {
    if (turned)
      for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    const MendedMesh mend = mended(mesh.vertices, mesh.triangles);
    CHECK_THAT(mend.done.at(0), Catch::Contains("closed, as of a solid"));
    CHECK(mend.triangles.size() == above.size());
    const Eigen::Vector3d first = mend.vertices.col(mend.triangles[0][0]);
    CHECK(first.z() == Approx(30 - first.head<2>().squaredNorm() / 300));
  }
}

TEST_CASE("a vertex at which a sheet is folded onto itself is moved back") {
  DomeMesh mesh = sheet(60);
  mesh.vertices.col(61 * 30 + 30) += Eigen::Vector3d(2.6, 1.2, -0.02);
  const TriangleMesh taken = sheet_of(mesh, "to unfold it");
  CHECK(taken.triangles().size() == 7200);
  // the vertex is between its neighbours, which are at distances of 2 mm
  const Eigen::RowVectorXd from_there =
      (taken.vertices().colwise() - Eigen::Vector3d(0, 0, 30)).colwise().norm();
  CHECK(from_there.minCoeff() < 2);
}
