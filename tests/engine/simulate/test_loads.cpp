// Equilibria under loads: a column that buckles under its own weight, a pinched ring, beams, a
// grillage and a cable net formed by loads alone, each compared with a closed form or an elastica.
#include <numbers>
#include <regex>

#include "tests/engine/simulate/run.h"
#include "tests/engine/solve/elastica.h"

using namespace gridshell;

namespace {

constexpr double EI = 83e3 * std::numbers::pi * 0.254 * 0.254 * 0.254 * 0.254 / 64;  // N mm^2
constexpr double L = 200;                                                            // mm
constexpr double stiff = 1000;                                                       // N/mm

/// A rod from a fixed crossing of two others to `tip`, which is on a spring.
preset::NetworkData rod_on_cross(const std::vector<double>& tip, const Eigen::Vector3d& spring) {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {20, 0, 0}, {-20, 0, 0}, {0, 20, 0}, {0, -20, 0}, tip};
  file.rods = {{1, 0, 2}, {3, 0, 4}, {0, 5}};
  file.supports = {{0}, {5}};
  file.springs = {{5, spring.x(), spring.y(), spring.z()}};
  return file;
}

/// A column whose top can only move up and down, under `times` its critical weight per length,
/// 18.568 EI/L^3.
preset::Preset column(double times) {
  preset::Preset p = network(rod_on_cross({0, 0, L}, {stiff, stiff, 0}));
  p.loads.field_N_per_mm = times * 18.568 * EI / (L * L * L);
  return p;
}

/// The end of the third rod, in the order of edge points.
Eigen::Vector3d tip_of(const record::Trajectory& trajectory, std::size_t frame) {
  return trajectory.frames[frame].nodes.col(Eigen::Index(trajectory.layout.joints.size()) + 5);
}

/// The elastica of a rod of this bending stiffness.
template <class Turn>
Eigen::Vector4d elastica(double angle, double length, const Turn& turn) {
  return shot(angle, 0, length, [&](double s, double theta) { return turn(s, theta) / EI; });
}

/// The deflection of a beam in its middle, where it is horizontal, from the elastica of one half;
/// `turn` is the derivative of the moment by the arc length. The angle at the end of the beam is
/// searched for between `least` and a right angle.
template <class Turn>
double sag_of_half(double least, const Turn& turn) {
  const auto half = [&](double angle) { return elastica(angle, L / 2, turn); };
  return half(zero_of([&](double angle) { return half(angle)[0] - std::numbers::pi / 2; }, least,
                      std::numbers::pi / 2))[3];
}

/// Height of the top of the buckled column: a moment without a horizontal force H would displace it
/// from the axis.
double top_of_elastica(double times) {
  const double q = times * 18.568 * EI / (L * L * L);
  const auto shape = [&](double angle, double H) {
    return elastica(angle, L, [&](double s, double theta) {
      return -q * (L - s) * std::sin(theta) - H * std::cos(theta);
    });
  };
  const auto H_at = [&](double angle) {
    return zero_of([&](double H) { return shape(angle, H)[2]; }, -12 * EI / (L * L), 0);
  };
  const double angle = zero_of([&](double of) { return shape(of, H_at(of))[1]; }, 0.1, 1.7);
  return shape(angle, H_at(angle))[3];
}

/// The reported position of an event: "at progress 0.6668 ± 0.0006".
struct LossAt {
  double at = 0, error = 0;
};
std::vector<LossAt> losses_of(const std::string& reason) {
  const std::regex loss("at progress ([0-9.]+) ± ([0-9.e-]+)");
  std::vector<LossAt> losses;
  for (std::sregex_iterator k(reason.begin(), reason.end(), loss), none; k != none; ++k)
    losses.push_back({std::stod((*k)[1]), std::stod((*k)[2])});
  return losses;
}

double bend(const simulate::ExperimentResult& outcome) {
  return outcome.summary.energies[Term::bend];
}

}  // namespace

TEST_CASE("a heavy column bifurcates at its critical weight and is the elastica above it") {
  for (const double times : {1.02, 1.1}) {
    CAPTURE(times);
    const auto outcome = run_to_end(column(times));
    const auto losses = losses_of(outcome.summary.limit_reason);
    REQUIRE(losses.size() == 1);
    CHECK(std::abs(losses[0].at - 1 / times) <= losses[0].error);
    CHECK(losses[0].error < 0.02);
    const auto top = [&](int edges) {
      preset::Preset p = column(times);
      p.accuracy.edges_per_segment = edges;
      return tip_of(run(p).trajectory, 1).z();
    };
    CHECK((4 * top(64) - top(32)) / 3 == Approx(top_of_elastica(times)).margin(0.02));
  }
}

TEST_CASE("a column's state at a load does not depend on how much more was requested") {
  // past a load of 1.2160 there is no arch left: it turns over and hangs below its base
  preset::Preset less = column(1.1), more = column(1.5), most = column(11);
  for (preset::Preset* p : {&less, &more, &most}) p->accuracy.edges_per_segment = 32;
  more.movie.frames = 16;
  most.movie.frames = 11;
  const auto at_1 = run(less), to_1_5 = run(more), to_11 = run(most);
  const double top = tip_of(at_1.trajectory, 1).z();
  CHECK(tip_of(to_1_5.trajectory, 11).z() == Approx(top).epsilon(1e-6));
  CHECK(tip_of(to_11.trajectory, 1).z() == Approx(top).epsilon(1e-6));
  for (const auto* outcome : {&to_1_5, &to_11}) {
    const double times = outcome == &to_1_5 ? 1.5 : 11;
    CAPTURE(outcome->summary.limit_reason);
    CHECK(outcome->summary.limit == record::Limit::snap);
    CHECK_THAT(outcome->summary.limit_reason, Catch::StartsWith("the path branches"));
    const auto losses = losses_of(outcome->summary.limit_reason);
    REQUIRE(losses.size() == 2);
    CHECK(std::abs(losses[0].at - 1 / times) <= losses[0].error);
    CHECK(std::abs(losses[1].at - 1.2160 / times) <= losses[1].error);
    const auto last = outcome->trajectory.frames.size() - 1;
    CHECK(tip_of(outcome->trajectory, last).z() == Approx(-L).margin(0.1));
  }
}

TEST_CASE("a column's end does not depend on how far from straight it is drawn", "[standard]") {
  for (const double lean : {0.0, 0.1, 0.2, 0.5, 2.0}) {
    CAPTURE(lean);
    preset::Preset p = column(1.5);
    p.footprint.file.points.push_back({lean, 0, L / 2});
    p.footprint.file.rods.back() = {0, 6, 5};
    p.movie.frames = 41;
    const auto outcome = run(p);
    CAPTURE(outcome.summary.limit_reason);
    const auto losses = losses_of(outcome.summary.limit_reason);
    REQUIRE(losses.size() == 2);
    CHECK(std::abs(losses[1].at - 1.2160 / 1.5) <= losses[1].error);
    CHECK(tip_of(outcome.trajectory, 40).z() == Approx(-L).margin(0.1));
    // the angle about its axis, which nothing determines, is no error
    for (const record::Frame& frame : outcome.trajectory.frames)
      CHECK_FALSE(frame.error_estimate_mm > 0.3);
    // states at an event, known to its error, miss no tolerance
    if (lean > 0) CHECK(outcome.summary.tolerance_met);
    if (outcome.summary.tolerance_met)
      CHECK_THAT(outcome.summary.limit_reason, !Catch::Contains("not met"));
  }
}

TEST_CASE("a straight column without an imperfection reports where it is not stable") {
  preset::Preset p = column(1.5);
  p.imperfection.size = 0;
  p.accuracy.edges_per_segment = 16;
  p.movie.frames = 21;
  const auto outcome = run(p);
  CHECK(outcome.trajectory.frames[13].negative_pivots == 0);
  CHECK(outcome.trajectory.frames[14].negative_pivots == 2);
}

TEST_CASE("a column buckles to any side, each as stable as the others") {
  std::vector<double> sides;
  double first = 0;
  for (const int seed : {1, 2, 3, 4}) {
    preset::Preset p = column(1.1);
    p.accuracy.edges_per_segment = 16;
    p.imperfection.seed = seed;
    CAPTURE(seed);
    const auto outcome = run_to_end(p);
    if (seed == 1) first = bend(outcome);
    CHECK(bend(outcome) == Approx(first).epsilon(1e-7));
    const auto& x = last_frame(outcome).nodes;
    Eigen::Index far = 0;
    x.topRows(2).rightCols(x.cols() - 11).colwise().norm().maxCoeff(&far);
    sides.push_back(std::atan2(x(1, far + 11), x(0, far + 11)));
  }
  CHECK(std::abs(sides[0] - sides[1]) > 0.01);
}

TEST_CASE("a rod that turns about the line of its supports is one of many, and says so") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {50, 0, 0}, {100, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.supports = {{0}, {2, 90, 0, 0}};
  preset::Preset p = network(file);
  CHECK_THAT(run_to_end(p).summary.doubt, Catch::Contains("is one of many"));
  // a load may keep it from turning
  p.rod.density_kg_m3 = 6450;
  p.loads.gravity_m_s2 = 9.81;
  CHECK_THAT(run_to_end(p).summary.doubt, !Catch::Contains("is one of many"));
}

TEST_CASE("a pinched ring continues past its double mode on every mesh", "[standard]") {
  preset::NetworkData file;
  file.rods.resize(1);
  for (int k = 0; k < 24; ++k) {
    const double angle = k * std::numbers::pi / 12;
    file.points.push_back({80 * std::cos(angle), 80 * std::sin(angle), 0});
    file.rods[0].push_back(k);
    if (k % 6 == 0)
      file.supports.push_back({double(k), 72 * std::cos(angle), 72 * std::sin(angle), 0});
  }
  file.rods[0].push_back(0);
  preset::Preset p = network(file);
  p.rod.shear_GPa = 31;  // a closed rod may twist
  const auto usual = run(p);
  const auto loss = losses_of(usual.summary.limit_reason);
  REQUIRE(loss.size() == 1);
  for (const int edges : {8, 16}) {
    p.accuracy.edges_per_segment = edges;
    CAPTURE(edges);
    const auto outcome = run_to_end(p);
    CHECK(bend(outcome) == Approx(bend(usual)).epsilon(3e-3));
    const auto found = losses_of(outcome.summary.limit_reason);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].at - loss[0].at) <= found[0].error + loss[0].error);
  }
}

TEST_CASE("beams bend under transverse loads as their closed forms and elasticas say") {
  // uniform, from one per cent of a diameter to a third of the length
  for (const double q : {1e-8, 1.5e-5}) {
    preset::Preset p = network(rod_on_cross({L, 0, 0}, {0, stiff, stiff}));
    p.loads.field_N_per_mm = q;
    p.accuracy.edges_per_segment = 64;
    CAPTURE(q);
    const double sag = -last_frame(run_to_end(p)).nodes.row(2).minCoeff();
    // the angle is that with the vertical, pointing down
    CHECK(sag == Approx(sag_of_half(0.3, [&](double s, double theta) {
                   return q * (L / 2 - s) * std::sin(theta);
                 })).epsilon(1e-3));
    const double linear = 5 * q * std::pow(L, 4) / 384 / EI;
    if (q < 1e-6)
      CHECK(sag == Approx(linear).epsilon(1e-3));
    else
      CHECK(std::abs(sag - linear) > 0.02 * linear);
  }
}

TEST_CASE("a grillage shares the force at its joint as its beams are stiff, at any deflection") {
  const auto sag_of = [](double a, double b, double P) {
    preset::NetworkData file = cross(a / 2, b / 2);
    file.supports = {{0}, {1}, {2}, {3}};
    file.springs = {
        {0, 0, stiff, stiff}, {1, 0, stiff, stiff}, {2, stiff, 0, stiff}, {3, stiff, 0, stiff}};
    preset::Preset p = network(file);
    p.loads.points = {{4, 0, 0, 0, -P}};
    p.accuracy.edges_per_segment = 32;
    return -last_frame(run_to_end(p)).nodes(2, 0);
  };
  const auto beam = [](double length) { return 48 * EI / std::pow(length, 3); };
  CHECK(sag_of(200, 160, 1e-5) == Approx(1e-5 / (beam(200) + beam(160))).epsilon(1e-3));
  // each of two equal rods carries a half of the load, and each support a quarter
  constexpr double P = 8e-3;
  const double sag = sag_of_half(0.1, [](double, double theta) { return P / 4 * std::sin(theta); });
  CHECK(sag_of(L, L, P) == Approx(sag).epsilon(1e-3));
  CHECK(sag > 0.1 * L);
}

TEST_CASE("beams of a grillage have sections of their own") {
  preset::NetworkData file = cross(100, 100);
  // a lath on its flat side next to a round rod
  file.own = {
      {0, "shear_GPa", 4}, {0, "thickness_mm", 0.5}, {0, "width_mm", 3}, {0, "young_GPa", 10}};
  preset::Preset p = network(file);
  p.ends.kind = preset::EndKind::clamped;
  p.rod.shear_GPa = 31;
  p.loads.points = {{4, 0, 0, 0, -1e-4}};
  p.accuracy.edges_per_segment = 64;
  const auto outcome = run(p);
  CHECK(outcome.summary.stable);
  const double lath = 10e3 * 3 * 0.5 * 0.5 * 0.5 / 12;
  CHECK(-last_frame(outcome).nodes(2, 0) ==
        Approx(1e-4 * L * L * L / (192 * (EI + lath))).epsilon(1e-3));
}

TEST_CASE("a load on a free end of a network bends it as a cantilever") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {L / 2, 0, 0}, {L, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.free = {2};
  file.end_constraints = {{0, 0, 2}};
  preset::Preset p = network(file, 32);
  p.rod.shear_GPa = 31;
  p.loads.points = {{2, 0, 0, 0, -1e-6}};
  const auto outcome = run(p);
  CHECK(-last_frame(outcome).nodes.row(2).minCoeff() ==
        Approx(1e-6 * L * L * L / (3 * EI)).epsilon(2e-3));
  p.loads.points = {{0, 0, 0, 0, -1e-6}};
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("is no joint or free end"));
}

TEST_CASE("a rope with sag is stable between two pins if a weak spring is across it") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {50, 0, -2}, {100, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.supports = {{1}};
  file.springs = {{1, 0, 0.001, 0}};
  preset::Preset p = network(file);
  p.loads.field_N_per_mm = 0.001;
  CHECK(run(p).summary.stable);
}

TEST_CASE("a cable net hangs as its lengths allow") {
  constexpr double d = 0.05, P = 0.1, EA = 83e3 * std::numbers::pi * d * d / 4;
  preset::Preset p = network(cross(100, 100));
  p.rod.diameter_mm = d;
  p.limits.max_strain = 0.05;
  p.loads.points = {{4, 0, 0, 0, -P}};
  const auto outcome = run_to_end(p);
  // four straight halves carry it
  const double angle =
      zero_of([&](double of) { return 4 * EA * (1 / std::cos(of) - 1) * std::sin(of) - P; }, 0, 1);
  CHECK(-last_frame(outcome).nodes(2, 0) == Approx(100 * std::tan(angle)).epsilon(1e-3));
}

TEST_CASE("frames next to an unloaded start have their loads") {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {50, 0, 0}, {100, 0, 0}, {50, -40, 0}, {50, 40, 0}};
  file.rods = {{0, 1, 2}, {3, 1, 4}};
  file.supports = {{0}, {2}, {3}, {4}};
  preset::Preset p = network(file);
  p.loads.points = {{1, 0, 0, 0, -0.05}};
  p.movie.frames = 60;
  const auto frames = run_to_end(p).trajectory.frames;
  REQUIRE(frames.size() == 60);
  CHECK(frames[1].kind == "interpolated");
  for (std::size_t k = 1; k < frames.size(); ++k) {
    REQUIRE(frames[k].loads_N.cols() > 0);
    CHECK(frames[k].loads_N.row(2).sum() == Approx(-0.05 * frames[k].progress).epsilon(1e-6));
  }
}
