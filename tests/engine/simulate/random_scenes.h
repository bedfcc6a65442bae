// Random circular shells to judge error estimates by: the estimate beside the true error, which is
// measured against meshes two levels finer on the same branch.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "engine/simulate/actuation.h"
#include "engine/simulate/run.h"
#include "engine/study/trust_study.h"

namespace gridshell {

/// What one scene came to. Errors are those of the joints over R_o.
struct EstimateTrial {
  std::string scene;  ///< what was asked
  double tolerance = 0;
  std::string refused;  ///< why there is no state to judge; empty when there is one
  double estimate = 0, truth = 0;
};

/// n of 4 to 16, placement by its parity, longest leg 0.2 to 2.5 d, R_a/R_o 0.6 to 0.95, tolerance
/// 1e-2 to 1e-6, all from one generator.
inline preset::Preset random_scene(std::mt19937& random) {
  study::RandomDraw draw(random);
  preset::Preset p;
  p.footprint.rods = draw.integer(4, 16);
  p.footprint.placement =
      p.footprint.rods % 2 ? preset::Placement::on_axis : preset::Placement::half;
  p.footprint.radius_mm = 20 * ((p.footprint.rods - 1) / 2.0 + draw.between(0.2, 2.5));
  p.actuation.radius_mm = p.footprint.radius_mm * draw.between(0.6, 0.95);
  p.accuracy.tolerance = std::pow(10, draw.between(-6, -2));
  return p;
}

inline EstimateTrial try_estimate(const preset::Preset& preset) {
  EstimateTrial trial;
  trial.tolerance = preset.accuracy.tolerance;
  trial.scene =
      fmt::format("n {:2} R_o {:6.2f} mm R_a/R_o {:.3f} tolerance {:.1e}", preset.footprint.rods,
                  preset.footprint.radius_mm,
                  preset.actuation.radius_mm / preset.footprint.radius_mm, trial.tolerance);
  Watch watch;
  const auto run = [&](const preset::Preset& p) { return simulate::run(p, true, watch); };
  const auto asked = run(preset);
  if (!asked) {
    trial.refused = asked.error().message;
    return trial;
  }
  if (asked->summary.limit != record::Limit::none && asked->summary.limit != record::Limit::snap) {
    trial.refused = asked->summary.limit_reason;
    return trial;
  }
  // two meshes finer and extrapolated, on the same branch
  Scene exact = scene_of(preset).value();
  exact.tolerance = std::min(preset.accuracy.tolerance, 1e-6);
  LevelPlan plan{{4}, true};
  while (plan.edges_per_segment.back() < std::min(128, 4 * asked->summary.edges_per_segment))
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  const auto finer = simulate::follow_actuation(std::make_shared<const Scene>(std::move(exact)),
                                                plan, false, 1, watch);
  if (!finer || finer->limit != asked->summary.limit) {
    trial.refused = "reference: " + (finer ? finer->limit_reason : finer.error().message);
    return trial;
  }
  const auto& a = asked->trajectory;
  double worst = 0;
  for (std::size_t k = 0; k < a.layout.joints.size(); ++k)
    worst = std::max(worst, (a.frames.back().nodes.col(a.layout.joints[k].node) -
                             finer->simulation.nodes().col(Eigen::Index(k)))
                                .norm());
  trial.truth = worst / preset.footprint.radius_mm;
  // which state a snap leads to is told, and judged by the chart of trust
  if (asked->summary.limit == record::Limit::snap && trial.truth > 1e-2) {
    trial.refused = "reference: in another state after " + finer->limit_reason;
    return trial;
  }
  trial.estimate = a.frames.back().error_estimate_mm / preset.footprint.radius_mm;
  return trial;
}

}  // namespace gridshell
