// One shell held in one hand through everything that a hand does.
#include "engine/session/session.h"

#include <catch2/catch.hpp>

using namespace gridshell;

namespace {

std::shared_ptr<const Scene> scene(double tolerance = 1e-3) {
  preset::Preset p;
  p.footprint.rods = 6;
  p.footprint.radius_mm = 20 * (2.5 + 0.8);
  p.actuation.radius_mm = 0.8 * p.footprint.radius_mm;
  p.rod.density_kg_m3 = 6450;
  p.accuracy.tolerance = tolerance;
  return std::make_shared<const Scene>(scene_of(p).value());
}

Session open(const std::shared_ptr<const Scene>& scene) {
  return Session::open(scene, plan_levels(scene->tolerance)).value();
}

Session actuated(const std::shared_ptr<const Scene>& scene) {
  Session session = open(scene);
  const Watch watch;
  REQUIRE(session.begin_buckled(0.02, watch).value().end == Outcome::reached);
  REQUIRE(session.move_to(1, watch).end == Outcome::reached);
  return session;
}

void certified(const Session& session, const Report& report) {
  CAPTURE(words_of(report.end).name, report.t, report.certificate.residual_N);
  REQUIRE(report.end == Outcome::reached);
  CHECK(report.certificate.stable());
  CHECK(report.certificate.residual_N < 1e-3);  // of corrections below 1e-4 mm
  CHECK(report.certificate.error_estimate_mm < 1e-2 * session.scene().length_scale_mm);
  CHECK(report.effort.factorizations > 0);
}

/// the circle's edge points on an ellipse of the actuated size
BoundaryMotion ellipse(const Scene& scene) {
  BoundaryMotion motion = scene.motion;
  motion.begin = motion.end;
  motion.end.row(0) *= 1.06;
  motion.end.row(1) *= 0.96;
  return motion;
}

}  // namespace

TEST_CASE("a session goes through all that a hand does, and back by its checkpoints to the bit") {
  const auto shell = scene();
  Session session = open(shell);
  const Watch watch;
  std::vector<Checkpoint> kept;
  std::vector<Eigen::Matrix3Xd> nodes;
  std::vector<double> energies;
  const auto keep = [&](const Report& report) {
    certified(session, report);
    kept.push_back(session.save());
    nodes.push_back(session.nodes());
    energies.push_back(session.energies().total());
  };
  keep(session.begin_buckled(0.02, watch).value());
  keep(session.move_to(1, watch));
  keep(session.rebase(ellipse(*shell), watch));
  const Eigen::Vector3d down(0, 0, -0.4);
  keep(session.push(7, down, Across::free, watch));
  CHECK((session.nodes().col(7) - nodes[2].col(7)).z() == Approx(-0.4).margin(1e-2));
  keep(session.push(12, down, Across::held, watch));
  CHECK(session.holds().size() == 2);
  CHECK(std::abs(session.force(0).z()) > 1e-4);
  keep(session.release(7, watch));
  CHECK(session.holds().size() == 1);
  keep(session.release(12, watch));
  CHECK(session.holds().empty());
  // let go, it is where it was before it was pushed
  CHECK(largest_column(session.nodes() - nodes[2]) < 1e-3);
  std::vector<NodeAction> field;
  for (int joint = 0; joint < 12; ++joint) field.push_back({joint, {0, 2e-5, -1e-4}});
  keep(session.set_field(field, watch));
  CHECK(largest_column(session.nodes() - nodes[2]) > 1e-2);
  CHECK(session.energies()[Term::load] != 0);
  keep(session.rest(watch));
  CHECK(largest_column(session.nodes() - nodes[7]) < 1e-4);
  keep(session.set_field({}, watch));
  CHECK(largest_column(session.nodes() - nodes[2]) < 1e-3);

  for (std::size_t k = kept.size(); k-- > 0;) {
    session.restore(kept[k]);
    CAPTURE(k);
    CHECK(session.nodes() == nodes[k]);
    CHECK(session.energies().total() == energies[k]);
    CHECK(session.save().state.levels[0].x == kept[k].state.levels[0].x);
  }
  // and on from there as before
  session.restore(kept[1]);
  certified(session, session.rebase(ellipse(*shell), watch));
  CHECK(largest_column(session.nodes() - nodes[2]) < 1e-6);
}

TEST_CASE("a session refines on request and takes other rods from where it is") {
  const auto shell = scene(1e-2);
  Session session = actuated(shell);
  const Watch watch;
  const double coarse = session.certificate().error_estimate_mm;
  const Checkpoint before = session.save();
  certified(session, session.refine(1e-2 * coarse, watch));
  CHECK(session.certificate().error_estimate_mm <= 1e-2 * coarse);
  session.restore(before);
  CHECK(session.certificate().error_estimate_mm == coarse);
  const double bend = session.energies()[Term::bend];
  const auto thicker = session.set_rods(circular_section(0.3, 83), watch);
  REQUIRE(thicker);
  certified(session, *thicker);
  CHECK(session.energies()[Term::bend] == Approx(bend * std::pow(0.3 / 0.254, 4)).epsilon(1e-2));
  CHECK_FALSE(session.set_rods(RodSection{-1, 1}, watch));
  certified(session, session.move_to(0.95, watch));
}

TEST_CASE("what fails leaves the last certified state, what is cancelled says so") {
  const auto shell = scene();
  Session session = actuated(shell);
  Watch watch;
  const Eigen::Matrix3Xd before = session.nodes();
  watch.cancel();
  CHECK(session.push(7, {0, 0, -5}, Across::free, watch).end == Outcome::cancelled);
  CHECK(largest_column(session.nodes() - before) < 1e-6);
  // outwards the rods come to their length: it stops there, certified
  const Watch patient;
  const Report pulled = session.push(0, {0, 0, 60}, Across::free, patient);
  CHECK(pulled.end == Outcome::locked);
  CHECK(pulled.t < 1);
  CHECK(pulled.certificate.stable());
  CHECK(pulled.certificate.largest_strain < 1.1 * shell->max_strain);
}

TEST_CASE("a shell in motion comes to rest where the static solver finds it") {
  const auto shell = scene();
  Session session = actuated(shell);
  const Watch watch;
  const Eigen::Matrix3Xd before = session.nodes();
  int seen = 0;
  certified(session, session.rest_in_time(watch, [&](const MovingState&) { ++seen; }));
  CHECK(seen > 0);
  CHECK(largest_column(session.nodes() - before) < 1e-5);
}
