// Axial forces, curvature and reactions of frames: what they must add up to.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset four_rods() {
  preset::Preset p = circle(4, 42, 36);
  p.accuracy.edges_per_segment = 4;
  return p;
}

Eigen::Vector3d sum_of(const record::Frame& frame) { return frame.reactions_N.rowwise().sum(); }

/// What a value at every place of the rods comes to over their length.
template <class Value>
double over_rods(const record::Trajectory& run, const Value& value) {
  const auto& nodes = run.frames.back().nodes;
  double sum = 0;
  Eigen::Index at = 0;
  for (const auto& rod : run.layout.rods)
    for (std::size_t k = 0; k < rod.size(); ++k, ++at) {
      const auto edge = [&](std::size_t n) {
        return n == 0 || n == rod.size() ? 0.0 : (nodes.col(rod[n]) - nodes.col(rod[n - 1])).norm();
      };
      sum += value(at) * 0.5 * (edge(k) + edge(k + 1));
    }
  CHECK(at == run.frames.back().bending_mJ_per_m.size());
  return sum;
}

}  // namespace

TEST_CASE("reactions carry the loads, and nothing where there are none") {
  preset::Preset p = four_rods();
  const auto unloaded = run(p);
  const record::Frame& free = unloaded.trajectory.frames.back();
  REQUIRE(free.reactions_N.cols() == Eigen::Index(unloaded.trajectory.layout.supports.size()));
  CHECK(sum_of(free).norm() < 1e-9);
  CHECK(free.reactions_N.colwise().norm().maxCoeff() > 1e-3);
  p.loads.points = {{0, 0, 0, 0.01, -0.02}, {-1, 0, 0.003, 0, 0}};
  const auto loaded = run(p);
  const Eigen::Vector3d loads(0.003, 0.01, -0.02);
  CHECK((sum_of(loaded.trajectory.frames.back()) + loads).norm() < 1e-9);
}

TEST_CASE("curvature gives the bending energy, stretch the axial force, as one mesh has them") {
  const auto outcome = run(four_rods());
  const record::Frame& frame = last_frame(outcome);
  const double area = M_PI * 0.127 * 0.127, EA = 83e3 * area, EI = 83e3 * area * 0.127 * 0.127 / 4;
  const auto bending = [&](Eigen::Index at) {
    return 0.5 * EI * std::pow(frame.curvature_per_mm[at], 2);
  };
  CHECK(over_rods(outcome.trajectory, bending) == Approx(frame.energies[Term::bend]).epsilon(1e-4));
  // N^2 l / (2 EA), edge by edge
  double stretch = 0;
  Eigen::Index edge = 0;
  for (const auto& rod : outcome.trajectory.layout.rods)
    for (std::size_t k = 1; k < rod.size(); ++k, ++edge)
      stretch += 0.5 * std::pow(frame.axial_force_N[edge], 2) / EA *
                 (frame.nodes.col(rod[k]) - frame.nodes.col(rod[k - 1])).norm();
  CHECK(edge == frame.axial_force_N.size());
  CHECK(stretch == Approx(frame.energies[Term::stretch]).epsilon(1e-3));
  CHECK(frame.axial_force_N.minCoeff() < 0);
  // at a pinned end the reaction along the rod is its axial force
  edge = 0;
  for (const auto& rod : outcome.trajectory.layout.rods) {
    const Eigen::Vector3d along = (frame.nodes.col(rod[1]) - frame.nodes.col(rod[0])).normalized();
    CHECK(frame.reactions_N.col(rod[0]).dot(along) ==
          Approx(-frame.axial_force_N[edge]).margin(1e-9));
    edge += Eigen::Index(rod.size()) - 1;
  }
}

TEST_CASE("bending over length adds up to the bending energy, of any section and end") {
  preset::Preset p = four_rods();
  p.accuracy.edges_per_segment = 8;
  SECTION("round rods") {}
  SECTION("strips curved at rest") {
    p.rod.shear_GPa = 31;
    p.rod.width_mm = 0.4;
    p.rod.thickness_mm = 0.2;
    p.rod.curvature_per_mm = 0.004;
  }
  SECTION("clamped ends") {
    p.rod.shear_GPa = 31;
    p.ends.kind = preset::EndKind::clamped;
  }
  const auto outcome = run(p);
  const record::Frame& frame = last_frame(outcome);
  REQUIRE(frame.energies[Term::bend] > 0.01);
  const auto mJ_per_mm = [&](Eigen::Index at) { return 1e-3 * frame.bending_mJ_per_m[at]; };
  CHECK(over_rods(outcome.trajectory, mJ_per_mm) ==
        Approx(frame.energies[Term::bend]).epsilon(1e-4));
}

TEST_CASE("the reaction of a pushed joint is the force of its push on one mesh") {
  preset::Preset p = on_net(preset::NetKind::sphere, 60);
  p.footprint.placement = preset::Placement::half;
  p.indentation.depth = 0.05;
  p.accuracy.edges_per_segment = 4;
  const auto outcome = run(p);
  const record::Layout& layout = outcome.trajectory.layout;
  const record::Frame& frame = last_frame(outcome);
  REQUIRE(layout.loaded_joints.size() == 1);
  const auto& push = layout.loaded_joints.front();
  const Eigen::Vector3d holds = frame.reactions_N.col(push.joint);
  CHECK(holds.dot(push.direction) == Approx(frame.force_N).epsilon(1e-9));
  CHECK(sum_of(frame).norm() < 1e-8);
}

TEST_CASE("a net and what is in motion know no forces") {
  preset::Preset p = on_net(preset::NetKind::sphere, 60);
  p.footprint.placement = preset::Placement::half;
  p.accuracy.model = RodModel::net;
  p.accuracy.tolerance = 0.05;
  const auto outcome = run_stills(p);
  CHECK(last_frame(outcome).axial_force_N.size() == 0);
  CHECK(last_frame(outcome).bending_mJ_per_m.size() == 0);
  CHECK(last_frame(outcome).reactions_N.size() == 0);
}
