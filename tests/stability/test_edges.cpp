// Every method at parameters on both sides of its limit of stability, as in the maps, on a shell
// small enough for every build.
#include "engine/study/benchmark_methods.h"
#include "engine/study/method_studies.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::study;
using record::RunOutcome;

namespace {

std::shared_ptr<BenchmarkProblem> small_case() {
  static const std::shared_ptr<BenchmarkProblem> made = [] {
    Watch watch;
    return std::shared_ptr<BenchmarkProblem>(
        BenchmarkProblem::create(paper_circle(4, 0.85), 64, watch).value());
  }();
  return made;
}

/// Outcomes of the cells of a map.
class Map {
 public:
  explicit Map(Cells cells) {
    Watch watch;
    StabilityOptions options;
    options.seconds = 10;
    options.threads = 1;
    REQUIRE(run_cells(cells, options, watch));
    for (Cell& cell : cells) {
      rows_.push_back(cell.row);
      UNSCOPED_INFO(cell.row.method << " " << cell.row.x << " " << cell.row.y << " "
                                    << word_of(cell.row.outcome));
    }
  }
  RunOutcome operator()(const char* method, double x, double y) const {
    for (const auto& row : rows_)
      if (row.method == method && row.x == x && row.y == y) return row.outcome;
    FAIL("no such cell");
    return {};
  }
  bool right(const char* method, double x, double y) const {
    return (*this)(method, x, y) == RunOutcome::right;
  }

 private:
  std::vector<record::StabilityRow> rows_;
};

}  // namespace

TEST_CASE("stability: the explicit integrator is stable below l_min/c and blows up above") {
  const Map at(explicit_map(small_case(), {0.5, 0.8, 1.2, 1.8}, {4}));
  for (const double step : {0.5, 0.8, 1.2, 1.8})
    CHECK(at("explicit", step, 4) == (step < 1 ? RunOutcome::right : RunOutcome::blow_up));
}

TEST_CASE("stability: dynamic relaxation is stable up to its limit step") {
  const Map at(relaxation_map(small_case(), {0.95, 1.2, 1.8}, {1, 2}));
  for (double edges : {1.0, 2.0}) {
    CHECK(at.right("dynamic relaxation", 0.95, edges));
    CHECK(at("dynamic relaxation", 1.8, edges) == RunOutcome::blow_up);
  }
  CHECK(at("dynamic relaxation", 1.2, 2) == RunOutcome::blow_up);
}

TEST_CASE("stability: Newton's full steps need many load steps, a shift fewer, the default none",
          "[standard]") {
  // on 2 edges per segment it depends on round-off whether three full steps succeed
  const Map at(newton_map(small_case(), {1, 3, 30}, {4, 8}));
  for (double edges : {4.0, 8.0}) {
    for (double steps : {1.0, 3.0, 30.0}) CHECK(at.right(default_solver, steps, edges));
    // in one step both reach another state without a message
    CHECK(record::silently_wrong(at("full steps", 1, edges)));
    CHECK(record::silently_wrong(at("shifted", 1, edges)));
    CHECK_FALSE(at.right("full steps", 3, edges));
    CHECK(at.right("shifted", 3, edges));
    for (const char* method : {"full steps", "line search", "shifted"})
      CHECK(at.right(method, 30, edges));
  }
}

TEST_CASE(
    "stability: without a seed Newton's method finds the planar saddle and calls it success") {
  const Map at(seed_map(small_case(), {0, 1e-12, 10}, {2}));
  for (double seed : {0.0, 1e-12}) {
    CHECK(at("full steps", seed, 2) == RunOutcome::planar_saddle);
    CHECK(at("line search", seed, 2) == RunOutcome::planar_saddle);
    CHECK(at("shifted", seed, 2) != RunOutcome::planar_saddle);
    CHECK(at.right(default_solver, seed, 2));
  }
}

TEST_CASE(
    "stability: stiff rods and legs of a hundredth of a cell stop full steps, not the default") {
  const Map stiff(stiffness_map(paper_circle(4, 0.85), {1, 1e4}, {3}, 2));
  CHECK(stiff.right(default_solver, 1, 3));
  CHECK(stiff.right(default_solver, 1e4, 3));
  CHECK(stiff.right("shifted", 1, 3));
  CHECK_FALSE(stiff.right("full steps", 1e4, 3));
  const Map legs(leg_map(paper_circle(4, 0.85), {1e-2}, {10}, 4));
  CHECK(legs.right(default_solver, 1e-2, 10));
  CHECK(legs.right("shifted", 1e-2, 10));
  CHECK_FALSE(legs.right("full steps", 1e-2, 10));
}

TEST_CASE("stability: the default promises the tolerance of the joints, and keeps it") {
  const Map at(tolerance_map(small_case(), {1e-4, 1e-2, 1}, {3}, 2));
  int wrong = 0;
  for (double tolerance : {1e-4, 1e-2, 1.0}) {
    CHECK(at.right(default_solver, tolerance, 3));
    wrong += !at.right("full steps", tolerance, 3);
  }
  // which of them are wrong depends on how sums round
  CHECK(wrong > 0);
}

TEST_CASE("stability: with spring joints full steps find another state, shifted ones do not") {
  const Map at(joint_map(small_case(), {1, 1e6}, {3, 5}, 1));
  for (double stiffness : {1.0, 1e6}) {
    int wrong = 0;
    for (double steps : {3.0, 5.0}) {
      CHECK(at.right("shifted", stiffness, steps));
      wrong += !at.right("full steps", stiffness, steps);
    }
    CHECK(wrong > 0);
  }
}

TEST_CASE("stability: the judge distinguishes states, whatever a method says") {
  const auto study = small_case();
  const Problem& problem = *study->problem(4, Watch()).value();
  const double near = 1e-4;
  CHECK(verdict_at_end(*study, problem, problem.end.x, near) == RunOutcome::right);
  // the mirror image is stable too
  Eigen::Matrix3Xd mirrored = problem.end.x;
  mirrored.row(2) *= -1;
  CHECK(verdict_at_end(*study, problem, mirrored, near) == RunOutcome::other_state);
  Eigen::Matrix3Xd planar = problem.end.x;
  planar.row(2).setZero();
  CHECK(verdict_at_end(*study, problem, planar, near) == RunOutcome::planar_saddle);
  // the start is an equilibrium of another boundary
  CHECK(verdict_at_end(*study, problem, problem.start.x, near) == RunOutcome::silent_wrong);
  Eigen::Matrix3Xd broken = problem.end.x;
  broken(0, 0) = NAN;
  CHECK(verdict_at_end(*study, problem, broken, near) == RunOutcome::silent_wrong);
  // an outcome that a method itself reports is accepted
  MethodResult admitted;
  admitted.claim = RunOutcome::blow_up;
  admitted.x = problem.end.x;
  CHECK(verdict_of(*study, admitted, near, near, Watch()) == RunOutcome::blow_up);
}

TEST_CASE("stability: what cells share is made under a watch, and ends when it is cancelled") {
  Cells cells = joint_map(small_case(), {1}, {3}, 1);
  for (Cell& cell : stiffness_map(paper_circle(4, 0.85), {1}, {3}, 1))
    cells.push_back(std::move(cell));
  for (Cell& cell : cells) {
    Watch stopped;
    stopped.cancel();
    cell.prepare(stopped);
    CHECK(cell.run(Watch()) == RunOutcome::refused);
  }
}
