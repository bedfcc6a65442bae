// Curves of what was done so far: height and energy over the radius, force over depth, K in bins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/ui/look.h"
#include "app/ui/panel.h"

namespace gridshell::ui {
namespace {

struct Curve {
  const char* y_label;
  const char* x_label;
  std::vector<float> x, y;
  bool bars = false;
};

/// Low and high with some room; never of no width.
struct Span {
  float low = 0, high = 1;

  Span(float from, float to) : low(from), high(to) {}
  explicit Span(const std::vector<float>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const float middle = 0.5f * (*least + *most);
    const float half = std::max(0.55f * (*most - *least), 1e-4f + 0.02f * std::abs(middle));
    low = middle - half;
    high = middle + half;
  }
  float at(float value) const { return (value - low) / (high - low); }
};

void draw_curve(const Panel& panel, const Curve& curve, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool dark = panel.desk.show.dark;
  const ImU32 pale = pale_ink(dark), ink = ImGui::GetColorU32(ImGuiCol_PlotLines);
  const float line = ImGui::GetTextLineHeight();
  list.AddText({low.x, low.y}, ImGui::GetColorU32(ImGuiCol_Text), curve.y_label);
  const ImVec2 from{low.x + panel.px(4), low.y + 1.2f * line}, to{high.x, high.y - 1.3f * line};
  list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
  list.AddRect(from, to, ImGui::GetColorU32(ImGuiCol_Border));
  const auto right = [&](const std::string& text, float y) {
    list.AddText({to.x - ImGui::CalcTextSize(text.c_str()).x - panel.px(3), y}, pale, text.c_str());
  };
  if (curve.x.empty()) return;
  const Span x = curve.bars ? Span(-1, 1) : Span(curve.x);
  Span y(curve.y);
  // bars stand on zero
  if (curve.bars) y = Span(std::min(0.f, y.low), std::max(0.f, y.high));
  std::vector<ImVec2> points;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    points.push_back(
        {from.x + x.at(curve.x[k]) * (to.x - from.x), to.y - y.at(curve.y[k]) * (to.y - from.y)});
  if (curve.bars) {
    const float zero = to.y - std::clamp(y.at(0), 0.f, 1.f) * (to.y - from.y);
    const float half = 0.35f * (to.x - from.x) / float(points.size());
    for (const ImVec2& p : points)
      list.AddRectFilled({p.x - half, std::min(p.y, zero)}, {p.x + half, std::max(p.y, zero)}, ink);
  } else {
    list.AddPolyline(points.data(), int(points.size()), ink, 0, panel.px(1.4));
    list.AddCircleFilled(points.back(), panel.px(3), ink);
  }
  right(fmt::format("{:.4g}", *std::max_element(curve.y.begin(), curve.y.end())), low.y);
  const auto [least, most] = std::minmax_element(curve.x.begin(), curve.x.end());
  const std::string first = fmt::format("{:.4g}", curve.bars ? x.low : *least);
  list.AddText({from.x, to.y + panel.px(2)}, pale, first.c_str());
  right(fmt::format("{:.4g}", curve.bars ? x.high : *most), to.y + panel.px(2));
  const float middle = 0.5f * (from.x + to.x - ImGui::CalcTextSize(curve.x_label).x);
  list.AddText({middle, to.y + panel.px(2)}, pale, curve.x_label);
}

}  // namespace

void plots_panel(const Panel& panel, const render::Box& box) {
  begin_fixed("plots", box);
  heading(panel, "Plots");
  const window::Desk& desk = panel.desk;
  const bool circle = desk.sight->any() && std::isfinite(desk.sight->frame.boundary_radius_mm);
  const char* over = circle ? "R_a (mm)" : "progress";
  std::vector<Curve> curves{{"height (mm)", over, {}, {}},
                            {"energy (mJ)", over, {}, {}},
                            {"force (N)", "depth (mm)", {}, {}},
                            {"K□ in bins (rad)", "x/L", {}, {}, true}};
  for (const window::Reading& reading : desk.readings) {
    for (std::size_t k = 0; k < 2; ++k)
      curves[k].x.push_back(float(circle ? reading.radius_mm : reading.progress));
    curves[0].y.push_back(float(reading.height_mm));
    curves[1].y.push_back(float(reading.energy_mJ));
    if (reading.depth_mm > 0) {
      curves[2].x.push_back(float(reading.depth_mm));
      curves[2].y.push_back(float(reading.force_N));
    }
  }
  const auto& bins = desk.sight->frame.K_bins;
  for (Eigen::Index k = 0; desk.sight->any() && k < bins.rows(); ++k) {
    if (!std::isfinite(bins(k, 0))) continue;
    curves[3].x.push_back(-1 + (2 * float(k) + 1) / float(bins.rows()));
    curves[3].y.push_back(float(bins(k, 0)));
  }
  const ImVec2 low = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
  const float height = space.y / float(curves.size());
  for (std::size_t k = 0; k < curves.size(); ++k)
    draw_curve(panel, curves[k], {low.x, low.y + height * float(k)},
               {low.x + space.x, low.y + height * float(k + 1) - panel.px(4)});
  ImGui::End();
}

}  // namespace gridshell::ui
