// Rods whose axes lie above one another at their joints.
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

constexpr double length = 200, EA = 1e4 * M_PI, EI = EA / 4;  // of 2 mm and 10 GPa

/// Two pinned beams that cross in their middles, the second `apart` above the first, ends and all;
/// the first is pushed along the second there.
preset::Preset layers(double apart, double push_N, int edges) {
  preset::NetworkData file = cross(length / 2, length / 2);
  file.supports = {{2, 0, -100, apart}, {3, 0, 100, apart}};
  preset::Preset p = network(file, edges);
  p.rod.diameter_mm = 2, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
  p.joints.eccentricity_mm = apart;
  p.loads.points = {{4, 0, 0, push_N, 0}};
  return p;
}

/// A circle with four rods per direction, or of laths on hinges, at the end of its actuation.
simulate::ExperimentResult layered(double eccentricity_mm, int edges, bool hinged = false) {
  preset::Preset p;
  p.footprint.rods = 4;
  p.footprint.radius_mm = 50;
  p.actuation.ratio = 0.9;
  p.rod.shear_GPa = 31;
  if (hinged) p.rod.width_mm = 0.4, p.rod.thickness_mm = 0.2, p.joints.twist_Nmm = 1e4;
  p.joints.eccentricity_mm = eccentricity_mm;
  p.accuracy.edges_per_segment = edges;
  p.movie.frames = 3;
  return run_to_end(p);
}

}  // namespace

TEST_CASE("a bolt between two layers loads its rod by a moment of force times eccentricity") {
  for (const double apart : {5.0, -2.0}) {
    // a couple in the middle of a beam turns it by M l/(12 EI); the first beam bends sideways
    const double push = 0.01, beside = 48 * EI / std::pow(length, 3);
    double moved[2], exact = 0;
    for (const int k : {0, 1}) {
      // half an edge next to the joint carries the mean of the two rods' axial forces
      const double along = length / (4 * EA), bend = apart * apart * length / (12 * EI),
                   give = bend + along * (1 - 1 / (16.0 * (k + 1))) + std::abs(apart) / EA;
      const double limit = bend + along + std::abs(apart) / EA;
      exact = push * limit / (1 + beside * limit);
      const auto outcome = run(layers(apart, push, 8 * (k + 1)));
      CHECK(outcome.summary.stable);
      const Eigen::Matrix3Xd& nodes = last_frame(outcome).nodes;
      const Eigen::Vector3d first = nodes.col(0),
                            second = nodes.col(outcome.trajectory.layout.above[0]);
      CHECK(second.z() - first.z() == Approx(apart).epsilon(1e-5));
      moved[k] = first.y() + exact - push * give / (1 + beside * give);
    }
    CAPTURE(apart);
    CHECK((moved[0] - exact) / (moved[1] - exact) == Approx(4).epsilon(0.02));
    CHECK((4 * moved[1] - moved[0]) / 3 == Approx(exact).epsilon(1e-5));
  }
}

TEST_CASE("energies of eccentric joints converge at second order, with both rod models",
          "[standard]") {
  for (const bool hinged : {false, true}) {
    double energy[3];
    for (const int k : {0, 1, 2})
      energy[k] = layered(hinged ? 0.8 : 1, 8 << k, hinged).summary.energies.total();
    CAPTURE(hinged, energy[0], energy[1], energy[2]);
    CHECK((energy[0] - energy[1]) / (energy[1] - energy[2]) == Approx(4).epsilon(0.08));
  }
}

TEST_CASE("rods that lie above one another touch nowhere, whichever is above") {
  const auto above = layered(0.3, 4), below = layered(-0.3, 4);
  CHECK(above.summary.contacts == 0);
  CHECK(above.summary.energies.total() == Approx(below.summary.energies.total()).epsilon(1e-10));
  // every rod has its own points: the second rod's are at a distance from the first's
  const record::Layout& layout = above.trajectory.layout;
  const Eigen::Matrix3Xd& nodes = last_frame(above).nodes;
  for (std::size_t k = 0; k < layout.joints.size(); ++k)
    CHECK((nodes.col(layout.above[k]) - nodes.col(layout.joints[k].node)).norm() ==
          Approx(0.3).epsilon(1e-4));
}

TEST_CASE("what cannot lie above one another is refused") {
  preset::Preset p = layers(1, 0, 4);
  p.footprint.file.points.push_back({-70, -70, 0});
  p.footprint.file.points.push_back({70, 70, 0});
  p.footprint.file.rods.push_back({5, 4, 6});
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("3 rods cross there"));
  p.joints.eccentricity_mm = 0;
  CHECK(scene_of(p));
  p.footprint.file.joint_laws = {{4, 0, 0, 0.2}};
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("3 rods cross there"));
}
