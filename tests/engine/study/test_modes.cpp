// Frequencies of formed shells: their errors, masses, what is not stable and what is refused.
#include "engine/study/formed_shell.h"

#include <cmath>

#include "tests/engine/round_cantilever.h"
#include "tests/presets.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

preset::Preset massive() {
  preset::Preset p = small_shell();
  p.rod.density_kg_m3 = 6450;
  return p;
}

Vibrations vibrations(const preset::Preset& preset, int count = 8) {
  Watch watch;
  return value_of(vibrations_of(preset, count, watch));
}

}  // namespace

TEST_CASE("modes: frequencies of a shell lie within their errors of finer meshes'", "[standard]") {
  preset::Preset p = massive();
  p.accuracy.tolerance = 1e-6;
  const Vibrations fine = vibrations(p);
  REQUIRE(fine.modes.size() == 8);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    p.accuracy.tolerance = tolerance;
    const Vibrations requested = vibrations(p);
    for (std::size_t k = 0; k < requested.modes.size(); ++k) {
      CAPTURE(tolerance, k, requested.modes[k].frequency_Hz, fine.modes[k].frequency_Hz,
              requested.modes[k].error_Hz);
      const double off = std::abs(requested.modes[k].frequency_Hz - fine.modes[k].frequency_Hz);
      CHECK(off < 2 * requested.modes[k].error_Hz + 1e-7 * fine.modes[k].frequency_Hz);
      CHECK(requested.modes[k].error_Hz < 0.1 * fine.modes[k].frequency_Hz);
      CHECK(requested.modes[k].residual < 1e-6);
    }
  }
}

TEST_CASE("modes: a round cantilever vibrates to either side at the frequency of a beam") {
  preset::Preset p = round_cantilever(100);
  p.rod.density_kg_m3 = 8000;
  const double EI = 80e3 * M_PI / 64, mass = 8e-9 * M_PI / 4,
               exact = std::pow(1.8751040687, 2) / (2 * M_PI) * std::sqrt(EI / mass) / 1e4;
  for (const double tolerance : {1e-2, 1e-3, 1e-6}) {
    p.accuracy.tolerance = tolerance;
    const Vibrations found = vibrations(p, 2);
    for (const record::ModeRow& mode : found.modes) {
      CAPTURE(tolerance, mode.frequency_Hz, mode.error_Hz, exact);
      CHECK(std::abs(mode.frequency_Hz - exact) < 2 * mode.error_Hz);
      CHECK(mode.error_Hz < 0.01 * exact);
    }
  }
}

TEST_CASE("modes: masses and stiffness set the time, shapes and states stay") {
  preset::Preset p = massive();
  const Vibrations light = vibrations(p);
  p.rod.density_kg_m3 *= 4;
  const Vibrations heavy = vibrations(p);
  for (std::size_t k = 0; k < light.modes.size(); ++k) {
    CHECK(light.modes[k].mode == int(k) + 1);
    CHECK(heavy.modes[k].frequency_Hz == Approx(light.modes[k].frequency_Hz / 2).epsilon(1e-9));
    CHECK(light.shapes[k].cols() == light.state.frames.back().nodes.cols());
    CHECK(light.shapes[k].colwise().norm().maxCoeff() == Approx(1));
    // constrained nodes do not move
    for (const int node : light.state.layout.edge_points)
      CHECK(light.shapes[k].col(node).norm() < 1e-9);
  }
  // joints far heavier than their rods carry all
  p.joints.mass_g = 10;
  const Vibrations joints = vibrations(p);
  p.joints.mass_g = 40;
  const Vibrations four = vibrations(p);
  CHECK(joints.modes[0].frequency_Hz < 0.1 * heavy.modes[0].frequency_Hz);
  CHECK(four.modes[0].frequency_Hz == Approx(joints.modes[0].frequency_Hz / 2).epsilon(5e-3));
}

TEST_CASE("modes: a joint that is pushed is fixed along the push, and free across it") {
  preset::Preset p = massive();
  p.indentation.at = preset::IndentationPosition::highest;
  p.indentation.depth_mm = 2;
  const Vibrations pushed = vibrations(p);
  const record::Layout& layout = pushed.state.layout;
  REQUIRE(layout.loaded_joints.size() == 1);
  const auto& [joint, direction, at_times] = layout.loaded_joints.front();
  double across = 0;
  for (const Eigen::Matrix3Xd& shape : pushed.shapes) {
    const Eigen::Vector3d move = shape.col(layout.joints[std::size_t(joint)].node);
    CHECK(std::abs(move.dot(direction)) < 1e-8);
    across = std::max(across, move.norm());
  }
  CHECK(across > 0.1);
}

TEST_CASE("modes: the twist model vibrates as the bend model does") {
  preset::Preset p = massive();
  p.accuracy.edges_per_segment = 4;
  const Vibrations bend = vibrations(p, 4);
  p.rod.shear_GPa = 31;
  p.accuracy.model = RodModel::twist;
  const Vibrations twist = vibrations(p, 4);
  REQUIRE(twist.summary.model == "twist");
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(twist.modes[k].frequency_Hz == Approx(bend.modes[k].frequency_Hz).epsilon(1e-4));
}

TEST_CASE("modes: joints weigh what their mass does") {
  preset::Preset p = massive();
  p.loads.gravity_m_s2 = 9.81;
  const Vibrations rods = vibrations(p, 1);
  p.joints.mass_g = 0.01;
  const Vibrations both = vibrations(p, 1);
  const auto weight = [](const Vibrations& of) {
    const record::Frame& frame = of.state.frames.back();
    return frame.reactions_N.row(2).sum();
  };
  CHECK(weight(both) - weight(rods) ==
        Approx(1e-5 * 9.81 * double(both.state.layout.joints.size())).epsilon(1e-4));
}

TEST_CASE("modes: a state that is not stable has frequencies below zero, as many as pivots") {
  preset::Preset p;
  p.rod.density_kg_m3 = 6450;
  p.imperfection.size = 0;
  p.allow_unstable = true;
  p.actuation.ratio = 0.993;  // in the gap of the shell of Fig. 1
  p.accuracy.edges_per_segment = 8;
  const Vibrations found = vibrations(p, 4);
  REQUIRE(found.summary.negative_pivots == 2);
  CHECK(found.modes[0].frequency_Hz < 0);
  CHECK(found.modes[1].frequency_Hz < 0);
  CHECK(found.modes[2].frequency_Hz > 0);
  CHECK(found.modes[0].frequency_Hz < found.modes[1].frequency_Hz);
}

TEST_CASE("modes: what has no mass, or nothing that is solved, is refused by its key") {
  Watch watch;
  CHECK_THAT(refusal(vibrations_of(small_shell(), 3, watch)),
             Catch::Contains("[rod] density_kg_m3"));
  preset::Preset net = on_net(preset::NetKind::sphere, 120);
  net.rod.density_kg_m3 = 6450;
  net.accuracy.model = RodModel::net;
  net.accuracy.tolerance = 0.1;
  CHECK(refusal(vibrations_of(net, 3, watch)).find("[accuracy] model") != std::string::npos);
}
