// The study of speed and accuracy on a small shell: its methods agree, and its errors fall.
#include "engine/study/method_studies.h"

#include <cstdlib>
#include <set>

#include "engine/core/team.h"
#include "engine/study/benchmark_methods.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::study;
using record::RunOutcome;

namespace {

const record::AccuracyRow* find(const AccuracyStudy& study, const std::string& method, int edges) {
  for (const auto& row : study.rows)
    if (row.method == method && row.edges_per_segment == edges) return &row;
  return nullptr;
}

}  // namespace

TEST_CASE("a case starts and ends every mesh on the branch of its reference") {
  Watch watch;
  const auto made = value_of(BenchmarkProblem::create(paper_circle(4, 0.85), 64, watch));
  BenchmarkProblem& study = *made;
  CHECK(study.reference_error() < 1e-6);
  double before = 0;
  for (int edges : {2, 4, 8, 16}) {
    const Problem* problem = study.problem(edges, watch).value();
    const double error = study.error_of(problem->end.x);
    CAPTURE(edges, error);
    if (before > 0) CHECK(before / error == Approx(4).epsilon(0.35));
    before = error;
    // the start is where the rods are 2 % shorter: R_a = 0.98 R_o
    CHECK(problem->motion.at(problem->t)(0, problem->mesh.joints) ==
          Approx(0.98 * problem->motion.begin(0, problem->mesh.joints)));
  }
}

TEST_CASE("every method reaches the same state of its mesh, the error falls with the edges",
          "[standard]") {
  Watch watch;
  AccuracyOptions options;
  options.seconds = 20;
  options.finest = 64;
  options.most_edges = 4;
  options.runs = 1;
  options.scaling = false;
  const auto study = value_of(accuracy_study(paper_circle(4, 0.85), options, watch));
  std::set<std::string> methods;
  for (const auto& row : study.rows) {
    CAPTURE(row.method, row.edges_per_segment, row.error, word_of(row.outcome));
    methods.insert(row.method);
    CHECK_FALSE(record::silently_wrong(row.outcome));
    if (row.outcome == RunOutcome::right) {
      CHECK(row.cpu_min_s <= row.cpu_s);
      CHECK(row.cpu_s <= row.cpu_max_s);
    }
    // the error depends on the mesh, not on the method, except for joints that are springs
    const auto* bend = find(study, "bend", row.edges_per_segment);
    const bool of_mesh = !row.method.starts_with("springs") && !row.method.starts_with("auto");
    if (bend && of_mesh && row.outcome == RunOutcome::right)
      CHECK(row.error == Approx(bend->error).epsilon(0.1));
  }
  CHECK(methods.size() >= 15);
  // softer springs open the joints further
  CHECK(std::abs(find(study, "springs 1 N/mm", 4)->error - find(study, "bend", 4)->error) >
        10 * std::abs(find(study, "springs 100 N/mm", 4)->error - find(study, "bend", 4)->error));
  for (const auto& at : study.outcomes) CHECK(at.error < at.tolerance);
}

TEST_CASE("a run that exceeds its time is stopped and reported as too slow") {
  Watch watch;
  auto made = value_of(BenchmarkProblem::create(paper_circle(4, 0.85), 16, watch));
  const TimeLimit limit(0.05, watch);
  RelaxationOptions forever{.kind = Relaxation::explicit_damped, .tolerance_N = 0};
  const auto arrival = relax(*made->problem(4, watch).value(), forever, limit.watch());
  CHECK(arrival.claim == RunOutcome::too_slow);
  CHECK(limit.ran_out());
  CHECK(arrival.seconds < 2);
}

TEST_CASE("a study of what has no path to compare with is refused with the reason") {
  Watch watch;
  const auto preset = paper_circle(4, 0.99);
  CHECK(refusal(BenchmarkProblem::create(preset, 16, watch)) ==
        "the boundary shortens the rods by less than 2 %: too little for a study");
}

TEST_CASE("a relaxation does not depend on the random numbers of its process") {
  Watch watch;
  auto made = value_of(BenchmarkProblem::create(paper_circle(4, 0.85), 16, watch));
  std::srand(5);
  const int first = std::rand();
  std::srand(5);
  const TimeLimit limit(0.02, watch);
  (void)relax(*made->problem(1, watch).value(), {.kind = Relaxation::explicit_damped},
              limit.watch());
  CHECK(std::rand() == first);
}
