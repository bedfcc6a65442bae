// Ends of a network with separate end conditions.
#include "tests/engine/simulate/mixed_network.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

enum EndKind { pinned, tangent, clamped, free_end };

/// Two beams of 200 mm that cross in their middles, where a very small force pushes them down.
struct Cross {
  static constexpr double length = 200, push_N = 1e-5;
  std::array<EndKind, 4> ends;  ///< begin and end of the first, of the second

  preset::Preset preset(int edges) const {
    preset::NetworkData file = cross(length / 2, length / 2);
    for (int end = 0; end < 4; ++end) {
      const EndKind end_kind = ends[std::size_t(end)];
      if (end_kind == free_end)
        file.free.push_back(end);
      else
        file.end_constraints.push_back({double(end / 2), double(end % 2), double(end_kind)});
    }
    preset::Preset p = network(file, edges);
    p.rod.diameter_mm = 2, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
    p.loads.points = {{4, 0, 0, 0, -push_N}};
    return p;
  }
  /// Stiffness of a beam against a force in its middle, over EI/L^3 [beam theory].
  static double stiffness(EndKind begin, EndKind end) {
    if (begin == pinned && end == pinned) return 48;
    if (begin == free_end || end == free_end) return 24;
    return begin == pinned || end == pinned ? 768.0 / 7 : 192;
  }
  double exact_mm() const {
    const double EI = 1e4 * M_PI / 4;  // N mm^2
    return push_N * std::pow(length, 3) / EI /
           (stiffness(ends[0], ends[1]) + stiffness(ends[2], ends[3]));
  }
};

double sunk(const preset::Preset& p) {
  const auto outcome = run(p);
  CHECK(outcome.summary.stable);
  return -joints_of(outcome.trajectory)(2, 0);
}

/// The energies of a network of laths in equilibrium.
Energies energies_of_equilibrium(const preset::NetworkData& file) {
  preset::Preset p = network(file, 2);
  p.rod.width_mm = 2, p.rod.thickness_mm = 1, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
  p.limits.max_strain = 0.02;
  return run_to_end(p).summary.energies;
}

}  // namespace

TEST_CASE("beams of one network bear what their own constraints give, by beam theory") {
  for (const auto& ends :
       {std::array{clamped, pinned, clamped, pinned}, std::array{pinned, pinned, clamped, pinned},
        std::array{clamped, clamped, pinned, clamped}, std::array{tangent, pinned, pinned, pinned},
        std::array{tangent, clamped, free_end, clamped},
        std::array{tangent, tangent, tangent, free_end}}) {
    const Cross cross{ends};
    CAPTURE(ends[0], ends[1], ends[2], ends[3]);
    const double exact = cross.exact_mm(), coarse = sunk(cross.preset(8)),
                 fine = sunk(cross.preset(16));
    CHECK((coarse - exact) / (fine - exact) == Approx(4).epsilon(0.02));
    CHECK((4 * fine - coarse) / 3 == Approx(exact).epsilon(2e-5));
  }
}

TEST_CASE("a constraint for all ends is of those without one in the file") {
  preset::Preset p = Cross{{clamped, pinned, clamped, pinned}}.preset(8);
  const double by_file = sunk(p);
  p.ends.kind = preset::EndKind::clamped;
  p.footprint.file.end_constraints = {{0, 1, 0}, {1, 1, 0}};
  CHECK(sunk(p) == Approx(by_file).epsilon(1e-10));
}

TEST_CASE(
    "a network of mixed laws and constraints has one equilibrium turned, moved and listed "
    "otherwise") {
  const preset::NetworkData file = mixed_network();
  const Energies upright = energies_of_equilibrium(file);
  constexpr std::array terms{Term::bend, Term::joint, Term::shear, Term::twist, Term::support};
  for (const Term term : terms) CHECK(upright[term] > 1e-3);
  // springs pull equally along all axes, so that they rotate with the equilibrium
  for (const preset::NetworkData& same : same_otherwise(file, 0.8)) {
    const Energies other = energies_of_equilibrium(same);
    for (const Term term : terms) CHECK(other[term] == Approx(upright[term]).epsilon(1e-9));
    CHECK(other.total() == Approx(upright.total()).epsilon(1e-12));
  }
}

TEST_CASE("constraints of ends that have no support of their own are refused by rod and end") {
  const auto reported = [](const char* reason, const auto& change) {
    preset::NetworkData file = mixed_network();
    change(file);
    CHECK_THAT(refusal(scene_of(network(file, 4))), Catch::Contains(reason));
  };
  reported("rods[1]: its begin is on a spring", [](auto& file) {
    file.end_constraints[2] = {1, 0, 2};
  });
  reported("rods[3]: its begin is free", [](auto& file) {
    std::erase_if(file.supports, [](const auto& row) { return row[0] == 2; });
    file.free = {2};
  });
  reported("rods[6]: its end is joined there", [](auto& file) {
    file.points.push_back({0, -80, 0});
    file.rods.push_back({25, 12});
    file.end_constraints.push_back({6, 1, 1});
  });
  // one clamped end fixes a piece, one with free rotation does not
  preset::NetworkData cantilever;
  cantilever.points = {{0, 0, 0}, {50, 0, 0}, {100, 0, 0}, {50, 30, 0}};
  cantilever.rods = {{0, 1, 2}, {1, 3}};
  cantilever.free = {2, 3};
  cantilever.end_constraints = {{0, 0, 2}};
  cantilever.joint_laws = {{1, -1, -1}};
  preset::Preset p = network(cantilever, 4);
  p.rod.shear_GPa = 31;
  CHECK(value_of(scene_of(p)).length_scale_mm == Approx(std::hypot(100, 30) / 2));
  p.footprint.file.end_constraints = {{0, 0, 1}};
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("would turn freely"));
}

TEST_CASE("laths whose width is horizontal are stable for every direction of the rods") {
  for (int degrees = 0; degrees < 90; degrees += 10) {
    const Eigen::Rotation2Dd by(degrees * M_PI / 180);
    preset::Preset p = Cross{{pinned, pinned, pinned, pinned}}.preset(4);
    for (auto& point : p.footprint.file.points) {
      const Eigen::Vector2d to = by * Eigen::Vector2d(point[0], point[1]);
      point = {to.x(), to.y(), 0};
    }
    p.rod.width_mm = 3, p.rod.thickness_mm = 1;
    p.loads.points.clear();
    p.actuation.scale = 0.99;
    const auto outcome = run(p);
    CAPTURE(degrees);
    CHECK(outcome.trajectory.frames.front().negative_pivots == 0);
    CHECK(outcome.summary.stable);
  }
}

TEST_CASE("a support of a flat beam settles across it") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {50, 0, 0}, {100, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.end_constraints = {{0, 0, double(clamped)}};
  file.supports = {{0}, {2, 99, 0, -8}};
  preset::Preset p = network(file);
  p.rod.diameter_mm = 1, p.rod.young_GPa = 80, p.rod.shear_GPa = 30;
  p.limits.max_strain = 0.02;
  const auto settled = run(p);
  CHECK(settled.summary.limit == record::Limit::none);
  CHECK(settled.summary.stable);
  // the same beam in space: its middle is drawn a little higher
  file.points[1][2] = 1e-3;
  p.footprint.file = file;
  const auto in_space = run(p);
  CHECK(settled.summary.energies[Term::bend] ==
        Approx(in_space.summary.energies[Term::bend])
            .margin(settled.summary.energy_error_mJ + in_space.summary.energy_error_mJ));
}
