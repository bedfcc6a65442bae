// Curves of what was done so far: height and energy over the radius, force over depth, K in bins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "app/ui/plot_box.h"

namespace gridshell::ui {
namespace {

constexpr double jump = 0.2;  // of the boundary's way, between two equilibria

/// What the curves of height and energy run over: the depth of the last push, else the boundary's
/// way, else, where it rests, one equilibrium after the other.
struct Abscissa {
  std::span<const window::Reading> readings;
  const char* label;
  double (*of)(const window::Reading&);
};

Abscissa abscissa_of(const window::Desk& desk) {
  std::span<const window::Reading> all = desk.readings;
  const int joint = all.empty() ? -1 : all.back().joint;
  std::size_t since = all.size();
  while (since > 0 && all[since - 1].joint == joint) --since;
  all = all.subspan(since);
  if (joint >= 0) return {all, "depth (mm)", [](const auto& r) { return r.depth_mm; }};
  const bool moved = std::ranges::any_of(
      all, [&](const auto& r) { return std::abs(r.progress - all.front().progress) > 1e-9; });
  if (!moved) return {all, "equilibrium", nullptr};
  if (std::isfinite(desk.sight->frame.boundary_radius_mm))
    return {all, "R_a (mm)", [](const auto& r) { return r.radius_mm; }};
  return {all, "progress", [](const auto& r) { return r.progress; }};
}

std::vector<Curve> curves_of(const window::Desk& desk) {
  const auto [readings, over, abscissa] = abscissa_of(desk);
  const bool pushed = !readings.empty() && readings.back().joint >= 0;
  std::vector<Curve> curves{{"height (mm)", over, "", {}, {}},
                            {"energy (mJ)", over, "", {}, {}},
                            {"force along its way (N)", "depth (mm)", "no joint is held", {}, {}},
                            {"K□ in bins (rad)", "x/L", "no cells", {}, {}, true}};
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const window::Reading& reading = readings[k];
    const auto x = float(abscissa ? abscissa(reading) : double(k + 1));
    const double values[] = {reading.height_mm, reading.energy_mJ, reading.force_N};
    // the boundary was put elsewhere, not drawn there
    const bool jumped = k > 0 && abscissa && !pushed &&
                        std::abs(reading.progress - readings[k - 1].progress) > jump;
    for (std::size_t c = 0; c < (pushed ? 3 : 2); ++c) {
      if (jumped) curves[c].jumps.push_back(k);
      curves[c].x.push_back(x);
      curves[c].y.push_back(float(values[c]));
    }
  }
  const auto& bins = desk.sight->frame.K_bins;
  for (Eigen::Index k = 0; desk.sight->any() && k < bins.rows(); ++k) {
    if (!std::isfinite(bins(k, 0))) continue;
    curves[3].x.push_back(-1 + (2 * float(k) + 1) / float(bins.rows()));
    curves[3].y.push_back(float(bins(k, 0)));
  }
  return curves;
}

}  // namespace

void plots_panel(const Panel& panel, const render::Box& box) {
  begin_fixed("plots", box);
  heading(panel, "Plots");
  const std::vector<Curve> curves = curves_of(panel.desk);
  const ImVec2 low = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
  const float height = space.y / float(curves.size());
  for (std::size_t k = 0; k < curves.size(); ++k)
    draw_curve(panel, {low.x, low.y + height * float(k)},
               {low.x + space.x, low.y + height * float(k + 1) - panel.px(4)}, curves[k]);
  ImGui::End();
}

}  // namespace gridshell::ui
