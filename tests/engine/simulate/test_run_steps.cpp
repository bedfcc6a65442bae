// The steps of a user as a run: their results, the state of the shell after them, and the texts of
// their frames.
#include "engine/simulate/steps.h"

#include <algorithm>
#include <cstdio>

#include "tests/engine/simulate/run.h"

using namespace gridshell;
using preset::StepKind;

namespace {

preset::Preset small_shell_on_four_edges() {
  preset::Preset preset = small_shell();
  preset.accuracy.edges_per_segment = 4;
  return preset;
}

preset::Step of(StepKind task) {
  preset::Step step;
  step.kind = task;
  return step;
}

preset::Step push(int i, int j, double depth_mm) {
  preset::Step step = of(StepKind::push);
  step.joint = {i, j};
  step.depth_mm = depth_mm;
  return step;
}

preset::Step move(double progress) {
  preset::Step step = of(StepKind::move);
  step.progress = progress;
  return step;
}

double difference(const record::Frame& a, const record::Frame& b) {
  return (a.nodes - b.nodes).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("frames are given to the steps that have a path, one to each of the others") {
  const std::vector<preset::Step> steps{push(0, 0, 3), of(StepKind::release), move(0.9)};
  CHECK(simulate::frames_of_steps(steps, 11) == std::vector{5, 1, 4});
  CHECK(simulate::frames_of_steps(steps, 2) == std::vector{1, 1, 1});
  CHECK(simulate::frames_of_steps({of(StepKind::rest)}, 20) == std::vector{1});
  // edge points move straight to their positions, and back
  preset::Step dragged = move(0.9);
  dragged.edge_points = {{0, 1, 0, 0}};
  CHECK(simulate::frames_of_steps({dragged, of(StepKind::release), move(0.8), move(0.7)}, 11) ==
        std::vector{1, 1, 1, 7});
}

TEST_CASE("a released push gives the shell before, and every step reports its result") {
  preset::Preset preset = small_shell_on_four_edges();
  preset.step = {push(0, 0, 3), of(StepKind::release)};
  preset.movie.frames = 6;
  const auto outcome = run(preset);
  const auto& frames = outcome.trajectory.frames;
  REQUIRE(frames.size() == 6);
  CHECK(outcome.summary.limit == record::Limit::none);
  CHECK(difference(frames.front(), frames.back()) < 1e-5);
  // four frames on the path of the push, as deep as evenly sampled
  for (std::size_t k = 1; k <= 4; ++k) {
    CHECK(frames[k].depth_mm == Approx(0.75 * double(k)).epsilon(1e-6));
    if (k > 1) CHECK(frames[k].force_N > frames[k - 1].force_N);
    CHECK(frames[k].residual_N < 1e-6);
    CHECK(frames[k].event.empty());
  }
  CHECK(std::isnan(frames[5].depth_mm));
  CHECK(frames[5].event == "release");
  REQUIRE(outcome.summary.steps.size() == 2);
  CHECK_THAT(outcome.summary.steps[0],
             Catch::StartsWith("1 push [0, 0]: reached, residual ") && Catch::Contains("stable"));
  CHECK_THAT(outcome.summary.steps[1], Catch::StartsWith("2 release: reached"));
  // the reaction of the joint is known only while the constraint exists
  const record::Layout& layout = outcome.trajectory.layout;
  REQUIRE(layout.loaded_joints.size() == 1);
  CHECK(layout.loaded_joints[0].at_times);
  const int node = layout.joints[std::size_t(layout.loaded_joints[0].joint)].node;
  const auto support = std::ranges::find(layout.supports, node) - layout.supports.begin();
  for (std::size_t k = 0; k < frames.size(); ++k)
    CHECK((frames[k].reactions_N.col(support).norm() > 0) == (k >= 1 && k <= 4));
}

TEST_CASE("a push has the requested depth, however many meshes follow") {
  preset::Preset preset = small_shell();
  preset.movie.frames = 3;
  for (const double depth : {0.5, 4.0}) {
    preset.step = {push(0, 0, depth)};
    const auto finished = run(preset);
    CAPTURE(depth, finished.summary.limit_reason);
    REQUIRE(finished.summary.edges_per_segment > 4);
    CHECK(finished.trajectory.frames.back().depth_mm == Approx(depth).epsilon(1e-6));
  }
}

TEST_CASE("a prescribed joint bears its force, whatever the rounding of its position") {
  preset::Preset p = circle(6, 69.5, 0.936 * 69.5, 5);
  p.actuation.seed = preset::Seed::down;
  p.rod.shear_GPa = 31;
  p.rod.width_mm = 0.59;
  p.rod.thickness_mm = 0.33;
  p.joints.shear_Nmm = 2.065;
  p.joints.twist_Nmm = 0.024;
  p.ends.kind = preset::EndKind::clamped;
  preset::Step tighten = of(StepKind::tighten), hold = of(StepKind::hold);
  tighten.stiffness_Nmm = 5;
  hold.joint = {1, -1};
  p.step = {tighten, hold, move(1.199)};
  for (const double tolerance : {1e-2, 1e-3}) {
    p.accuracy.tolerance = tolerance;
    const record::Frame held = run_to_end(p).trajectory.frames.back();
    CHECK(held.force_N == Approx(2.1537).margin(held.push_error_N + 0.0012));
  }
}

TEST_CASE("frames only sample the steps, which end where they end") {
  preset::Preset preset = small_shell_on_four_edges();
  preset.step = {push(0, 0, 3), move(0.9), push(1, -1, 2)};
  const auto few = run(preset);
  preset.movie.frames = 17;
  const auto many = run(preset);
  CHECK(few.trajectory.frames.size() == 4);
  CHECK(many.trajectory.frames.size() == 17);
  CHECK(difference(few.trajectory.frames.back(), many.trajectory.frames.back()) == 0);
  CHECK(many.trajectory.frames.back().boundary_radius_mm == Approx(66 - 0.9 * 12));
}

TEST_CASE("a step to the preset's own radius is that of a run there") {
  preset::Preset there = small_shell_on_four_edges();
  there.actuation.radius_mm = 57;
  preset::Preset moved = small_shell_on_four_edges();
  moved.step = {of(StepKind::move)};
  moved.step[0].radius_mm = 57;
  const auto a = run(there), b = run(moved);
  CHECK(difference(a.trajectory.frames.back(), b.trajectory.frames.back()) < 1e-6);
}

TEST_CASE("loads, a prescribed joint, edge points, jitter and `rest` are steps") {
  preset::Preset preset = small_shell_on_four_edges();
  preset.rod.density_kg_m3 = 6450;
  preset.loads.gravity_m_s2 = 9.81;
  preset::Step light = of(StepKind::load), hold = of(StepKind::hold), edge = of(StepKind::move);
  light.factor = 0;
  hold.joint = {0, 0};
  edge.edge_points = {{3, 1.5, -1, 0}};
  preset.step = {
      light, hold, edge, of(StepKind::release), of(StepKind::jitter), of(StepKind::rest)};
  const auto outcome = run(preset);
  const auto& frames = outcome.trajectory.frames;
  REQUIRE(frames.size() == 7);
  CHECK(frames[0].energies[Term::load] != 0);
  CHECK(frames[1].energies[Term::load] == 0);
  CHECK(difference(frames[1], frames[2]) < 1e-6);
  const int node = outcome.trajectory.layout.edge_points[3];
  const Eigen::Vector3d moved = frames[3].nodes.col(node) - frames[2].nodes.col(node);
  CHECK((moved - Eigen::Vector3d(1.5, -1, 0)).norm() < 1e-9);
  CHECK(frames[6].negative_pivots == 0);
}

TEST_CASE("a step that ends early ends the run, and both say so") {
  preset::Preset preset = small_shell_on_four_edges();
  preset.step = {push(0, 0, -60),
                 of(StepKind::release)};  // outward, further than the rods are long
  const auto outcome = run(preset);
  CHECK(outcome.summary.limit == record::Limit::locking);
  CHECK_THAT(outcome.summary.limit_reason, Catch::StartsWith("step 1 (push [0, 0]): "));
  // the push ended at one of two limits
  const bool strained = std::abs(outcome.summary.largest_strain) > 0.9 * preset.limits.max_strain;
  CHECK_THAT(
      outcome.summary.limit_reason,
      Catch::Contains(strained ? "largest strain" : "the push met 100 times its first stiffness"));
  REQUIRE(outcome.summary.steps.size() == 1);
  CHECK_THAT(outcome.summary.steps[0], Catch::Contains("locked"));
  CHECK(outcome.trajectory.frames.back().event == "locking");
}

TEST_CASE("a shell that snaps when its joint is released says so, and moves on from there") {
  preset::Preset preset = circle(8, 100, 75);
  preset::Step aside = of(StepKind::push);
  aside.joint = {0, 0};
  aside.to_mm = {10, 10, -10};
  preset.movie.frames = 6;
  preset.step = {aside, of(StepKind::release)};
  const auto released = run(preset);
  CHECK(released.summary.limit == record::Limit::snap);
  // each step has a snap of its own
  CHECK_THAT(released.summary.limit_reason,
             Catch::StartsWith("step 1 (push [0, 0]): the path lost its stability at 0.7556") &&
                 Catch::Contains("; step 2 (release): the path lost its stability at 0.0000 "));
  CHECK_THAT(released.summary.steps[1], Catch::Contains("snap to another state"));
  CHECK(released.summary.error_estimate_mm < 0.01);
  // joints that touched under the push no longer do
  CHECK_THAT(released.summary.contact, Catch::Contains("step 2 (release): joints no longer touch"));
  preset.step = {aside, move(0.98), of(StepKind::release), move(0.8)};
  const auto moved = run(preset);
  CHECK(moved.summary.steps.size() == 4);
  preset.step = {move(0.8)};
  CHECK(distance(moved, run(preset)) < 0.05);
}

TEST_CASE("an edge point that is moved and put back leaves the shell of its boundary") {
  preset::Preset preset = circle(8, 100, 75);
  preset.loads.field_N_per_mm = 2e-5;
  preset.movie.frames = 6;
  preset::Step dragged = move(0.8);
  dragged.edge_points = {{0, 0.2, 0, 0}};
  preset.step = {dragged, move(0.8), move(0.7)};
  const auto put_back = run_to_end(preset);
  // dead loads grow with the progress of the boundary
  preset.step = {move(0.8), move(0.7)};
  const auto plain = run_to_end(preset);
  CHECK(distance(put_back, plain) < 0.01);
  for (const std::size_t k : {std::size_t(2), put_back.trajectory.frames.size() - 1}) {
    const record::Frame& frame = put_back.trajectory.frames[k];
    CHECK(frame.energies[Term::load] ==
          Approx(plain.trajectory.frames[k == 2 ? 3 : plain.trajectory.frames.size() - 1]
                     .energies[Term::load])
              .epsilon(1e-3));
  }
}

TEST_CASE("the dead loads of a load case are added to those of a step") {
  preset::Preset preset = circle(8, 100, 75);
  preset.loads.field_N_per_mm = 1e-4;
  preset.load_case.resize(1);
  preset.load_case[0].name = "twice";
  preset.load_case[0].dead = 1;
  preset.movie.frames = 2;
  preset::Step all = of(StepKind::load), one = all, none = all;
  one.load_case = none.load_case = "twice";
  none.factor = 0;
  preset.step = {one, all, none};
  const auto outcome = run_to_end(preset);
  const auto& frames = outcome.trajectory.frames;
  REQUIRE(frames.size() == 4);
  const auto load = [&](std::size_t k) { return frames[k].energies[Term::load]; };
  CHECK(load(1) > 1.9 * load(0));
  CHECK(load(2) == Approx(load(1)).epsilon(1e-4));
  CHECK(load(3) == Approx(load(0)).epsilon(1e-4));
}

TEST_CASE("steps on what is not there are errors with their number") {
  preset::Preset preset = small_shell_on_four_edges();
  const auto refused = [&](const preset::Step& step) {
    preset.step = {move(0.95), step};
    return refused_run(preset);
  };
  CHECK_THAT(refused(push(40, 0, 1)),
             Catch::Contains("[[step]] 2") &&
                 Catch::Contains("joint: got [40, 0], expected [i, j] of one of"));
  CHECK_THAT(refused(of(StepKind::release)),
             Catch::Contains("[[step]] 2: got no prescribed joint"));
  // `check` reports it as well
  CHECK_THAT(refusal(simulate::plan(preset)),
             Catch::StartsWith("[[step]] 2: got no prescribed joint"));
  preset::Step edge = of(StepKind::move);
  edge.edge_points = {{400, 1, 0, 0}};
  CHECK_THAT(refused(edge), Catch::Contains("edge_points: got 400, expected 0 to 23"));
}

TEST_CASE(
    "a push of a braced shell under a load is followed, or ends with its step as the reason") {
  // cables are added, and the first pushed joint has no constraint on any mesh: this ended the
  // program
  preset::Preset p = circle(7, 75, 60);
  p.footprint.placement = Placement::on_axis;
  p.rod.shear_GPa = 31;
  p.rod.density_kg_m3 = 6450;
  p.loads.gravity_m_s2 = 9.81;
  p.loads.points = {{0, 0, 0, 0, -0.02}};
  p.accuracy.tolerance = 1e-6;
  preset::Step brace = of(StepKind::brace);
  brace.EA_N = 50;
  brace.brace = preset::BraceKind::cable;
  brace.diagonals = preset::Diagonals::first;
  p.step = {brace, push(1, 1, 4)};
  const auto followed = run(p);
  CHECK(followed.summary.steps.size() == 2);
  CHECK(followed.summary.limit == record::Limit::none);
  CHECK(followed.trajectory.layout.loaded_joints.size() == 1);
  // pulled outward, the rods reach the strain limit
  p.step[1].depth_mm = -20;
  p.limits.max_strain = 3e-4;
  p.accuracy.tolerance = 1e-3;
  const auto ended = run(p);
  CHECK(ended.summary.limit == record::Limit::locking);
  CHECK_THAT(ended.summary.limit_reason, Catch::StartsWith("step 2 (push [1, 1]): at 0.49"));
  CHECK(ended.trajectory.layout.loaded_joints.size() == 1);
}

TEST_CASE("a snap under a load is where the shell snaps, with an error, however much is requested",
          "[standard]") {
  constexpr double snaps_at = 1.514, known_to = 0.003;  // `gridshell load` of this shell
  preset::Preset p = circle(6, 56.12, 42.22);
  p.movie.frames = 2;
  p.load_case = {
      {.name = "down",
       .points = {
           {0, 0, 0, 0, -0.1}, {-1, -1, 0, 0, -0.1}, {0, -1, 0, 0, -0.1}, {-1, 0, 0, 0, -0.1}}}};
  p.step = {of(StepKind::load)};
  p.step[0].load_case = "down";
  for (const int edges : {0, 32})
    for (const double factor : {1.518, 1.55, 2.0}) {
      CAPTURE(edges, factor);
      p.accuracy.edges_per_segment = edges;
      p.step[0].factor = factor;
      const auto outcome = run(p);
      REQUIRE(outcome.summary.steps.size() == 1);
      for (const std::string& text : {outcome.summary.steps[0], outcome.summary.limit_reason}) {
        CAPTURE(text);
        double at = 0, error = 0;
        const auto place = text.find(" at 0.");
        REQUIRE(place != std::string::npos);
        REQUIRE(std::sscanf(text.c_str() + place, " at %lf ± %lf of its path", &at, &error) == 2);
        CHECK(std::abs(at * factor - snaps_at) < error * factor + known_to);
        CHECK(error < 0.01);
      }
    }
}

TEST_CASE("a step that cannot begin ends the run and keeps the steps before it") {
  preset::Preset preset = small_shell_on_four_edges();
  preset::Step tight = of(StepKind::tighten), open = of(StepKind::open);
  tight.stiffness_Nmm = open.stiffness_Nmm = 10;
  open.angle_deg = 2;
  preset.step = {tight, open};
  preset.movie.frames = 4;
  REQUIRE(simulate::plan(preset));
  const auto outcome = run(preset);
  CHECK(outcome.trajectory.frames.back().event == "tighten");
  CHECK(outcome.summary.steps.size() == 1);
  CHECK(outcome.summary.limit == record::Limit::no_equilibrium);
  CHECK_THAT(outcome.summary.limit_reason, Catch::StartsWith("[[step]] 2: "));
}
