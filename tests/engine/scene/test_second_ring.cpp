// Tails outside the boundary whose far ends have the net's tangents.
#include <cmath>

#include "engine/scene/rod_ends.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset ringed(double cut_height, double tail_mm) {
  preset::Preset p = cap(cut_height);
  p.ends.second_ring_mm = tail_mm;
  return p;
}

/// largest and mean distance of the joints from the sphere about the origin, per cent
Eigen::Vector2d off_sphere(const Simulation& session) {
  const int joints = session.shell().finest().joints;
  const Eigen::ArrayXd off =
      (session.nodes().leftCols(joints).colwise().norm().array() - 120).abs().transpose();
  return 100.0 / 120 * Eigen::Vector2d(off.maxCoeff(), off.mean());
}

Eigen::Vector2d at_rest(double tail_mm) {
  return off_sphere(on_its_net(shared_scene(ringed(0, tail_mm)), 32));
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
  const auto scene = shared_scene(ringed(0.3, 0));
  for (const auto family : {Family::u, Family::v})
    for (const Eigen::Vector2d& uv : {Eigen::Vector2d(20, 30), Eigen::Vector2d(-90, 40)})
      for (const double inwards : {1.0, -1.0}) {
        const auto curvature = value_of(rod_curvature(*scene->net, family, uv, inwards));
        const auto point = scene->net->at(uv.x(), uv.y());
        // the normal part is 1/rho whatever the rod's direction
        CHECK(curvature.dot(point->position) / 120 == Approx(-1.0 / 120).epsilon(1e-6));
        const auto& along = family == Family::u ? point->tangent_u : point->tangent_v;
        CHECK(std::abs(curvature.dot(along)) < 1e-6);
      }
}

TEST_CASE("a second ring of 10 mm keeps the hemisphere on its sphere", "[standard]") {
  const Eigen::Vector2d without = at_rest(0), with = at_rest(10);
  CHECK(without[0] == Approx(3.10).margin(0.01));
  CHECK(without[1] == Approx(0.86).margin(0.01));
  CHECK(with[0] <= 0.03);
  CHECK(with[1] <= 0.01);
}

TEST_CASE("on the path from the flat far ends turn about their edge points at the tails' length") {
  const auto scene = shared_scene(ringed(0.6, 10));
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

TEST_CASE("a cap with a second ring reaches one state from the flat, from the net and twisted",
          "[standard]") {
  auto preset = ringed(0.6, 10);
  const Simulation from_net = on_its_net(shared_scene(preset), 8);
  preset.actuation.start = preset::Start::flat;
  Simulation from_flat = value_of(Simulation::open(shared_scene(preset), plan_of_mesh(8)));
  REQUIRE(from_flat.begin_buckled(0.01, unwatched)->end == Outcome::reached);
  REQUIRE(from_flat.go(1, unwatched).end == Outcome::reached);
  CHECK(max_column_norm(from_net.nodes() - from_flat.nodes()) < 1e-5);

  preset = ringed(0.6, 8);
  const Simulation plain = on_its_net(shared_scene(preset), 4);
  preset.rod.shear_GPa = 31;
  preset.accuracy.model = RodModel::twist;
  const Simulation twisted = on_its_net(shared_scene(preset), 4);
  CHECK(max_column_norm(twisted.nodes() - plain.nodes()) < 1e-5);
}

TEST_CASE(
    "a second ring is refused where there is no net, or where directions are prescribed already") {
  const auto refused = [](const std::string& text, const char* reason) {
    CHECK_THAT(preset::errors_of(text), Catch::Contains(reason));
  };
  refused("[ends]\nsecond_ring_mm = 10.0\n", "this footprint has none");
  refused("[footprint]\nkind = \"net\"\n[ends]\nkind = \"tangent\"\nsecond_ring_mm = 10.0\n",
          "prescribed already");
  refused("[footprint]\nkind = \"net\"\n[ends]\nsecond_ring_mm = -1.0\n", "out of range");
}
