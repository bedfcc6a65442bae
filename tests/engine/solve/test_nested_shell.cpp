// Finer meshes along a path, and their small cost there.
#include "engine/solve/nested_shell.h"

#include <cmath>

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

/// The seed's state on the finest mesh at t.
State first_state(NestedShell& shell, const Scene& scene, double t) {
  return value_of(
      first_buckled(shell.system(), shell.finest(), shell.motion(), t, {}, scene.flat, watch));
}

}  // namespace

TEST_CASE("along a path companions take one correction a state, and it is the exact state") {
  const Scene scene = value_of(scene_of(paper_circle(8)));
  NestedShell shell = shell_of(scene, tolerance_mm), exact = shell_of(scene, 1e-9);
  const double first = parameter(0.95);
  const State begin = first_state(shell, scene, first);
  REQUIRE(shell.start(first, begin, watch).end == Outcome::reached);
  REQUIRE(exact.start(first, begin, watch).end == Outcome::reached);
  const Effort before[2] = {shell.system(0).effort(), shell.system(1).effort()};

  constexpr int steps = 15;
  for (int k = 1; k <= steps; ++k) {
    const double t = parameter(0.95 - 0.01 * k);
    INFO("step " << k);
    REQUIRE(shell.advance(t, watch).end == Outcome::reached);
    REQUIRE(exact.advance(t, watch).end == Outcome::reached);
    CHECK(shell.state().measured == 0);
    // forces agree, too: an edge has an error of 1e-5 of the largest, and four edges meet at a
    // joint
    const double largest = exact.state().levels[2].force.cwiseAbs().maxCoeff();
    CHECK(shell.state().residual_N < 4e-5 * largest);
    for (int level = 0; level < 3; ++level) {
      const State& found = shell.state().levels[std::size_t(level)];
      CHECK(max_column_norm(found.x - exact.state().levels[std::size_t(level)].x) < tolerance_mm);
      shell.system(level).gradient_at(found);
      CHECK(shell.system(level).residual() < 4e-5 * largest);
    }
  }
  for (int level = 0; level < 2; ++level) {
    const Effort spent = shell.system(level).effort() - before[level];
    INFO("level " << level);
    CHECK(spent.factorizations <= steps + 3);
    CHECK(spent.newton_iterations <= 2 * steps);
  }
}

TEST_CASE("a companion without a state near the fine one leaves the error unknown") {
  // 2 edges per segment: at a tenth of the length the coarse shell is another one
  const Scene scene = value_of(scene_of(paper_circle(8)));
  PathOptions options;
  options.spacing_mm = 1e-3;  // half of it is how far a companion may lie
  NestedShell shell = value_of(NestedShell::make(scene.footprint, scene.rods, RodModel::bend,
                                                 scene.motion, {{4, 8}, false}, options));
  const double first = parameter(0.95);
  REQUIRE(shell.start(first, first_state(shell, scene, first), watch).end == Outcome::reached);
  CHECK(shell.state().measured == 1);
  CHECK(std::isnan(shell.state().error_estimate_mm));
  CHECK_FALSE(shell.extrapolates());
  // the fine state, restricted, replaces it: the path can continue from there
  CHECK(shell.state().levels[0].x.leftCols(shell.mesh(0).joints) ==
        shell.state().levels[1].x.leftCols(shell.mesh(0).joints));
  CHECK(shell.point().companions[0].x.size() == 0);
}

TEST_CASE("a state between two points of a path is found in one step, whichever is nearer") {
  const Scene scene = value_of(scene_of(paper_circle(8)));
  NestedShell shell = shell_of(scene, tolerance_mm);
  const double first = parameter(0.9), next = parameter(0.89);
  REQUIRE(shell.start(first, first_state(shell, scene, first), watch).end == Outcome::reached);
  const NestedPathPoint before = shell.point();
  REQUIRE(shell.advance(next, watch).end == Outcome::reached);
  const NestedPathPoint after = shell.point();
  const double t = 0.5 * (first + next);
  const Effort start = shell.system().effort();
  REQUIRE(shell.sample(t, before, watch, &after).end == Outcome::reached);
  CHECK((shell.system().effort() - start).factorizations <= 2);
  const State found = shell.state().levels[2];
  REQUIRE(shell.sample(t, after, watch).end == Outcome::reached);
  CHECK(max_column_norm(shell.state().levels[2].x - found.x) < 2 * tolerance_mm);
  // the state of a point of the path needs no factorisation of its mesh
  const Effort there = shell.system().effort();
  REQUIRE(shell.sample(first, before, watch).end == Outcome::reached);
  CHECK((shell.system().effort() - there).factorizations == 0);
  CHECK(max_column_norm(shell.state().levels[2].x - before.state.x) < 1e-12);
}

TEST_CASE("a finer plan has twice the edges, and at most three meshes") {
  CHECK(finer({{4, 8}, false})->edges_per_segment == std::vector<int>{4, 8, 16});
  CHECK(finer({{4, 8}, false})->extrapolate);
  CHECK(finer({{4, 8, 16}, true})->edges_per_segment == std::vector<int>{8, 16, 32});
  CHECK(finer({{5}, false})->edges_per_segment == std::vector<int>{5, 10});
  CHECK_FALSE(finer({{32, 64, 128}, true}));
  CHECK(plan_levels(2e-3).edges_per_segment == std::vector<int>{4, 8});
  CHECK(plan_levels(1e-3).edges_per_segment == std::vector<int>{2, 4, 8});
  CHECK(plan_levels(1e-3, 5).edges_per_segment == std::vector<int>{10, 20});
  CHECK(plan_levels(1e-3, 4, 2).edges_per_segment == std::vector<int>{8, 16});
  CHECK(plan_levels(1e-4).edges_per_segment == std::vector<int>{4, 8, 16});
  // no tolerance has finer meshes than finer() allows
  for (const double tolerance : {1e-9, 0.0, -1.0, std::nan("")})
    CHECK(plan_levels(tolerance).edges_per_segment.back() <= 128);
  CHECK(plan_levels(1e-9).edges_per_segment == std::vector<int>{32, 64, 128});
  CHECK(plan_of_mesh(32).edges_per_segment == std::vector<int>{8, 16, 32});
  CHECK(plan_of_mesh(7).edges_per_segment == std::vector<int>{7});
}
