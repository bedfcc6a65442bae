// How much of a mesh a net reaches, and the point where it is best started.
#include "engine/scene/mesh_net.h"

#include <fmt/ranges.h>

#include "engine/scene/scene.h"
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

preset::Preset on_mesh(const DomeMesh& mesh) {
  auto p = cap(0.3);
  p.net.kind = preset::NetKind::surface;
  for (const auto& v : mesh.vertices.colwise())
    p.net.file.vertices.push_back({v.x(), v.y(), v.z()});
  p.net.file.triangles = mesh.triangles;
  return p;
}

/// An L: two arms of 120 mm, 240 mm long, gently arched.
DomeMesh bent_strip() {
  DomeMesh mesh = grid_mesh(24, [](int i, int j) {
    return Eigen::Vector3d(10 * i, 10 * j, 30 - (i - 6) * (i - 6) / 8. - (j - 6) * (j - 6) / 9.);
  });
  // the squares from the middle on in both directions are left out
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] % 25 >= 12 && t[0] / 25 >= 12; });
  return mesh;
}

}  // namespace

TEST_CASE("points on a mesh represent all of its area, none far from the next") {
  const DomeMesh dome = ellipsoid_mesh({80, 60, 40}, 9);
  const auto mesh = value_of(TriangleMesh::make(dome.vertices, dome.triangles));
  double sum = 0;
  for (const AreaSample& one : area_samples(mesh, 4)) sum += one.area;
  CHECK(sum == Approx(1).epsilon(1e-12));
  CHECK(area_samples(mesh, 4).size() > 2 * area_samples(mesh, 8).size());
  // one of many small triangles represents those around it
  const auto few = area_samples(mesh, 60);
  CHECK(few.size() < mesh.triangles().size() / 8);
  sum = 0;
  for (const AreaSample& one : few) sum += one.area;
  CHECK(sum == Approx(1).epsilon(1e-12));
}

TEST_CASE("of the starts that reach almost the largest area one has the largest least angle",
          "[standard]") {
  auto p = on_mesh(bent_strip());
  p.net.apex = preset::NetApex::best;
  const NetStart area = value_of(scene_of(p)).mesh_net->start;
  p.net.apex = preset::NetApex::best_angle;
  const auto scene = value_of(scene_of(p));
  const NetStart& angle = scene.mesh_net->start;
  CAPTURE(area.reached, area.least_angle_deg, angle.reached, angle.least_angle_deg);
  CHECK(angle.least_angle_deg > area.least_angle_deg + 1e-3);
  CHECK(angle.reached > area.reached - 0.08);
  CHECK_THAT(fmt::format("{}", fmt::join(scene.mesh_net->sentences(), "\n")),
             Catch::Contains("rods cross there at "));
}

TEST_CASE("a net on an L goes around its corner, and says what it reaches", "[standard]") {
  auto p = on_mesh(bent_strip());
  p.net.apex = preset::NetApex::best;
  const auto scene = value_of(scene_of(p));
  REQUIRE(scene.mesh_net);
  CHECK(scene.mesh_net->start.reached > 0.95);
  CHECK(scene.mesh_net->second.has_value());
  const std::string all = fmt::format("{}", fmt::join(scene.mesh_net->sentences(), "\n"));
  CHECK_THAT(all, Catch::Contains("the net reaches ") && Catch::Contains("second best") &&
                      Catch::Contains("off the mesh's vertices"));
  // both arms to their ends, and nothing in the corner between
  const Eigen::Matrix3Xd& ends = scene.motion.end;
  CHECK(ends.row(0).maxCoeff() == Approx(240).margin(2));
  CHECK(ends.row(1).maxCoeff() == Approx(240).margin(2));
  CHECK((ends.topRows<2>().array() > 122).colwise().all().count() == 0);
  // flat rods are as long as their curves on the net
  const auto lines = value_of(rods_on_net(scene, 0.5));
  REQUIRE(lines.size() == scene.footprint.rods.size());
  for (std::size_t r = 0; r < lines.size(); ++r) {
    double length = 0;
    for (Eigen::Index k = 1; k < lines[r].cols(); ++k)
      length += (lines[r].col(k) - lines[r].col(k - 1)).norm();
    const Interval& span = scene.footprint.rods[r].span;
    CHECK(length == Approx(span.end - span.begin).epsilon(2e-3));
  }
}

TEST_CASE("what rods too close to parallel leave out is said with the reason", "[standard]") {
  // most of a ball, whose net folds past the equator
  auto p = on_mesh(ellipsoid_mesh({90, 90, 90}, 8, 2.3));
  p.net.least_angle_deg = 40;
  const auto scene = value_of(scene_of(p));
  const MeshNetReport& net = *scene.mesh_net;
  CHECK(net.start.least_angle_deg > 38);
  CHECK(net.start.reached < 0.95);
  CHECK(net.start.reached > 0.5);
  CHECK(net.reasons().front().first == RodStop::angle);
  double left = 0;
  for (const auto& [why, fraction] : net.reasons()) left += fraction;
  CHECK(left == Approx(1 - net.start.reached).epsilon(1e-9));
  // a smaller angle leaves less
  p.net.least_angle_deg = 20;
  CHECK(value_of(scene_of(p)).mesh_net->start.reached > net.start.reached + 0.02);
}

TEST_CASE("a mesh that is not smooth is fitted as closely as it can be, or refused by fit_mm") {
  DomeMesh rough = ellipsoid_mesh({100, 100, 50}, 9, 1.2);
  for (Eigen::Index k = 0; k < rough.vertices.cols(); ++k)
    rough.vertices(2, k) += 0.7 * std::sin(37. * double(k));
  auto p = on_mesh(rough);
  const auto scene = value_of(scene_of(p));
  CHECK(scene.mesh_net->fit_mm > 0.2);
  CHECK(scene.mesh_net->start.reached > 0.9);
  p.net.fit_mm = 0.01;
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("got fit_mm = 0.01, expected at least"));
}
