// Rods that turn about a line without force: one alone, pinned, clamped or fixed in between,
// buckles out of the flat to any side and is the elastica.
#include "engine/solve/turning_rods.h"

#include "engine/core/dense.h"
#include "tests/engine/simulate/run.h"
#include "tests/engine/solve/elastica.h"

using namespace gridshell;

namespace {

constexpr double L = 200;  // mm
const RodSection wire = circular_section(0.254, 83);

/// A rod along x through these points, of which the last is moved inwards to x = `drawn_to`.
preset::Preset rod(const std::vector<double>& points, double drawn_to) {
  preset::NetworkData file;
  file.rods.resize(1);
  for (const double x : points) {
    file.rods[0].push_back(double(file.points.size()));
    file.points.push_back({x, 0, 0});
  }
  file.supports = {{double(points.size()) - 1, drawn_to, 0, 0}};
  preset::Preset p = network(std::move(file));
  p.rod.shear_GPa = 31;
  return p;
}

/// The middle of an elastica that is pinned at one end and clamped along the line to it at the
/// other, drawn in to a span: its distance from the clamped end and its height. By Newton's method
/// in the angle at the pinned end, thrust and transverse force.
Eigen::Vector2d middle_of_clamped(double span) {
  const auto shape = [&](const Eigen::Vector3d& at, double length) {
    return shot(at[0], 0, length, [&](double, double theta) {
      return (-at[1] * std::sin(theta) - at[2] * std::cos(theta)) / wire.EI;
    });
  };
  const auto off = [&](const Eigen::Vector3d& at) {
    const Eigen::Vector4d end = shape(at, L);
    return Eigen::Vector3d(end[0], end[2] / L, (end[3] - span) / L);
  };
  const double euler = 20.19 * wire.EI / (L * L);
  Eigen::Vector3d at(2 * std::sqrt(1 - span / L), euler, 0.2 * euler);
  for (int step = 0; step < 50; ++step) {
    Eigen::Matrix3d slopes;
    for (int k = 0; k < 3; ++k) {
      const double by = 1e-6 * std::max(std::abs(at[k]), 1e-6);
      slopes.col(k) = (off(at + by * Eigen::Vector3d::Unit(k)) - off(at)) / by;
    }
    const Eigen::Vector3d move = slopes.inverse() * off(at);
    at -= std::min(1.0, 0.2 * at.norm() / move.norm()) * move;
  }
  REQUIRE(off(at).norm() < 1e-9);
  const Eigen::Vector4d middle = shape(at, L / 2);
  return {span - middle[3], std::abs(middle[2])};
}

/// Where the middle of the rod is: along its line, and off it.
Eigen::Vector2d middle_of(const simulate::ExperimentResult& outcome) {
  const Eigen::Vector3d at = last_frame(outcome).nodes.col(0);
  return {at.x(), std::hypot(at.y(), at.z())};
}

}  // namespace

TEST_CASE("a rod alone that is pinned, clamped or both is the elastica") {
  for (const double ratio : {0.9, 0.7}) {
    for (const int clamped : {0, 1, 2}) {
      preset::Preset p = rod({0, L / 2, L}, ratio * L);
      if (clamped > 0) p.footprint.file.end_constraints.push_back({0, 0, 2});
      if (clamped > 1) p.footprint.file.end_constraints.push_back({0, 1, 2});
      CAPTURE(ratio, clamped);
      const auto outcome = run_to_end(p);
      Eigen::Vector2d exact = middle_of_clamped(ratio * L);
      if (clamped != 1)
        exact = {ratio * L / 2, elastica(L, ratio * L, wire, clamped == 0 ? 2 : 4).height};
      CHECK((middle_of(outcome) - exact).norm() < last_frame(outcome).error_estimate_mm);
    }
  }
}

TEST_CASE("a rod fixed between its ends buckles in a plane, and meshes agree") {
  for (const double ratio : {0.9, 0.7}) {
    CAPTURE(ratio);
    preset::Preset p = rod({0, 0.35 * L, L}, (0.35 + 0.65 * ratio) * L);
    p.footprint.file.supports.push_back({1});
    const auto usual = run_to_end(p);
    p.accuracy.tolerance = 1e-5;
    const auto fine = run_to_end(p);
    CHECK(usual.summary.energies[Term::bend] ==
          Approx(fine.summary.energies[Term::bend]).epsilon(3e-4));
    const Eigen::Matrix2Xd off_line = last_frame(fine).nodes.bottomRows(2);
    const auto across = eigen_pairs(off_line * off_line.transpose());
    CHECK(across.values[0] < 1e-10 * across.values[1]);
  }
}

TEST_CASE("a lath turns with its section, upright as well as level") {
  std::vector<double> energies;
  for (const bool upright : {false, true}) {
    CAPTURE(upright);
    preset::Preset p = rod({0, 0.35 * L, L}, 0.935 * L);
    p.footprint.file.supports.push_back({1});
    p.rod.width_mm = 3, p.rod.thickness_mm = 1, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
    if (upright) {
      for (auto& point : p.footprint.file.points) std::swap(point[0], point[2]);
      std::swap(p.footprint.file.supports[0][1], p.footprint.file.supports[0][3]);
    }
    const auto outcome = run(p);
    CAPTURE(outcome.summary.limit_reason);
    CHECK(outcome.summary.tolerance_met);
    for (const record::Frame& frame : outcome.trajectory.frames)
      CHECK_FALSE(frame.error_estimate_mm > 0.1);
    energies.push_back(outcome.summary.energies[Term::bend]);
  }
  CHECK(energies[1] == Approx(energies[0]).epsilon(1e-3));
}

TEST_CASE("rods turn that are fixed on one line, on it as long as the boundary moves") {
  const auto turning = [](const preset::Preset& p) {
    const auto scene = shared_scene(p);
    return turning_rods(scene->footprint, scene->rods, scene->motion, scene->solved_model()).size();
  };
  preset::Preset p = rod({0, 70, L}, 0.9 * L);
  p.footprint.file.end_constraints = {{0, 0, 2}};
  CHECK(turning(p) == 1);
  p.footprint.file.supports.push_back({1});
  CHECK(turning(p) == 1);
  preset::Preset off = p;
  off.footprint.file.supports[1] = {1, 70, 0, 5};
  CHECK(turning(off) == 0);
  // the clamp of a section with axes resists
  p.rod.width_mm = 3, p.rod.thickness_mm = 1;
  CHECK(turning(p) == 0);
  CHECK(turning(circle(6, 66, 54)) == 0);
}
