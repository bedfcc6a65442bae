// Error estimates of random circles beside the true error, which is measured against meshes two
// levels finer on the same branch. GRIDSHELL_TRIALS=100 looks at more of them.
#include <cstdlib>
#include <random>

#include "engine/simulate/actuation.h"
#include "engine/study/trust_study.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

/// 4 to 16 rods, longest leg 0.2 to 2.5 d, R_a/R_o 0.6 to 0.95, tolerance 1e-2 to 1e-6.
preset::Preset random_circle(std::mt19937& random) {
  study::RandomDraw draw(random);
  const int rods = draw.integer(4, 16);
  const double radius = 20 * ((rods - 1) / 2.0 + draw.between(0.2, 2.5));
  preset::Preset p = circle(rods, radius, radius * draw.between(0.6, 0.95));
  p.accuracy.tolerance = std::pow(10, draw.between(-6, -2));
  return p;
}

}  // namespace

TEST_CASE("random circles: the error estimate is honest and useful, the tolerance is met",
          "[full]") {
  std::mt19937 random(2018);
  const char* more = std::getenv("GRIDSHELL_TRIALS");
  const int trials = more ? std::atoi(more) : 4;
  int judged = 0;
  for (int k = 0; k < trials; ++k) {
    const preset::Preset p = random_circle(random);
    Watch watch;
    const auto asked = simulate::run(p, true, watch);
    if (!asked) continue;
    const record::Limit limit = asked->summary.limit;
    if (limit != record::Limit::none && limit != record::Limit::snap) continue;
    // two meshes finer and extrapolated
    Scene exact = scene_of(p).value();
    exact.tolerance = std::min(p.accuracy.tolerance, 1e-6);
    LevelPlan plan{{4}, true};
    while (plan.edges_per_segment.back() < std::min(128, 4 * asked->summary.edges_per_segment))
      plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
    const auto finer = simulate::follow_actuation(std::make_shared<const Scene>(std::move(exact)),
                                                  plan, false, 1, watch);
    if (!finer || finer->limit != limit) continue;
    const Eigen::Matrix3Xd joints = joints_of(asked->trajectory);
    const double truth =
                     max_column_norm(joints - finer->simulation.nodes().leftCols(joints.cols())),
                 estimate = last_frame(*asked).error_estimate_mm, radius = p.footprint.radius_mm;
    // which state a snap leads to is told, and judged by the chart of trust
    if (limit == record::Limit::snap && truth > 1e-2 * radius) continue;
    INFO(p.footprint.rods << " rods, " << radius << " mm: error " << truth << " estimate "
                          << estimate);
    ++judged;
    CHECK(truth < 2 * estimate);
    CHECK(estimate <= 5 * truth);
    CHECK(truth <= p.accuracy.tolerance * radius);
  }
  CHECK(judged >= 0.75 * trials);
}
