// Shells designed on Chebyshev nets: footprints, boundaries, deviations, and both kinds of start.
#include <cmath>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

TEST_CASE("the scene of a cap: its boundary maps to the circle at z*, edge points with it") {
  preset::Preset half = cap(0.3);
  half.footprint.placement = Placement::half;
  const auto scene = value_of(scene_of(half));
  const double z = 0.3 * 120, r = 120 * std::sqrt(1 - 0.09);
  for (const Eigen::Matrix3Xd* points : {&scene.motion.end, &scene.actuated_boundary}) {
    CHECK((points->row(2).array() - z).abs().maxCoeff() < 1e-10);
    CHECK((points->topRows(2).colwise().norm().array() - r).abs().maxCoeff() < 1e-10);
  }
  // flat, in the plane of the actuated boundary
  CHECK((scene.motion.begin.row(2).array() - z).abs().maxCoeff() == 0);
  CHECK((scene.original_boundary.row(2).array() - z).abs().maxCoeff() == 0);
  CHECK(scene.length_scale_mm == 120);
}

TEST_CASE("the hemisphere on the axes, converged: deviation, total curvature and energy") {
  preset::Preset p = on_net();
  p.accuracy.tolerance = 1e-7;
  const record::Summary s = run_to_end(p, true).summary;
  CHECK(100 * s.max_deviation == Approx(3.1029).margin(5e-5));
  CHECK(100 * s.mean_deviation == Approx(0.9955).margin(5e-5));
  CHECK(s.total_K == Approx(6.01157).margin(5e-6));
  CHECK(s.energies[Term::bend] + s.energies[Term::stretch] == Approx(8.07123).margin(5e-6));
  CHECK(s.error_estimate_mm < 1e-7 * 120);
}

TEST_CASE("from flat and from the net a cap reaches the same state") {
  for (const auto placement : {Placement::on_axis, Placement::half}) {
    preset::Preset p = cap(0.5);
    p.footprint.placement = placement;
    const auto net = run_stills(p);
    p.actuation.start = preset::Start::flat;
    const auto flat = run_stills(p);
    REQUIRE(last_frame(net).nodes.cols() == last_frame(flat).nodes.cols());
    CHECK(max_column_norm(last_frame(net).nodes - last_frame(flat).nodes) < 1e-6 * 120);
    CHECK(net.summary.max_deviation == Approx(flat.summary.max_deviation).margin(1e-7));
  }
}

TEST_CASE("from flat, through snaps, and from the net a saddle reaches the same state") {
  const auto net = run_stills(spool()), flat = run_stills(spool(preset::Start::flat));
  CHECK(net.summary.limit == record::Limit::none);
  CHECK(flat.summary.limit == record::Limit::snap);
  CHECK(flat.summary.stable);
  // events on the path from flat required finer meshes
  CHECK(distance(net, flat) < net.summary.error_estimate_mm + flat.summary.error_estimate_mm);
}

TEST_CASE("Beltrami's pseudosphere: stable, its cells negative on the whole") {
  preset::Preset p = on_net(preset::NetKind::beltrami, 120, 70);
  p.net.waist = 0.6;
  p.net.crossing_deg = 60;
  const auto shell = run_to_end(p, true);
  CHECK(shell.summary.total_K < 0);
  CHECK(shell.summary.max_deviation < 0.03);
}

TEST_CASE("end rings released: their ends are free, the others still fixed, the state stable") {
  preset::Preset p = on_net(preset::NetKind::cylinder, 80, 200);
  p.ends.rings = preset::Rings::free;
  const auto scene = value_of(scene_of(p));
  int free = 0;
  for (std::size_t r = 0; r < scene.footprint.rods.size(); ++r) {
    const FootprintRod& rod = scene.footprint.rods[r];
    for (const bool begin : {true, false}) {
      const RodEnd held = begin ? rod.begin : rod.end;
      const Eigen::Vector3d at = scene.motion.end.col(2 * Eigen::Index(r) + (begin ? 0 : 1));
      CHECK((held == RodEnd::free) == (std::abs(at.x()) > 100 - 1e-6 && at.z() > 1e-6));
      free += held == RodEnd::free;
    }
  }
  CHECK(free > 4);
  const record::Summary s = run_stills(p).summary;
  CHECK(s.stable);
  CHECK(s.residual_N < 1e-8);
}

TEST_CASE("a net that does not exist is refused") {
  preset::Preset p = on_net();
  p.net.kind = preset::NetKind::beltrami;
  p.net.waist = 1.5;
  CHECK(refusal(scene_of(p)) == "the pseudosphere's waist: got 1.5, expected between 0 and 1");
}
