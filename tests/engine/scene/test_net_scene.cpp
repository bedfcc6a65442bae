// Shells designed on Chebyshev nets: footprints, boundaries, deviations, and both ways to start.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/scene/scene.h"
#include "engine/simulate/run.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset cap(double cut_height, preset::Placement placement, preset::Start start) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = placement;
  p.net.radius_mm = 120;
  p.net.cut_height = cut_height;
  p.actuation.start = start;
  p.movie.frames = 2;
  return p;
}

preset::Preset surface(preset::NetKind kind, double radius, double length) {
  preset::Preset p = cap(0, preset::Placement::on_axis, preset::Start::net);
  p.net.kind = kind;
  p.net.radius_mm = radius;
  p.net.length_mm = length;
  return p;
}

}  // namespace

TEST_CASE("the scene of a cap: its boundary maps to the circle at z*, edge points with it") {
  const auto scene = scene_of(cap(0.3, preset::Placement::half, preset::Start::net));
  REQUIRE(scene.has_value());
  const double z = 0.3 * 120, r = 120 * std::sqrt(1 - 0.09);
  for (const Eigen::Matrix3Xd* points : {&scene->motion.end, &scene->actuated_boundary}) {
    CHECK((points->row(2).array() - z).abs().maxCoeff() < 1e-10);
    CHECK((points->topRows(2).colwise().norm().array() - r).abs().maxCoeff() < 1e-10);
  }
  // flat, in the plane of the actuated boundary
  CHECK((scene->motion.begin.row(2).array() - z).abs().maxCoeff() == 0);
  CHECK((scene->original_boundary.row(2).array() - z).abs().maxCoeff() == 0);
  CHECK(scene->length_scale_mm == 120);
}

TEST_CASE("the hemisphere on the axes, converged: deviation, total curvature and energy") {
  preset::Preset p = cap(0, preset::Placement::on_axis, preset::Start::net);
  p.accuracy.tolerance = 1e-7;
  const record::Summary s = run_stills(p).summary;
  CHECK(s.stable);
  CHECK(s.limit == record::Limit::none);
  CHECK(100 * s.max_deviation == Approx(3.1029).margin(5e-5));
  CHECK(100 * s.mean_deviation == Approx(0.9955).margin(5e-5));
  CHECK(s.total_K == Approx(6.01157).margin(5e-6));
  CHECK(s.energies[Term::bend] + s.energies[Term::stretch] == Approx(8.07123).margin(5e-6));
  CHECK(s.error_estimate_mm < 1e-7 * 120);
}

TEST_CASE("from flat and from the net a cap comes to the same state") {
  for (const auto placement : {preset::Placement::on_axis, preset::Placement::half}) {
    const simulate::ExperimentResult net = run_stills(cap(0.5, placement, preset::Start::net));
    const simulate::ExperimentResult flat = run_stills(cap(0.5, placement, preset::Start::flat));
    const auto& a = net.trajectory.frames.back().nodes;
    const auto& b = flat.trajectory.frames.back().nodes;
    REQUIRE(a.cols() == b.cols());
    CHECK((a - b).colwise().norm().maxCoeff() < 1e-6 * 120);
    CHECK(net.summary.max_deviation == Approx(flat.summary.max_deviation).margin(1e-7));
  }
}

TEST_CASE("from flat, through snaps, and from the net a saddle comes to the same state") {
  preset::Preset p = surface(preset::NetKind::spool, 120, 180);
  p.net.waist = 0.6;
  const simulate::ExperimentResult net = run_stills(p);
  p.actuation.start = preset::Start::flat;
  const simulate::ExperimentResult flat = run_stills(p);
  CHECK(net.summary.limit == record::Limit::none);
  CHECK(flat.summary.limit == record::Limit::snap);
  CHECK(flat.summary.stable);
  const Eigen::Index joints = net.summary.joints;
  const auto& a = net.trajectory.frames.back().nodes;
  const auto& b = flat.trajectory.frames.back().nodes;
  // what happened on the way from flat asked for finer meshes
  CHECK((a.leftCols(joints) - b.leftCols(joints)).colwise().norm().maxCoeff() <
        net.summary.error_estimate_mm + flat.summary.error_estimate_mm);
}

TEST_CASE("Beltrami's pseudosphere: stable, its cells negative on the whole") {
  preset::Preset p = surface(preset::NetKind::beltrami, 120, 70);
  p.net.waist = 0.6;
  p.net.crossing_deg = 60;
  const simulate::ExperimentResult shell = run_stills(p);
  CHECK(shell.summary.stable);
  CHECK(shell.summary.limit == record::Limit::none);
  CHECK(shell.summary.total_K < 0);
  CHECK(shell.summary.max_deviation < 0.03);
}

TEST_CASE("a cylinder whose ends are held along the helices is its net, to second order") {
  double before = 0;
  for (const int edges : {4, 8, 16}) {
    preset::Preset p = surface(preset::NetKind::cylinder, 80, 200);
    p.ends.kind = preset::EndKind::tangent;
    p.accuracy.edges_per_segment = edges;
    const record::Summary s = run_stills(p).summary;
    CHECK(s.stable);
    if (before > 0) CHECK(std::log2(before / s.max_deviation) == Approx(2).margin(0.15));
    before = s.max_deviation;
  }
  CHECK(before < 1e-4);
}

TEST_CASE("a saddle's cells are negative over most of the arch, a cylinder's near zero") {
  preset::Preset p = surface(preset::NetKind::spool, 120, 180);
  p.net.waist = 0.6;
  const simulate::ExperimentResult saddle = run_stills(p);
  const auto K = [](const simulate::ExperimentResult& outcome) -> Eigen::ArrayXd {
    return outcome.trajectory.frames.back().cell_K.array();
  };
  CHECK(saddle.summary.stable);
  CHECK((K(saddle) < 0).count() > 0.6 * double(K(saddle).size()));
  const simulate::ExperimentResult cylinder =
      run_stills(surface(preset::NetKind::cylinder, 80, 200));
  CHECK(std::abs(K(cylinder).mean()) < 0.2 * std::abs(K(saddle).mean()));
  CHECK((K(run_stills(cap(0, preset::Placement::on_axis, preset::Start::net))) > 0).all());
}

TEST_CASE("end rings let go: their ends are free, the others still held, the state stable") {
  preset::Preset p = surface(preset::NetKind::cylinder, 80, 200);
  p.ends.rings = preset::Rings::free;
  const auto scene = scene_of(p);
  REQUIRE(scene.has_value());
  int free = 0;
  for (std::size_t r = 0; r < scene->footprint.rods.size(); ++r) {
    const FootprintRod& rod = scene->footprint.rods[r];
    for (const bool begin : {true, false}) {
      const RodEnd held = begin ? rod.begin : rod.end;
      const Eigen::Vector3d at = scene->motion.end.col(2 * Eigen::Index(r) + (begin ? 0 : 1));
      CHECK((held == RodEnd::free) == (std::abs(at.x()) > 100 - 1e-6 && at.z() > 1e-6));
      free += held == RodEnd::free;
    }
  }
  CHECK(free > 4);
  const record::Summary s = run_stills(p).summary;
  CHECK(s.stable);
  CHECK(s.residual_N < 1e-8);
}

TEST_CASE("a net that does not exist, and a circle asked to start from one, are refused") {
  preset::Preset p = cap(0, preset::Placement::on_axis, preset::Start::net);
  p.net.kind = preset::NetKind::beltrami;
  p.net.waist = 1.5;
  const auto scene = scene_of(p);
  REQUIRE_FALSE(scene.has_value());
  CHECK(scene.error().fault == Fault::bad_input);
}
