// Surfaces through heights and meshes, compared with the surfaces on which their points are.
#include <cmath>

#include "engine/geometry/spline.h"
#include "engine/geometry/surface.h"
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// largest distance of the smooth surface from an ellipsoid's, over its upper half
double off_ellipsoid(const Eigen::Vector3d& axes, double edge_mm, double from_rim_mm) {
  const DomeMesh dome = ellipsoid_mesh(axes, edge_mm);
  const auto mesh = value_of(TriangleMesh::make(dome.vertices, dome.triangles));
  const auto surface = value_of(MeshSurface::fit(mesh, 20));
  double largest = 0;
  for (double polar = 0.01; polar < M_PI / 2 - from_rim_mm / axes.z(); polar += 0.037)
    for (double around = 0; around < 2 * M_PI; around += 0.093)
      largest = std::max(largest, std::abs(surface.at(on_ellipsoid(axes, polar, around))));
  return largest;
}

std::string error_of(const DomeMesh& dome) {
  const auto mesh = TriangleMesh::make(dome.vertices, dome.triangles);
  return mesh ? refusal(MeshSurface::fit(*mesh, 20)) : mesh.error().message;
}

void wrong(const DomeMesh& dome, const char* reason) {
  CHECK_THAT(error_of(dome), Catch::Contains(reason));
}

DomeMesh cap() { return ellipsoid_mesh({60, 60, 40}, 8); }

}  // namespace

TEST_CASE("a spline through heights is of fourth order, and ends with its grid") {
  const auto height = [](double x, double y) { return 50 * std::cos(x / 60) * std::cos(y / 45); };
  const auto off = [&](double step) {
    std::vector<double> at;
    for (double x = -60; x <= 60.001; x += step) at.push_back(x);
    Eigen::MatrixXd z(at.size(), at.size());
    for (std::size_t j = 0; j < at.size(); ++j)
      for (std::size_t i = 0; i < at.size(); ++i)
        z(Eigen::Index(j), Eigen::Index(i)) = height(at[i], at[j]);
    const auto grid = value_of(HeightGrid::through(at, at, z));
    CHECK(std::isnan(grid.at(60.1, 0)));
    double largest = 0;
    for (double x = -59; x < 60; x += 1.7)
      for (double y = -59; y < 60; y += 1.3)
        largest = std::max(largest, std::abs(grid.at(x, y) - height(x, y)));
    return largest;
  };
  const double coarse = off(12), fine = off(6);
  CHECK(fine < 1e-3);
  CHECK(coarse / fine > 10);
  CHECK_FALSE(
      HeightGrid::through({0, 1, 2}, {0, 1, 2, 3}, Eigen::MatrixXd::Zero(4, 3)).has_value());
  CHECK_FALSE(
      HeightGrid::through({0, 1, 1, 2}, {0, 1, 2, 3}, Eigen::MatrixXd::Zero(4, 4)).has_value());
}

TEST_CASE("triangles of 6 mm make the sphere and the ellipsoid to 1e-3 mm") {
  CHECK(off_ellipsoid({120, 120, 120}, 6, 0) < 1e-4);
  CHECK(off_ellipsoid({140, 110, 90}, 6, 0) < 1e-3);
}

TEST_CASE("the surface of a mesh is found at its highest, and extends slightly past its rim") {
  const DomeMesh dome = ellipsoid_mesh({120, 120, 120}, 10);
  const auto mesh = value_of(TriangleMesh::make(dome.vertices, dome.triangles));
  CHECK(highest_at(mesh, 30, -40).value() == Approx(std::sqrt(120. * 120 - 2500)).margin(0.3));
  CHECK_FALSE(highest_at(mesh, 130, 0).has_value());
  const auto surface = value_of(MeshSurface::fit(mesh, 20));
  CHECK(std::abs(surface.at({119.83, 0, -6.4})) < 0.01);
  CHECK(std::isnan(surface.at({100, 0, -66})));
  // near the surface the value is the distance along its normal
  CHECK(std::abs(surface.at({0, 0, 123})) == Approx(3).margin(1e-2));
}

TEST_CASE("what is no smooth sheet is refused with the position") {
  CHECK(error_of(cap()) == "none");
  const auto changed = [](const auto& change) {
    DomeMesh dome = cap();
    change(dome);
    return dome;
  };
  // a hole or a vertex away from the others is no error
  CHECK(error_of(changed([](DomeMesh& d) { d.triangles.erase(d.triangles.begin() + 3); })) ==
        "none");
  const DomeMesh bumped = changed([](DomeMesh& d) { d.vertices.col(0).z() += 5; });
  CHECK(error_of(bumped) == "none");
  CHECK_THAT(refusal(MeshSurface::fit(
                 value_of(TriangleMesh::make(bumped.vertices, bumped.triangles)), 20, 0.2)),
             Catch::Contains("got fit_mm = 0.2, expected at least"));
  wrong(changed([](DomeMesh& d) {
          d.triangles.push_back({0, 1, int(d.vertices.cols()) - 1});
        }),
        "near");
  wrong(changed([](DomeMesh& d) { d.vertices.col(2) = d.vertices.col(1); }), "no area");
  wrong(changed([](DomeMesh& d) { d.vertices(0, 7) = std::nan(""); }), "not finite");
  wrong(changed([](DomeMesh& d) { d.triangles.front()[1] = 99999; }), "got vertex 99999");
  wrong({Eigen::Matrix3Xd(3, 0), {}}, "without a triangle");
  const DomeMesh one = cap();
  const int count = int(one.vertices.cols());
  DomeMesh two{Eigen::Matrix3Xd(3, 2 * count), one.triangles};
  two.vertices << one.vertices, one.vertices.colwise() + Eigen::Vector3d(300, 0, 0);
  for (const auto& [a, b, c] : one.triangles)
    two.triangles.push_back({a + count, b + count, c + count});
  wrong(two, "in several pieces");
  // the pole moved over its neighbours
  wrong(changed([](DomeMesh& d) { d.vertices(0, 0) += 14; }), "near (");
}

TEST_CASE("a sheet that runs through itself is refused, one with a single side too") {
  // a ribbon that runs through its own start
  const auto ribbon = [](auto place, int around, bool closed, bool turned) {
    DomeMesh mesh{Eigen::Matrix3Xd(3, 4 * around), {}};
    for (int k = 0; k < around; ++k)
      for (int w = 0; w < 4; ++w) mesh.vertices.col(4 * k + w) = place(k, w);
    for (int k = 0; k + (closed ? 0 : 1) < around; ++k)
      for (int w = 0; w < 3; ++w) {
        const bool last = k + 1 == around;
        const auto next = [&](int v) { return last ? (turned ? 3 - v : v) : 4 * (k + 1) + v; };
        mesh.triangles.push_back({4 * k + w, next(w), next(w + 1)});
        mesh.triangles.push_back({4 * k + w, next(w + 1), 4 * k + w + 1});
      }
    return mesh;
  };
  const auto loop = ribbon(
      [](int k, int w) {
        const double t = 0.1 * k;
        return Eigen::Vector3d(50 * std::cos(t) + 12 * t, 6.3 * w, 50 * std::sin(2 * t));
      },
      64, false, false);
  wrong(loop, "runs through itself near");
  const auto strip = ribbon(
      [](int k, int w) {
        const double t = 2 * M_PI * k / 60, s = 6 * (w - 1.5);
        return Eigen::Vector3d((60 + s * std::cos(t / 2)) * std::cos(t),
                               (60 + s * std::cos(t / 2)) * std::sin(t), s * std::sin(t / 2));
      },
      60, true, true);
  wrong(strip, "one side only");
}
