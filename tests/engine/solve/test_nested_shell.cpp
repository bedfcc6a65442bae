// Finer meshes beside a path, and how little they cost there.
#include "engine/solve/nested_shell.h"

#include "tests/presets.h"

using namespace gridshell;

namespace {

constexpr double tolerance_mm = 1e-4;
const Watch watch;

NestedShell shell_of(const Scene& scene, double tolerance) {
  PathOptions options;
  options.tolerance_mm = tolerance;
  return NestedShell::make(scene.footprint, scene.rods, RodModel::bend, scene.motion,
                           {{4, 8, 16}, false}, options)
      .value();
}

double parameter(double ratio) { return std::sqrt((1 - ratio) / 0.25); }

}  // namespace

TEST_CASE("along a path finer meshes take one correction a state, and it is the exact state") {
  const Scene scene = value_of(scene_of(paper_circle(8)));
  NestedShell shell = shell_of(scene, tolerance_mm), exact = shell_of(scene, 1e-9);
  const double first = parameter(0.95);
  const State begin =
      first_buckled(shell.system(0), shell.mesh(0), shell.motion(0), first, {}, scene.flat, watch)
          .value();
  REQUIRE(shell.start(first, begin, watch).end == Outcome::reached);
  REQUIRE(exact.start(first, begin, watch).end == Outcome::reached);
  const Effort before[2] = {shell.system(1).effort(), shell.system(2).effort()};

  constexpr int steps = 15;
  for (int k = 1; k <= steps; ++k) {
    const double t = parameter(0.95 - 0.01 * k);
    INFO("step " << k);
    REQUIRE(shell.advance(t, watch).end == Outcome::reached);
    REQUIRE(exact.advance(t, watch).end == Outcome::reached);
    for (std::size_t level = 1; level <= 2; ++level)
      CHECK(max_column_norm(shell.state().levels[level].x - exact.state().levels[level].x) <
            tolerance_mm);
    // nor in the forces: 1e-5 of the largest is left in an edge, and four edges meet at a joint
    const double largest = exact.state().levels[2].force.cwiseAbs().maxCoeff();
    CHECK(shell.state().residual_N < 4e-5 * largest);
  }
  for (int level = 1; level <= 2; ++level) {
    const Effort spent = shell.system(level).effort() - before[level - 1];
    INFO("level " << level);
    CHECK(spent.factorizations <= steps + 1);
    CHECK(spent.newton_iterations <= 1.5 * steps);
  }
}

TEST_CASE("a state between two points of a path is found from where the path came past there") {
  const Scene scene = value_of(scene_of(paper_circle(8)));
  PathOptions options;
  options.target_move = 1e-3;
  const LevelPlan plan{{4, 8}, false};
  NestedShell shell = value_of(
      NestedShell::make(scene.footprint, scene.rods, RodModel::bend, scene.motion, plan, options));
  const double first = parameter(0.98);
  const State begin =
      first_buckled(shell.system(0), shell.mesh(0), shell.motion(0), first, {}, scene.flat, watch)
          .value();
  REQUIRE(shell.start(first, begin, watch).end == Outcome::reached);
  const NestedPathPoint before = shell.point();
  REQUIRE(shell.advance(1, watch).end == Outcome::reached);
  const NestedPathPoint after = shell.point();
  REQUIRE(after.way.size() > 3);
  CHECK(before.way.empty());

  // also where the path came past, and just behind
  for (const double t : {0.5 * (first + 1), after.way[1].t, after.way[1].t + 1e-7}) {
    const auto [from, to] = interval_at(before, after, t);
    CHECK(from->t < t);
    CHECK(to->t >= t);
    CHECK(to->t - from->t < 0.5 * (1 - first));
    const Effort start = shell.system(0).effort();
    REQUIRE(shell.sample(t, before, watch, &after).end == Outcome::reached);
    CHECK((shell.system(0).effort() - start).factorizations <= 3);
    const State found = shell.state().levels[1];
    REQUIRE(shell.sample(t, before, watch).end == Outcome::reached);
    CHECK(max_column_norm(shell.state().levels[1].x - found.x) < 1e-6);
  }
  // back the same way
  NestedPathPoint back = before;
  back.way.assign(after.way.rbegin(), after.way.rend());
  CHECK(interval_at(after, back, after.way[1].t - 1e-9).from->t == after.way[1].t);
}

TEST_CASE("a finer leader doubles all meshes, or is the second where the finest is fine enough") {
  CHECK(with_finer_leader({{4, 8}, false})->edges_per_segment == std::vector<int>{8, 16});
  CHECK(with_finer_leader({{16, 32, 64}, true})->edges_per_segment ==
        std::vector<int>{32, 64, 128});
  CHECK(with_finer_leader({{5, 10, 20, 40, 80}, true})->edges_per_segment ==
        std::vector<int>{10, 20, 40, 80});
  // what is left knows no error
  CHECK_FALSE(with_finer_leader({{32, 64, 128}, true}));
  CHECK_FALSE(with_finer_leader({{64, 128}, false}));
}
