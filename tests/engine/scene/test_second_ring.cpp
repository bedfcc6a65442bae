// Tails beyond the boundary whose far ends keep the net's tangents.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/preset/preset_file.h"
#include "engine/scene/rod_ends.h"
#include "engine/simulate/simulation.h"

using namespace gridshell;

namespace {

preset::Preset cap(double cut_height, double tail_mm) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = preset::Placement::on_axis;
  p.net.radius_mm = 120;
  p.net.cut_height = cut_height;
  p.actuation.start = preset::Start::net;
  p.ends.second_ring_mm = tail_mm;
  return p;
}

std::shared_ptr<const Scene> scene_with(const preset::Preset& preset) {
  auto scene = scene_of(preset);
  REQUIRE(scene.has_value());
  return std::make_shared<const Scene>(std::move(*scene));
}

/// largest and mean distance of the joints from the sphere about the origin, per cent
Eigen::Vector2d off_sphere(const Simulation& session) {
  const int joints = session.shell().finest().joints;
  const Eigen::ArrayXd off =
      (session.nodes().leftCols(joints).colwise().norm().array() - 120).abs().transpose();
  return 100.0 / 120 * Eigen::Vector2d(off.maxCoeff(), off.mean());
}

Eigen::Vector2d at_rest(double tail_mm, const LevelPlan& plan) {
  auto session = Simulation::open(scene_with(cap(0, tail_mm)), plan);
  REQUIRE(session.has_value());
  const auto begun = session->begin_on_net(unwatched);
  REQUIRE(begun.has_value());
  CHECK(begun->end == Outcome::reached);
  CHECK(begun->certificate.stable());
  return off_sphere(*session);
}

}  // namespace

TEST_CASE("a cantilever whose tip is at its far end has the net's curvature at its root") {
  // small deflections: y = k (s^2/2 - s^3/(6 l)) ends at k l^2/3 and begins with curvature k
  const double l = 10, k = 1e-4;
  const Eigen::Vector3d end(3, 2, 1), out = Eigen::Vector3d::UnitX(),
                                      curvature = k * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d far = far_end(end, out, curvature, l) - end;
  CHECK(far.z() == Approx(k * (l * l / 2 - l * l / 6)).epsilon(1e-12));
  // its arc length is l: the chord is shorter by the integral of y'^2/2 = k^2 l^3/15
  CHECK(l - far.x() == Approx(k * k * l * l * l / 15).epsilon(1e-9));
}

TEST_CASE("rods on a sphere curve towards its centre, in the middle of the net and at its edge") {
  const auto scene = scene_with(cap(0.3, 0));
  for (const auto family : {Family::u, Family::v})
    for (const Eigen::Vector2d& uv : {Eigen::Vector2d(20, 30), Eigen::Vector2d(-90, 40)})
      for (const double inwards : {1.0, -1.0}) {
        const auto curvature = rod_curvature(*scene->net, family, uv, inwards);
        REQUIRE(curvature.has_value());
        const auto point = scene->net->at(uv.x(), uv.y());
        // the normal part is 1/rho whatever the rod's direction
        CHECK(curvature->dot(point->position) / 120 == Approx(-1.0 / 120).epsilon(1e-6));
        const auto& along = family == Family::u ? point->tangent_u : point->tangent_v;
        CHECK(std::abs(curvature->dot(along)) < 1e-6);
      }
}

TEST_CASE("a second ring of 10 mm keeps the hemisphere on its sphere", "[standard]") {
  const Eigen::Vector2d without = at_rest(0, plan_of_mesh(32)),
                        with = at_rest(10, plan_of_mesh(32));
  CHECK(without[0] == Approx(3.10).margin(0.01));
  CHECK(without[1] == Approx(0.86).margin(0.01));
  CHECK(with[0] <= 0.03);
  CHECK(with[1] <= 0.01);
}

TEST_CASE("on the way from the flat far ends turn about their edge points at the tails' length") {
  const auto scene = scene_with(cap(0.6, 10));
  const RodMesh mesh = mesh_rods(scene->footprint, 4);
  const PinnedMotion motion = pinned_motion(mesh, scene->motion);
  CHECK(motion.turns.size() == std::size_t(mesh.edge_points));
  for (double t = 0; t <= 1; t += 0.125) {
    const Eigen::Matrix3Xd x = motion.at(t), rate = motion.rate(t);
    const double h = 1e-5;
    const Eigen::Matrix3Xd difference = (motion.at(t + h) - motion.at(t - h)) / (2 * h);
    CHECK((rate - difference).colwise().norm().maxCoeff() < 1e-6);
    for (const EndRotation& turn : motion.turns)
      CHECK((x.col(turn.node) - x.col(turn.about)).norm() == Approx(10).epsilon(2e-4));
  }
  for (int end = 0; end < mesh.edge_points; ++end) {
    const int far = mesh.far_ends[std::size_t(end)];
    CHECK((motion.at(0).col(far) - scene->motion.begin_far.col(end)).norm() < 1e-12);
    CHECK((motion.at(1).col(far) - scene->motion.end_far.col(end)).norm() < 1e-12);
  }
}

TEST_CASE("a cap with a second ring comes to one state from the flat and from the net",
          "[standard]") {
  auto preset = cap(0.6, 10);
  const LevelPlan plan = plan_of_mesh(8);
  auto from_net = Simulation::open(scene_with(preset), plan);
  REQUIRE(from_net.has_value());
  REQUIRE(from_net->begin_on_net(unwatched)->end == Outcome::reached);
  preset.actuation.start = preset::Start::flat;
  auto from_flat = Simulation::open(scene_with(preset), plan);
  REQUIRE(from_flat.has_value());
  REQUIRE(from_flat->begin_buckled(0.01, unwatched)->end == Outcome::reached);
  REQUIRE(from_flat->go(1, unwatched).end == Outcome::reached);
  CHECK((from_net->nodes() - from_flat->nodes()).colwise().norm().maxCoeff() < 1e-5);
}

TEST_CASE("a second ring of rods that may twist gives the same shell", "[standard]") {
  auto twisted = cap(0.6, 8);
  twisted.rod.shear_GPa = 31;
  twisted.accuracy.model = RodModel::twist;
  auto session = Simulation::open(scene_with(twisted), plan_of_mesh(4));
  REQUIRE(session.has_value());
  const auto begun = session->begin_on_net(unwatched);
  REQUIRE(begun.has_value());
  CHECK(begun->end == Outcome::reached);
  auto plain = Simulation::open(scene_with(cap(0.6, 8)), plan_of_mesh(4));
  REQUIRE(plain->begin_on_net(unwatched)->end == Outcome::reached);
  CHECK((session->nodes() - plain->nodes()).colwise().norm().maxCoeff() < 1e-5);
}

TEST_CASE("a second ring is refused where there is no net, or where directions are held already") {
  const auto refused = [](const std::string& text, const char* reason) {
    const auto read = preset::read_preset_text(text, "p.toml", "p");
    REQUIRE_FALSE(read.has_value());
    CHECK(read.error().message.find(reason) != std::string::npos);
  };
  refused("[ends]\nsecond_ring_mm = 10.0\n", "this footprint has none");
  refused("[footprint]\nkind = \"net\"\n[ends]\nkind = \"tangent\"\nsecond_ring_mm = 10.0\n",
          "held already");
  refused("[footprint]\nkind = \"net\"\n[ends]\nsecond_ring_mm = -1.0\n", "out of range");
}
