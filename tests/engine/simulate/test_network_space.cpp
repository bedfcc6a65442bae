// Networks drawn in space: their equilibria, for any rotation of the file.
#include <numbers>

#include "tests/engine/simulate/mixed_network.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

/// The shipped vault, every foot with its final position.
preset::NetworkData vault(double scale) {
  preset::NetworkData file = shipped("network_space").footprint.file;
  for (std::size_t k = 0; k < file.points.size(); ++k) {
    const auto& at = file.points[k];
    if (at[2] == 0) file.supports.push_back({double(k), scale * at[0], scale * at[1], 0});
  }
  return file;
}

}  // namespace

TEST_CASE(
    "a tent of two rods drawn in space has the equilibrium of the arches that a flat cross "
    "becomes") {
  const double a = 50, foot = 0.9 * a, height = std::sqrt(a * a - foot * foot);
  preset::Preset flat = network(cross(a, a), 8);
  flat.actuation.scale = 0.9;
  const auto actuated = run(flat);
  const auto relaxed = run_to_end(network(cross(foot, foot, height), 8));
  CHECK(relaxed.summary.energies[Term::bend] ==
        Approx(actuated.summary.energies[Term::bend]).epsilon(1e-8));
  CHECK(relaxed.summary.height_mm == Approx(actuated.summary.height_mm).epsilon(1e-8));
  // a level one is the flat one, at any height
  preset::NetworkData raised = cross(a, a);
  for (auto& point : raised.points) point[2] = 7;
  const auto scene = value_of(scene_of(network(raised, 8)));
  CHECK_FALSE(scene.from_drawing);
  CHECK(mesh_rods(scene.footprint, 8).height.size() == 0);
}

TEST_CASE("a vault drawn in space is the same however it is turned, moved supports and all") {
  const auto upright = run_to_end(network(vault(0.92), 4, 3));
  // the path starts from the equilibrium of the drawn shape, so every frame is certified
  REQUIRE(upright.trajectory.frames.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const record::Frame& frame = upright.trajectory.frames[k];
    CHECK(frame.progress == Approx(0.5 * double(k)));
    CHECK(frame.residual_N < 1e-4);
    CHECK(frame.negative_pivots == 0);
  }
  // the feet moved by keys are those moved by the file
  preset::Preset scaled = shipped("network_space");
  scaled.accuracy.edges_per_segment = 4;
  CHECK(run_stills(scaled).summary.energies[Term::bend] ==
        Approx(upright.summary.energies[Term::bend]).epsilon(1e-9));
  for (const double degrees : {30.0, 90.0}) {
    const Eigen::Matrix3d by = turn_about(degrees * std::numbers::pi / 180, {1, 0.3, 0});
    const auto other = run(network(moved(vault(0.92), by), 4));
    CAPTURE(degrees, other.summary.limit_reason);
    CHECK(other.summary.stable);
    CHECK(other.summary.energies[Term::bend] ==
          Approx(upright.summary.energies[Term::bend]).epsilon(1e-8));
  }
}

TEST_CASE("ends of a vault in space that prescribe directions, in both rod models, turned too") {
  std::vector<double> tangent;
  for (const auto kind : {preset::EndKind::tangent, preset::EndKind::clamped}) {
    preset::Preset p = network(vault(0.96), 4);
    p.rod.shear_GPa = 31;
    p.ends.kind = kind;
    const auto upright = run(p);
    CHECK(upright.summary.stable);
    p.footprint.file = moved(vault(0.96), turn_about(0.5, {1, 0.3, 0}));
    const auto other = run(p);
    CAPTURE(other.summary.limit_reason);
    CHECK(other.summary.energies.total() == Approx(upright.summary.energies.total()).epsilon(1e-7));
    tangent.push_back(upright.summary.energies.total());
  }
  // ends with prescribed twist store no less
  CHECK(tangent[1] >= tangent[0] * (1 - 1e-9));
}

TEST_CASE("straight strips laid flat by their geodesic lengths reach the sphere", "[standard]") {
  const auto outcome = run_to_end(shipped("lit_geodesic"), true);
  // the acute corners lie 40 degrees off the pole
  const Eigen::Vector3d middle(0, 0, -240 * std::cos(40 * std::numbers::pi / 180));
  const Eigen::VectorXd off =
      (joints_of(outcome.trajectory).colwise() - middle).colwise().norm().array() - 240;
  CHECK(off.cwiseAbs().maxCoeff() < 0.01 * 240);
  CHECK(off.cwiseAbs().mean() < 0.004 * 240);
  // 54.617 mm is the limit of meshes of 4 to 64 edges, at first order
  CHECK(outcome.summary.height_mm ==
        Approx(54.617).margin(1.1 * outcome.summary.error_estimate_mm));
  CHECK(outcome.summary.error_estimate_mm < 0.2);
}

TEST_CASE("a rigid corner of three rods that have no common plane bears loads as beams do") {
  constexpr double high = 80, arm = 50, force = 1e-3, EI = 8e4 * M_PI / 64;  // mm, N, N mm^2
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {0, 0, high}, {arm, 0, high}, {0, arm, high}};
  file.rods = {{0, 1}, {1, 2}, {1, 3}};
  file.supports = {{0}};
  file.free = {2, 3};
  file.end_constraints = {{0, 0, double(preset::EndKind::clamped)}};
  file.joint_laws = {{1, -1, -1}};
  preset::Preset p = network(file);
  p.rod.diameter_mm = 1, p.rod.young_GPa = 80, p.rod.shear_GPa = 30;
  p.accuracy.tolerance = 1e-4;
  const auto of_point = [=](const simulate::ExperimentResult& outcome, double x, double y) {
    const Eigen::Matrix3Xd& nodes = outcome.trajectory.frames.back().nodes;
    Eigen::Index nearest = 0;
    (nodes.colwise() - Eigen::Vector3d(x, y, high)).colwise().squaredNorm().minCoeff(&nearest);
    return Eigen::Vector3d(nodes.col(nearest));
  };
  const auto unloaded = run(p);
  CHECK(unloaded.summary.stable);
  CHECK(unloaded.summary.energies.total() < 1e-9);
  CHECK((of_point(unloaded, arm, 0) - Eigen::Vector3d(arm, 0, high)).norm() < 1e-6);
  // the arm bends as a cantilever, and turns with the column's top
  p.loads.points = {{2, 0, 0, 0, -force}};
  const auto loaded = run(p);
  const double sunk = force * arm * arm / EI * (arm / 3 + high);
  CHECK(high - of_point(loaded, arm, 0).z() == Approx(sunk).epsilon(5e-3));
  CHECK(of_point(loaded, 0, arm).x() == Approx(force * arm * high * high / (2 * EI)).epsilon(5e-3));
}
