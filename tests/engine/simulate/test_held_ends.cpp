// Crossed rods with pinned ends and with ends of prescribed direction, compared with the elastica.
#include "tests/engine/simulate/run.h"
#include "tests/engine/solve/elastica.h"

using namespace gridshell;

namespace {

constexpr double length = 200;

/// Two rods that cross in their middle, with this end condition, contracted.
preset::Preset held_cross(preset::EndKind hold, double shorter) {
  preset::Preset p = network(cross(length / 2, length / 2), 0, 1);
  p.actuation.scale = shorter;
  p.rod.shear_GPa = 31;
  p.ends.kind = hold;
  return p;
}

Elastica exact(preset::EndKind hold, double shorter) {
  return elastica(length, shorter * length, circular_section(0.254, 83),
                  hold == preset::EndKind::pinned ? 2 : 4);
}

}  // namespace

TEST_CASE("the extensible elastica converges to the inextensible one") {
  RodSection stiff = circular_section(0.254, 83);
  stiff.EA *= 1e6;
  for (const int quarters : {2, 4}) {
    const Elastica found = elastica(252, 189, stiff, quarters);
    CHECK(found.height == Approx(73.682190).margin(1e-6));
    CHECK(found.thrust * 252 * 252 / (M_PI * M_PI * stiff.EI) ==
          Approx(1.145587 * (quarters == 2 ? 1 : 4)).margin(4e-6));
  }
}

TEST_CASE(
    "arches, pinned and of prescribed direction, are elasticas to what tolerance and estimate "
    "promise",
    "[standard]") {
  const auto rod_model = GENERATE(RodModel::bend, RodModel::twist);
  const auto hold =
      GENERATE(preset::EndKind::pinned, preset::EndKind::tangent, preset::EndKind::clamped);
  if (rod_model == RodModel::bend && hold == preset::EndKind::clamped) return;
  for (const double shorter : {0.97, 0.95, 0.9, 0.8, 0.7})
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      preset::Preset p = held_cross(hold, shorter);
      p.accuracy.model = rod_model;
      p.accuracy.tolerance = tolerance;
      CAPTURE(int(rod_model), int(hold), shorter, tolerance);
      const auto outcome = run_to_end(p);
      const double requested = tolerance * length / std::sqrt(2.0),
                   off = std::abs(outcome.summary.height_mm - exact(hold, shorter).height),
                   estimate = last_frame(outcome).error_estimate_mm;
      CAPTURE(off, estimate, requested);
      CHECK(off < 2 * estimate);
      CHECK(off < requested);
      CHECK(estimate <= requested);
    }
}

TEST_CASE("ends of prescribed direction: errors fall as even powers of the edge length") {
  const auto hold = GENERATE(preset::EndKind::tangent, preset::EndKind::clamped);
  const Elastica known = exact(hold, 0.7);
  double coarser = 0, coarser_force = 0, before = 0, before_force = 0;
  for (const int edges : {8, 16, 32}) {
    preset::Preset p = held_cross(hold, 0.7);
    p.accuracy.edges_per_segment = edges;
    const auto outcome = run(p);
    const double off = outcome.summary.height_mm - known.height,
                 thrust = std::abs(last_frame(outcome).reactions_N.row(0).maxCoeff()),
                 off_force = thrust / known.thrust - 1;
    CAPTURE(int(hold), edges, off, off_force);
    const double left = (4 * off - coarser) / 3, left_force = (4 * off_force - coarser_force) / 3;
    if (edges > 8) {
      CHECK(coarser / off == Approx(4).epsilon(0.02));
      CHECK(coarser_force / off_force == Approx(4).epsilon(0.02));
    }
    if (edges > 16) {
      // a method of third order would give 8
      CHECK(before / left > 12);
      CHECK(before_force / left_force > 12);
    }
    coarser = off, coarser_force = off_force;
    before = left, before_force = left_force;
  }
}
