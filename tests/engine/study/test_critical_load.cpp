// Critical loads with known answers, by arc length and linearised.
#include "engine/elastic/along_rods.h"
#include "engine/study/formed_shell.h"
#include "tests/engine/solve/rod_cases.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::study;
using record::BranchEvent;

namespace {

constexpr double L = 1000, EA = 1e4, rise = 2, gyration = rise / 3.5;
constexpr double EI = EA * gyration * gyration, k = M_PI / L;

CriticalLoad loaded(Model model, const State& begin, CriticalOptions options = {}) {
  finish(model);
  Linearisation system(model);
  const PinnedMotion motion{begin.x, Eigen::Matrix3Xd::Zero(3, begin.x.cols()), PathLaw::even};
  options.max_strain = 1e-2;
  return critical_load(system, motion, begin, options, unwatched);
}

/// An arch free of stress as a half wave, under a half wave of load that is 1 at its limit point by
/// the shallow theory [Fung, Kaplan 1952]: q = EI k^4 (a_0 - a) + EA k^4/4 (a_0^2 - a^2) a, whose
/// top is at a^2 = (a_0^2 - 4 r^2)/3. Antisymmetric modes come first where a_0 > sqrt(22) r.
CriticalLoad shallow_arch(int edges) {
  const SingleRod single(edges, L, {EA, EI, EI, EI, {0, 1e-5}, 0}, RodEnd::pinned, RodEnd::pinned);
  Model model = single.model();
  const Eigen::Matrix3Xd line = single.line(1, rise);
  for (ModelEdge& edge : model.edges)
    edge.rest_length = (line.col(edge.to) - line.col(edge.from)).norm();
  for (int node = 0; node <= edges; ++node) model.fix(node, 1);
  for (int edge = 0; edge < edges; ++edge) model.fix_spin(edge);
  finish(model);
  const State rest = start_state(model, line);
  for (auto& pair : std::get<std::vector<Pair<SectionBending>>>(model.pairs)) {
    pair.law.bend.rest.setZero();
    pair.law.bend.rest = pair.law.excess(pair_geometry(model, rest, pair));
  }
  const double a = std::sqrt((rise * rise - 4 * gyration * gyration) / 3), k4 = std::pow(k, 4);
  const double q = EI * k4 * (rise - a) + EA * k4 / 4 * (rise * rise - a * a) * a;
  for (int node = 1; node < edges; ++node)
    model.loads.push_back({node, {0, 0, -q * L / edges * std::sin(M_PI * node / edges)}});
  return loaded(std::move(model), rest);
}

/// Euler's column, whose load at a factor of 1 is its critical one.
CriticalLoad column(int edges, const CriticalOptions& options = {}) {
  constexpr double stiff = 1e7;
  const SingleRod single(edges, L, {stiff, EI, EI, EI, {0, 0}, 0}, RodEnd::pinned, RodEnd::free);
  Model model = single.model();
  for (const int row : {1, 2}) model.fix(edges, row);
  for (int node = 0; node <= edges; ++node) model.fix(node, 1);
  model.loads.push_back({edges, {-EI * k * k, 0, 0}});
  finish(model);
  return loaded(model, start_state(model, single.line()), options);
}

/// A rod that buckled to a half wave of amplitude a between its hinges, under a half wave of load.
/// At load factor 1 its thrust reaches four times Euler's load, and the full wave loses stability.
/// An inextensible rod has this amplitude until then, so that q = 3 EI k^4 a.
CriticalLoad buckled_arch(int edges) {
  constexpr double thin = 4e3, a = 5;
  const SingleRod single(edges, L, {1e7, thin, thin, thin, {0, 0}, 0}, RodEnd::pinned,
                         RodEnd::pinned);
  Model model = single.model();
  for (int node = 0; node <= edges; ++node) model.fix(node, 1);
  finish(model);
  State state = start_state(model, single.line(1 - a * a * k * k / 4, a));
  Linearisation system(model);
  settle(system, state, 1e-8);
  const double q = 3 * thin * std::pow(k, 4) * state.x(2, edges / 2);
  for (int node = 1; node < edges; ++node)
    model.loads.push_back({node, {0, 0, -q * L / edges * std::sin(M_PI * node / edges)}});
  return loaded(std::move(model), state);
}

preset::Preset snowed_on() {
  preset::Preset p = small_shell();
  p.loads.snow_N_m2 = 1;
  p.load_case = {{.name = "snow", .snow = 1, .points = {}}};
  return p;
}

LoadStudy studied(const preset::Preset& preset, int imperfections = 0) {
  Watch watch;
  return value_of(load_study(preset, imperfections, watch));
}

}  // namespace

TEST_CASE("a shallow sinusoidal arch has a limit point") {
  const CriticalLoad coarse = shallow_arch(32), fine = shallow_arch(64);
  CHECK(fine.event == BranchEvent::turn);
  CHECK((4 * fine.factor - coarse.factor) / 3 == Approx(1).epsilon(1e-3));
  CHECK(std::abs(fine.factor - 1) < std::abs(coarse.factor - 1));
  // it moves down, most in its middle
  REQUIRE(fine.mode.size() > 0);
  CHECK(std::abs(fine.mode(2, 32)) == Approx(1));
  // and continues past the limit point, unstable
  CHECK(std::ranges::any_of(fine.points, [&](const TracedPoint& point) {
    return point.negative_pivots == 1 && point.at.t < 0.999 * fine.factor;
  }));
}

TEST_CASE("a buckled arch goes to one side at four times Euler's load") {
  const CriticalLoad coarse = buckled_arch(32), fine = buckled_arch(64);
  CHECK(fine.event == BranchEvent::bifurcation);
  CHECK((4 * fine.factor - coarse.factor) / 3 == Approx(1).epsilon(1e-3));
  // its middle stays
  REQUIRE(fine.mode.size() > 0);
  CHECK(std::abs(fine.mode(2, 32)) < 1e-3);
  CHECK(std::abs(fine.mode(2, 16)) == Approx(1).epsilon(1e-2));
}

TEST_CASE("Euler's column branches at its load, which the linearised problem knows too") {
  const CriticalLoad coarse = column(16), fine = column(32);
  CHECK(fine.event == BranchEvent::bifurcation);
  CHECK((4 * fine.factor - coarse.factor) / 3 == Approx(1).epsilon(2e-4));
  CHECK((4 * fine.linear - coarse.linear) / 3 == Approx(1).epsilon(2e-4));
  REQUIRE(fine.mode.size() > 0);
  CHECK(std::abs(fine.mode(2, 16)) == Approx(1).epsilon(1e-6));
}

TEST_CASE("what a shell carries lies within its error of finer meshes' answer", "[standard]") {
  preset::Preset p = snowed_on();
  p.accuracy.tolerance = 1e-3;
  const LoadStudy fine = studied(p);
  p.accuracy.tolerance = 1e-2;
  const LoadStudy found = studied(p, 5);
  REQUIRE(found.cases.size() == 1);
  const record::LoadRow &row = found.cases[0], &exact = fine.cases[0];
  CAPTURE(row.critical_factor, row.error, exact.critical_factor, exact.error, row.knock_down_50);
  CHECK(row.event == BranchEvent::bifurcation);
  CHECK(exact.event == BranchEvent::bifurcation);
  CHECK(std::abs(row.critical_factor - exact.critical_factor) < 2 * row.error);
  CHECK(row.error < 0.1 * row.critical_factor);
  CHECK(exact.error < row.error);
  // rods that hardly lengthen do not lower the linear estimate
  CAPTURE(row.linear_factor, row.linear_error, exact.linear_factor, exact.linear_error);
  CHECK(std::abs(row.linear_factor - exact.linear_factor) < 2 * row.linear_error);
  CHECK(row.linear_error < 0.1 * row.linear_factor);
  CHECK(row.linear_factor > 0.5 * row.critical_factor);
  // imperfect shells with a limit point below the critical factor
  CHECK(row.imperfections == 5);
  CHECK(found.modes[0].colwise().norm().maxCoeff() == Approx(1));
  CHECK(found.points.front().factor == 0);
  CHECK(found.points.front().way_mm == 0);
}

TEST_CASE("the linear estimate does not fall with the stiffness of rods that hardly lengthen") {
  preset::Preset p = snowed_on();
  p.accuracy.edges_per_segment = 8;
  p.step.emplace_back().kind = preset::StepKind::tighten;
  p.rod.EI_Nmm2 = 17;
  std::vector<double> factors;
  for (const double EA : {1e4, 1e6}) {
    p.rod.EA_N = EA;
    factors.push_back(studied(p).cases.at(0).linear_factor);
  }
  CHECK(factors[1] == Approx(factors[0]).epsilon(0.02));
}

TEST_CASE("on two meshes, which do not show their order, a critical factor has their difference") {
  preset::Preset p = snowed_on();
  p.accuracy.edges_per_segment = 4;
  const double coarse = studied(p).cases.at(0).critical_factor;
  p.accuracy.edges_per_segment = 8;
  const record::LoadRow row = studied(p).cases.at(0);
  CHECK(row.error >= std::abs(row.critical_factor - coarse));
}

TEST_CASE("a portal frame sways and a ring turns oval where their closed forms say") {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::network;
  p.limits.max_strain = 0.05;
  preset::NetworkData file;
  SECTION("of three rods that are bolted at the corners, hinged at its feet: x tan x = 6") {
    constexpr double side = 100, round_EI = 83e3 * M_PI * 0.254 * 0.254 * 0.254 * 0.254 / 64;
    // columns end on the beam, which extends slightly past them; corners stay in the plane
    file.points = {{0, 0, 0},    {0, side, 0},  {side, side, 0},
                   {side, 0, 0}, {-5, side, 0}, {side + 5, side, 0}};
    file.rods = {{0, 1}, {4, 1, 2, 5}, {3, 2}};
    file.supports = {{0}, {3}, {1}, {2}};
    file.springs = {{1, 0, 0, 1000}, {2, 0, 0, 1000}};
    file.free = {4, 5};
    p.footprint.file = file;
    p.accuracy.edges_per_segment = 32;
    p.step.emplace_back().kind = preset::StepKind::tighten;
    const double unit = round_EI / (side * side);
    p.load_case = {{.name = "columns", .points = {{1, 0, 0, -unit, 0}, {2, 0, 0, -unit, 0}}}};
    const record::LoadRow row = studied(p).cases.at(0);
    constexpr double x = 1.3495525;
    CAPTURE(row.critical_factor, row.error, row.linear_factor);
    CHECK(row.event == BranchEvent::bifurcation);
    CHECK(row.critical_factor == Approx(x * x).epsilon(1e-3));
    CHECK(row.linear_factor == Approx(x * x).epsilon(1e-3));
  }
  SECTION("cut round, under a load all around: 3 EI/R^3 where it turns with the ring, else 4") {
    // [Boresi 1955]
    constexpr int corners = 160;
    constexpr double R = 40, flat_EI = 83e3 * 4 * 1 / 12.0;
    // a lath on edge, so that it stays in its plane
    p.rod.width_mm = 1;
    p.rod.thickness_mm = 4;
    p.rod.shear_GPa = 31;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * M_PI * k / corners;
      file.points.push_back({R * std::cos(angle), R * std::sin(angle), 0});
    }
    file.rods.emplace_back();
    for (int k = 0; k <= corners; ++k) file.rods[0].push_back(k % corners);
    constexpr double stiff = 1e4;
    for (const int quarter : {0, 1, 2, 3}) {
      const int point = quarter * corners / 4;
      file.supports.push_back({double(point)});
      file.springs.push_back(
          {double(point), quarter % 2 ? stiff : 0, quarter % 2 ? 0 : stiff, stiff});
    }
    p.footprint.file = file;
    p.rod.as_drawn = true;
    p.accuracy.edges_per_segment = 2;
    p.loads.edge_N_m = 1e3 * flat_EI / (R * R * R);
    p.load_case = {{.name = "around", .edge = 1, .points = {}}};
    for (const auto& [direction, factor] : {std::pair(preset::EdgeDirection::inward, 4.0),
                                            std::pair(preset::EdgeDirection::pressure, 3.0)}) {
      p.loads.edge_direction = direction;
      const LoadStudy found = studied(p);
      const record::LoadRow& row = found.cases.at(0);
      CAPTURE(row.critical_factor, row.error, row.linear_factor);
      CHECK(row.event == BranchEvent::bifurcation);
      CHECK(row.critical_factor == Approx(factor).epsilon(1e-3));
      CHECK(row.linear_factor == Approx(factor).epsilon(1e-3));
      CHECK(found.loads[0].rowwise().sum().norm() < 1e-9 * found.loads[0].colwise().norm().sum());
    }
  }
}

TEST_CASE("a beam reaches its strength where M c/I says") {
  constexpr double span = 200, diameter = 0.254, strength = 2;
  preset::NetworkData file = cross(span / 2, span / 2);
  file.supports = {{0}, {1}, {2}, {3}};
  file.springs = {{0, 0, 1000, 1000}, {1, 0, 1000, 1000}, {2, 1000, 0, 1000}, {3, 1000, 0, 1000}};
  preset::Preset p = network(file, 16);
  p.rod.strength_MPa = strength;
  // each beam bears a half of the force
  const double unit = strength * M_PI * std::pow(diameter, 3) / 32 / (span / 8);
  p.load_case = {{.name = "force", .points = {{4, 0, 0, 0, -unit}}}};
  const LoadStudy found = studied(p);
  const record::LoadRow& row = found.cases.at(0);
  CAPTURE(row.strength_factor, row.strength_error);
  CHECK(row.strength_factor == Approx(1).epsilon(2e-3));
  CHECK(row.strength_error < 1e-2);
  CHECK(found.points.front().utilisation < 1e-6);
}

TEST_CASE("a rod that would break only after stability is lost has no factor at which it does") {
  preset::Preset p =
      preset::good(
          "[rod]\nmaterial = \"gfrp\"\ndiameter_mm = 1.5\n[footprint]\nrods = 6\nspacing_mm = 100\n"
          "radius_mm = 330\n[actuation]\nratio = 0.9\n[loads]\nwind_N_m2 = 10\n[[loads.case]]\n"
          "name = \"wind\"\nwind = 1.0\n")
          .base;
  const auto strong_to = [&](double strength_MPa) {
    p.rod.strength_MPa = strength_MPa;
    return studied(p);
  };
  const LoadStudy found = strong_to(274);
  const record::LoadRow& row = found.cases.at(0);
  CHECK(row.critical_factor == Approx(4.45).epsilon(0.05));
  CHECK(std::isnan(row.strength_factor));
  // on the falling branch it breaks at a lower factor
  CHECK(std::ranges::max(found.points, {}, &record::LoadPoint::utilisation).utilisation > 1);
  const record::LoadRow weak = strong_to(200).cases.at(0);
  CHECK(weak.strength_factor < weak.critical_factor);
}

TEST_CASE("pressure on faces whose edge is free is refused by the key, with the joint") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
  file.rods = {{0, 1, 2, 3, 0}};
  file.supports = {{0}, {1}, {2}};
  preset::Preset p = network(file);
  p.loads.pressure_N_m2 = 1;
  p.load_case = {{.name = "inside", .pressure = 1, .points = {}}};
  Watch watch;
  const std::string why = refusal(load_study(p, 0, watch), Fault::bad_input);
  CHECK_THAT(why, Catch::Contains("[[loads.case]] 1 pressure") && Catch::Contains("[3, 0]"));
}

TEST_CASE("a shell that has no case to carry is refused by the key") {
  preset::Preset p = snowed_on();
  p.load_case.clear();
  Watch watch;
  CHECK_THAT(refusal(load_study(p, 0, watch), Fault::bad_input), Catch::Contains("[[loads.case]]"));
}

TEST_CASE("a load case that moves no joint is refused by its name") {
  preset::Preset p = network(cross(100, 100), 4);
  p.footprint.file.supports = {{0}, {1}, {2}, {3}};
  p.load_case = {{.name = "some", .points = {{4, 0, 0, 0, -1e-3}}},
                 {.name = "nothing", .points = {}}};
  Watch watch;
  auto shell = value_of(form_shell(p, watch));
  Simulation& simulation = shell.path.simulation;
  CHECK_THAT(refusal(load_study(shell, 0, watch), Fault::bad_input),
             Catch::Contains("[[loads.case]] name: \"nothing\""));
  // the shell is as before, also after an error
  CHECK(simulation.shell().motion().field.change == 0);
  p.footprint.file.supports.push_back({4});
  p.load_case = {{.name = "fixed joint", .points = {{4, 0, 0, 0, -1}}}};
  CHECK_THAT(refusal(load_study(p, 0, watch), Fault::bad_input),
             Catch::Contains("[[loads.case]] name: \"fixed joint\""));
}

TEST_CASE("no imperfect shell is left out of the knock-down factors") {
  preset::Preset p = snowed_on();
  p.accuracy.edges_per_segment = 2;
  p.loads.imperfection = 20;
  const record::LoadRow row = studied(p, 4).cases.at(0);
  CAPTURE(row.imperfections_failed, row.knock_down_5, row.knock_down_50);
  CHECK(row.imperfections == 4);
  // one that stays stable counts with the factor at which its path ends
  CHECK(row.knock_down_95 * row.critical_factor == Approx(CriticalOptions{}.most_factor));
}

TEST_CASE("a bifurcation past the end of the range is none") {
  constexpr double most = 0.9;
  const CriticalLoad found =
      column(16, {.most_factor = most, .largest_mm = 0, .steps_to_linear = 1.5});
  CHECK(found.event == BranchEvent::none);
  CHECK(std::isnan(found.factor));
  for (const TracedPoint& point : found.points) CHECK(point.at.t <= most);
  CHECK(found.points.back().at.t == most);
}
