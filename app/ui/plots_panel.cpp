// Curves of what was done so far: height and energy over the radius, force over depth, K in bins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "app/ui/look.h"
#include "app/ui/panel.h"

namespace gridshell::ui {
namespace {

struct Curve {
  const char* y_label;
  const char* x_label;
  const char* without;  ///< said where there is nothing to plot
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

/// Where a plot stands, and how it writes.
class PlotBox {
 public:
  PlotBox(const Panel& panel, ImVec2 low, ImVec2 high)
      : panel_(panel),
        list_(*ImGui::GetWindowDrawList()),
        line_(ImGui::GetTextLineHeight()),
        from_{low.x + panel.px(58), low.y + 1.3f * line_},
        to_{high.x, high.y - 1.3f * line_} {
    list_.AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg));
    list_.AddRect(from_, to_, ImGui::GetColorU32(ImGuiCol_Border));
  }

  void draw(const Curve& curve) {
    title(curve.y_label);
    if (curve.x.empty()) return say_none(curve.without);
    const Span x = curve.bars ? Span(-1, 1) : Span(curve.x);
    Span y(curve.y);
    // bars stand on zero
    if (curve.bars) y = Span(std::min(0.f, y.low), std::max(0.f, y.high));
    std::vector<ImVec2> points;
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      points.push_back({from_.x + x.at(curve.x[k]) * (to_.x - from_.x), height_of(y, curve.y[k])});
    if (curve.bars)
      draw_bars(points, height_of(y, 0));
    else
      draw_line(points);
    label_y(y, curve);
    label_x(curve.bars ? x : Span(least(curve.x), most(curve.x)), curve.x_label);
  }

 private:
  static float least(const std::vector<float>& v) { return *std::min_element(v.begin(), v.end()); }
  static float most(const std::vector<float>& v) { return *std::max_element(v.begin(), v.end()); }
  float height_of(const Span& y, float value) const {
    return to_.y - std::clamp(y.at(value), 0.f, 1.f) * (to_.y - from_.y);
  }
  ImU32 pale() const { return pale_ink(panel_.desk.show.dark); }
  static ImU32 ink() { return ImGui::GetColorU32(ImGuiCol_PlotLines); }

  void title(const char* text) {
    list_.AddText({from_.x - panel_.px(58), from_.y - 1.3f * line_},
                  ImGui::GetColorU32(ImGuiCol_Text), text);
  }
  void say_none(const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    list_.AddText({0.5f * (from_.x + to_.x - size.x), 0.5f * (from_.y + to_.y - size.y)}, pale(),
                  text);
  }
  void draw_bars(const std::vector<ImVec2>& points, float zero) {
    const float half = 0.35f * (to_.x - from_.x) / float(points.size());
    for (const ImVec2& p : points)
      list_.AddRectFilled({p.x - half, std::min(p.y, zero)}, {p.x + half, std::max(p.y, zero)},
                          ink());
    list_.AddLine({from_.x, zero}, {to_.x, zero}, pale());
  }
  void draw_line(const std::vector<ImVec2>& points) {
    list_.AddPolyline(points.data(), int(points.size()), ink(), 0, panel_.px(1.4));
    list_.AddCircleFilled(points.back(), panel_.px(3), ink());
  }
  void write_left(float value, float y) {
    std::string text = fmt::format("{:.3g}", value);
    if (text.size() > 7) text = fmt::format("{:.2g}", value);
    y = std::clamp(y, from_.y + 0.5f * line_, to_.y - 0.5f * line_);
    list_.AddText({from_.x - ImGui::CalcTextSize(text.c_str()).x - panel_.px(4), y - 0.5f * line_},
                  pale(), text.c_str());
  }
  /// The largest and the least value, at their heights; one alone where both would meet.
  void label_y(const Span& y, const Curve& curve) {
    const float high = curve.bars ? std::max(0.f, most(curve.y)) : most(curve.y),
                low = curve.bars ? std::min(0.f, least(curve.y)) : least(curve.y);
    write_left(high, height_of(y, high));
    if (height_of(y, low) - height_of(y, high) > 1.1f * line_) write_left(low, height_of(y, low));
  }
  void label_x(const Span& x, const char* label) {
    const float y = to_.y + panel_.px(2);
    const std::string low = fmt::format("{:.4g}", x.low), high = fmt::format("{:.4g}", x.high);
    const auto width = [](const char* text) { return ImGui::CalcTextSize(text).x; };
    list_.AddText({0.5f * (from_.x + to_.x - width(label)), y}, pale(), label);
    list_.AddText({from_.x, y}, pale(), low.c_str());
    if (high != low) list_.AddText({to_.x - width(high.c_str()), y}, pale(), high.c_str());
  }

  const Panel& panel_;
  ImDrawList& list_;
  float line_;
  ImVec2 from_, to_;
};

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
                            {"force (N)", "depth (mm)", "no joint is held", {}, {}},
                            {"K□ in bins (rad)", "x/L", "no cells", {}, {}, true}};
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const window::Reading& reading = readings[k];
    const auto x = float(abscissa ? abscissa(reading) : double(k + 1));
    const double values[] = {reading.height_mm, reading.energy_mJ, reading.force_N};
    for (std::size_t c = 0; c < (pushed ? 3 : 2); ++c) {
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
    PlotBox(panel, {low.x, low.y + height * float(k)},
            {low.x + space.x, low.y + height * float(k + 1) - panel.px(4)})
        .draw(curves[k]);
  ImGui::End();
}

}  // namespace gridshell::ui
