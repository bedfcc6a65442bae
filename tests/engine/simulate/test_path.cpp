// A path is one object: its events belong to the shell, its branches are chosen by a documented
// rule, and frames only sample it.
#include <cmath>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset fig1(int frames, double tolerance = 1e-3) {
  preset::Preset p = circle(12, 126, 94.5, frames);
  p.accuracy.tolerance = tolerance;
  return p;
}

preset::Preset ellipse(int frames) {
  preset::Preset p = curve(preset::CurveKind::ellipse, 150, 100, 0.8);
  p.movie.frames = frames;
  return p;
}

/// A contracted ellipse with rods off the axes.
preset::Preset drawn_ellipse(double half_x_mm, double half_y_mm, double scale, double tolerance) {
  preset::Preset p = curve(preset::CurveKind::ellipse, half_x_mm, half_y_mm, scale);
  p.movie.frames = 5;
  p.accuracy.tolerance = tolerance;
  return p;
}

/// Runs a preset on meshes of `edges` times a power of two edges per segment, in load steps of
/// `load_step` times the usual size.
simulate::ExperimentResult with_base_edges(int edges, const preset::Preset& preset,
                                           double load_step = 1) {
  Scene scene = scene_of(preset).value();
  scene.base_edges = edges;
  scene.load_step = load_step;
  record::MemorySink sink;
  Watch watch;
  auto summary = value_of(
      simulate::run(preset, std::make_shared<const Scene>(std::move(scene)), false, sink, watch));
  return {std::move(sink.trajectory()), std::move(summary)};
}

double bend(const simulate::ExperimentResult& outcome) {
  return outcome.summary.energies[Term::bend];
}

/// Sum of (u v)^n z over the joints of a frame.
double skew(const record::Trajectory& trajectory, std::size_t frame, int n) {
  double sum = 0;
  for (const auto& joint : trajectory.layout.joints)
    sum += std::pow(joint.u_mm * joint.v_mm, n) * trajectory.frames[frame].nodes(2, joint.node);
  return sum;
}

/// Every frame is in equilibrium and says whether it is stable; a path that ended early says why.
void check_frames(const simulate::ExperimentResult& outcome, int requested) {
  const auto& frames = outcome.trajectory.frames;
  CAPTURE(outcome.summary.limit_reason);
  if (int(frames.size()) < requested) {
    CHECK(outcome.summary.limit != record::Limit::none);
    CHECK_FALSE(outcome.summary.limit_reason.empty());
  }
  for (std::size_t k = 0; k < frames.size(); ++k) {
    CAPTURE(k, frames[k].progress, frames[k].event);
    CHECK((frames[k].kind == "interpolated" || frames[k].residual_N < 1e-3));
    if (frames[k].negative_pivots > 0) CHECK_FALSE(frames[k].event.empty());
    // rods bend, they do not stretch
    CHECK(frames[k].energies[Term::stretch] < 0.05 * frames[k].energies[Term::bend] + 1e-6);
  }
}

}  // namespace

TEST_CASE("every requested frame is there and in equilibrium, or the run says why not") {
  preset::Preset thick = on_net(), barely = circle(8, 77.9, 77.0, 3),
                 pipe = on_net(preset::NetKind::cylinder, 120, 125);
  thick.accuracy.tolerance = 1e-3;
  thick.rod.diameter_mm = 2;
  const auto outcome = run(thick);
  if (outcome.summary.limit == record::Limit::none)
    CHECK(last_frame(outcome).progress == 1);
  else
    CHECK_FALSE(outcome.summary.limit_reason.empty());
  // contracted by less than two per cent
  barely.accuracy.tolerance = 1e-3;
  const auto little = run(barely);
  check_frames(little, 3);
  CHECK(little.summary.error_estimate_mm < 1e-3 * 77.9);
  // inner frames of a shell that starts on its net
  pipe.movie.frames = 3;
  const auto on_its_way = run(pipe);
  check_frames(on_its_way, 3);
  for (const auto& frame : on_its_way.trajectory.frames) CHECK(frame.negative_pivots == 0);
}

TEST_CASE("a snap that only the coarsest mesh sees is none of the shell") {
  // a mesh of 4 edges loses its stability at 0.3978 and ends at 30.27 mJ; finer ones do not
  const auto outcome = run_to_end(circle(8, 77.9, 63.0));
  CHECK(bend(outcome) == Approx(31.4).epsilon(5e-3));
}

TEST_CASE("a loss of stability that two coarse meshes have and the finest does not is none",
          "[standard]") {
  // the smallest eigenvalue comes within a tenth of its size to zero: 4, 5 and 10 edges cross it,
  // 16 and 20 do not
  preset::Preset p = circle(9, 109.05474771559238, 90.57544489549078);
  p.accuracy.tolerance = 4.4e-4;
  for (int base_edges : {4, 5}) {
    const auto outcome = with_base_edges(base_edges, p);
    CAPTURE(base_edges, outcome.summary.limit_reason);
    CHECK(outcome.summary.limit == record::Limit::none);
    CHECK(bend(outcome) == Approx(11.769).epsilon(1e-4));
  }
}

TEST_CASE("stability lost and regained within one load step is not stepped over") {
  // unstable on every mesh between progress 0.23 and 0.27, with a usual load step's end on each
  // side
  preset::Preset p = circle(12, 154.04688335955143, 113.9866738043739);
  p.accuracy.tolerance = 6.4e-3;
  const auto usual = with_base_edges(4, p), half = with_base_edges(4, p, 0.5);
  CHECK(usual.summary.limit == record::Limit::snap);
  CHECK(half.summary.limit == record::Limit::snap);
  CHECK(bend(usual) == Approx(bend(half)).epsilon(1e-6));
}

TEST_CASE("the path from flat enters a branch by the imperfection, not by where it was begun",
          "[standard]") {
  // at 2 % the dome of 4 edges already lies on one of the two branches that leave at progress 0.02
  const preset::Preset p =
      drawn_ellipse(79.2370704561472, 114.96512576937675, 0.7743109990656376, 1.47e-3);
  const auto four = with_base_edges(4, p), five = with_base_edges(5, p);
  for (const auto* outcome : {&four, &five})
    CHECK_THAT(outcome->summary.limit_reason, Catch::StartsWith("the path branches"));
  // its mirror image lies 9.3 mm away
  CHECK(distance(four, five) < 0.1);
}

TEST_CASE("a frame lies on the path's own branch on every mesh") {
  // between 4 and 8 edges Newton's method goes to a short rod that did not buckle, 0.37 mm away
  const auto outcome =
      run(drawn_ellipse(111.91825069487095, 113.71261328458786, 0.751133214905858, 4.3e-3));
  CHECK(outcome.summary.limit == record::Limit::none);
  for (const auto& frame : outcome.trajectory.frames) CHECK(frame.negative_pivots == 0);
}

TEST_CASE("frames change nothing: the same events, the same end, of an actuation, a push and loads",
          "[standard]") {
  const auto pushed = [](int frames) {
    preset::Preset p = fig1(frames);
    p.indentation.at = preset::IndentationPosition::highest;
    p.indentation.depth_mm = 36;
    return p;
  };
  const auto same = [](const preset::Preset& one, const preset::Preset& other) {
    const auto a = run(one), b = run(other);
    check_frames(a, one.movie.frames);
    check_frames(b, other.movie.frames);
    CHECK(a.summary.limit == b.summary.limit);
    CHECK(a.summary.limit_reason == b.summary.limit_reason);
    CHECK(bend(a) == bend(b));
  };
  same(ellipse(2), ellipse(5));
  same(ellipse(2), ellipse(9));
  same(pushed(5), pushed(11));
  preset::Preset loaded = circle(5, 50, 42);
  loaded.loads.points = {{0, 0, 0, 0, -0.02}};
  preset::Preset more = loaded;
  more.movie.frames = 5;
  same(loaded, more);
}

TEST_CASE("a shell of metres enters its branch as one of decimetres does") {
  const auto scaled = [](double by) {
    preset::Preset p = circle(12, by * 126, by * 121);
    p.footprint.spacing_mm *= by;
    p.rod.diameter_mm *= by;
    p.imperfection.size = 0.002;
    auto found = run(p).summary;
    INFO(found.limit_reason);
    CHECK(found.limit == record::Limit::none);
    CHECK_THAT(found.limit_reason, Catch::StartsWith("the path branches"));
    return found.height_mm / by;
  };
  CHECK(scaled(50) == Approx(scaled(1)).epsilon(1e-3));
}

TEST_CASE(
    "an imperfection chooses the branch of Fig. 1: stable in every frame, and the same from "
    "any seed but for mirrors") {
  preset::Preset p = fig1(12);
  const auto first = run(p);
  p.imperfection.size = 0;
  const auto symmetric = run_to_end(p);
  check_frames(first, 12);
  CHECK(first.summary.limit == record::Limit::none);
  CHECK_THAT(first.summary.limit_reason, Catch::StartsWith("the path branches"));
  // between R_a/R_o = 0.9953 and 0.9952, with an error
  CHECK_THAT(first.summary.limit_reason,
             Catch::Contains("at progress 0.018") && Catch::Contains("±"));
  for (const auto& frame : first.trajectory.frames) CHECK(frame.negative_pivots == 0);
  CHECK(std::abs(bend(first) - bend(symmetric)) > 0.1);
  for (int seed : {2, 3}) {
    p = fig1(2);
    p.imperfection.seed = seed;
    CHECK(bend(run(p)) == Approx(bend(first)).epsilon(1e-9));
  }
  p = fig1(2);
  p.imperfection.form = preset::ImperfectionForm::soft_mode;
  CHECK(run(p).summary.stable);
}

TEST_CASE("a saddle from flat loses its branch where two coarse meshes do", "[standard]") {
  const auto events = [](const LevelPlan& plan) {
    return value_of(simulate::follow_actuation(shared_scene(spool(preset::Start::flat)), plan,
                                               false, 1, unwatched))
        .segments.back()
        .report.events.size();
  };
  REQUIRE(events({{8, 16}, false}) == events({{16, 32}, false}));
  const auto confirmed = run(spool(preset::Start::flat));
  CHECK(confirmed.summary.limit == record::Limit::snap);
  CHECK(confirmed.summary.limit_reason.find("do not agree") == std::string::npos);
  CHECK(bend(confirmed) == Approx(bend(run(spool()))).epsilon(5e-3));
}

TEST_CASE("the frame after a jump is the one that reports it, and it jumps where that is reported",
          "[standard]") {
  // the second of two snaps is a limit point, which a mesh of twice as many edges reaches later
  preset::Preset p = ellipse(60);
  p.footprint.placement = Placement::on_axis;
  p.accuracy.tolerance = 0.02;
  const auto outcome = run(p);
  const auto& frames = outcome.trajectory.frames;
  const auto rise = [&](std::size_t n) { return frames[n].height_mm - frames[n - 1].height_mm; };
  int reported = 0;
  for (std::size_t k = 10; k < frames.size(); ++k) {
    CAPTURE(k, frames[k].progress, frames[k].event);
    const bool tells = frames[k].event.starts_with("snap at progress ");
    CHECK((rise(k) - rise(k - 1) > 0.3) == tells);
    if (!tells) continue;
    ++reported;
    const double place = std::stod(frames[k].event.substr(17));
    CHECK(frames[k].progress > place - 0.015);
    CHECK(frames[k - 1].progress < place + 0.015);
  }
  CHECK(reported == 2);
}

TEST_CASE("estimates are bounds where the meshes show another order than the second", "[full]") {
  preset::Preset p = circle(17, 162.305, 113.993);
  p.accuracy.tolerance = 1e-3;
  const auto requested = run(p);
  p.accuracy.tolerance = 1e-6;
  const double error = distance(requested, run(p));
  CHECK(error < 2 * requested.summary.error_estimate_mm + 1e-9);
  CHECK(error < 1e-3 * 162.305);
}

TEST_CASE("the requested diagonal is lower, whichever one the dome buckled along first") {
  for (auto diagonal : {preset::SeedDiagonal::y_eq_x, preset::SeedDiagonal::y_eq_minus_x}) {
    preset::Preset p = circle(7, 36.058, 35.7);
    p.footprint.spacing_mm = 10.944;
    p.actuation.seed_diagonal = diagonal;
    const double higher = skew(run(p).trajectory, 1, 3);
    CHECK(higher * (diagonal == preset::SeedDiagonal::y_eq_x ? -1 : 1) > 0);
  }
}

TEST_CASE("the last frame is the state that the path reached, no leg flipped between joints") {
  // sampled without the path's history, Newton's method on 8 edges left errors of 1 mm at the
  // joints and 12 mm inside a leg, for an unstable equilibrium
  preset::Preset p = drawn_ellipse(133.62545281648636, 85.78375160704122, 0.7903740280121565, 0);
  p.accuracy = {};
  p.movie.frames = 3;
  p.actuation.correspondence = Correspondence::arc_length;
  p.accuracy.edges_per_segment = 8;
  const auto outcome = run(p);
  CHECK(last_frame(outcome).progress == 1);
  CHECK(last_frame(outcome).negative_pivots == 0);
  // the energy is between those of 4 edges, 42.92 mJ, and of 16 edges, 43.32 mJ
  CHECK(last_frame(outcome).energies[Term::bend] == Approx(43.24).margin(0.02));
}

TEST_CASE("a lost branch is left to the side of the imperfection on every mesh", "[standard]") {
  // pushed off a state that is no equilibrium, meshes of 5, 6 and 7 edges went to the mirror image
  preset::Preset p = on_net(preset::NetKind::sphere, 70.76627254486084);
  p.net.cut_height = 0.08243762925267219;
  p.ends.kind = preset::EndKind::tangent;
  p.movie.frames = 5;
  std::vector<double> twists;  // odd under the mirrors u and v
  for (int edges : {4, 5, 6, 7}) {
    p.accuracy.edges_per_segment = edges;
    const auto outcome = run(p);
    REQUIRE(outcome.trajectory.frames[1].progress == 0.25);
    twists.push_back(skew(outcome.trajectory, 1, 1));
  }
  for (double twist : twists) {
    CAPTURE(twist, twists[0]);
    CHECK(twist * twists[0] > 0);
    CHECK(std::abs(twist) > 0.3 * std::abs(twists[0]));
  }
}

TEST_CASE("the error of an event is of two meshes", "[standard]") {
  // a saddle: the finest mesh of one path and the coarsest of the other have the branch at one
  // parameter
  preset::Preset p = spool(preset::Start::flat);
  p.ends.rings = preset::Rings::pinned;
  const std::string reported = run(p).summary.limit_reason;
  double progress = 0, error = 0;
  REQUIRE(std::sscanf(reported.c_str(), "the path branches at progress %lf \u00b1 %lf", &progress,
                      &error) == 2);
  // on meshes of 16 and 32 edges
  constexpr double there = 0.2421, to = 0.0002;
  CHECK(error < 0.002);
  CHECK(std::abs(progress - there) <= error + to);
}
