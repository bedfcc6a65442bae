#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "app/window/panel.h"
#include "render/canvas/text.h"

namespace gridshell::window {
namespace {

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
    const auto shown = [&](float value) {
      return curve.logarithmic ? std::log10(std::max(1e-9f, value)) : value;
    };
    std::vector<float> heights;
    for (const auto* values : {&curve.y, &curve.second})
      for (const float value : *values) heights.push_back(shown(value));
    Span y(heights);
    // bars stand on zero
    if (curve.bars) y = Span(std::min(0.f, y.low), std::max(0.f, y.high));
    const auto points_of = [&](const std::vector<float>& values) {
      std::vector<ImVec2> points;
      for (std::size_t k = 0; k < values.size(); ++k)
        points.push_back(
            {from_.x + x.at(curve.x[k]) * (to_.x - from_.x), height_of(y, shown(values[k]))});
      return points;
    };
    if (curve.bars)
      draw_bars(points_of(curve.y), height_of(y, 0));
    else
      draw_line(points_of(curve.y), curve.jumps, ink());
    if (!curve.second.empty()) draw_line(points_of(curve.second), curve.jumps, pale());
    label_y(y, curve, shown);
    label_x(curve.bars ? x : Span(least(curve.x), most(curve.x)), curve.x_label);
  }

 private:
  static float least(const std::vector<float>& v) { return *std::min_element(v.begin(), v.end()); }
  static float most(const std::vector<float>& v) { return *std::max_element(v.begin(), v.end()); }
  float height_of(const Span& y, float value) const {
    return to_.y - std::clamp(y.at(value), 0.f, 1.f) * (to_.y - from_.y);
  }
  ImU32 pale() const { return text_colours(panel_.viewer.show.dark).muted; }
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
  void draw_line(const std::vector<ImVec2>& points, std::vector<std::size_t> ends, ImU32 colour) {
    ends.push_back(points.size());
    std::size_t from = 0;
    for (const std::size_t end : ends) {
      list_.AddPolyline(points.data() + from, int(end - from), colour, 0, panel_.px(1.4));
      from = end;
    }
    list_.AddCircleFilled(points.back(), panel_.px(3), colour);
  }
  void write_left(float value, float y) {
    std::string text = fmt::format("{:.3g}", value);
    if (text.size() > 7) text = fmt::format("{:.2g}", value);
    y = std::clamp(y, from_.y + 0.5f * line_, to_.y - 0.5f * line_);
    list_.AddText({from_.x - ImGui::CalcTextSize(text.c_str()).x - panel_.px(4), y - 0.5f * line_},
                  pale(), text.c_str());
  }
  /// The largest and the least value, at their heights; one alone where both would meet.
  template <class ShownFrame>
  void label_y(const Span& y, const Curve& curve, const ShownFrame& shown) {
    std::vector<float> all = curve.y;
    all.insert(all.end(), curve.second.begin(), curve.second.end());
    const float high = curve.bars ? std::max(0.f, most(all)) : most(all),
                low = curve.bars ? std::min(0.f, least(all)) : least(all);
    const float top = height_of(y, shown(high)), bottom = height_of(y, shown(low));
    write_left(high, top);
    if (bottom - top > 1.1f * line_) write_left(low, bottom);
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

}  // namespace

void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve) {
  PlotBox(panel, low, high).draw(curve);
}

// Curves of what was done so far: height and energy over the radius, force over depth, K in bins.

namespace {

constexpr double jump = 0.2;  // of the boundary's way, between two equilibria

/// What the curves of height and energy run over: the depth of the last push, else the boundary's
/// way, else, where it rests, one equilibrium after the other.
struct Abscissa {
  std::span<const PlotPoint> plot_points;
  const char* label;
  double (*of)(const PlotPoint&);
};

Abscissa abscissa_of(const ViewerState& viewer) {
  std::span<const PlotPoint> all = viewer.plot_points;
  const int joint = all.empty() ? -1 : all.back().joint;
  std::size_t since = all.size();
  while (since > 0 && all[since - 1].joint == joint) --since;
  all = all.subspan(since);
  if (joint >= 0) return {all, "depth (mm)", [](const auto& r) { return r.depth_mm; }};
  const bool moved = std::ranges::any_of(
      all, [&](const auto& r) { return std::abs(r.progress - all.front().progress) > 1e-9; });
  if (!moved) return {all, "equilibrium", nullptr};
  if (std::isfinite(viewer.shell->frame.boundary_radius_mm))
    return {all, "R_a (mm)", [](const auto& r) { return r.radius_mm; }};
  return {all, "progress", [](const auto& r) { return r.progress; }};
}

std::vector<Curve> curves_of(const ViewerState& viewer) {
  const auto [plot_points, over, abscissa] = abscissa_of(viewer);
  const bool pushed = !plot_points.empty() && plot_points.back().joint >= 0;
  std::vector<Curve> curves{{"height (mm)", over, "", {}, {}},
                            {"energy (mJ)", over, "", {}, {}},
                            {"force along its way (N)", "depth (mm)", "no joint is held", {}, {}},
                            {"K□ in bins (rad)", "x/L", "no cells", {}, {}, true}};
  for (std::size_t k = 0; k < plot_points.size(); ++k) {
    const PlotPoint& reading = plot_points[k];
    const auto x = float(abscissa ? abscissa(reading) : double(k + 1));
    const double values[] = {reading.height_mm, reading.energy_mJ, reading.force_N};
    // the boundary was put elsewhere, not drawn there
    const bool jumped = k > 0 && abscissa && !pushed &&
                        std::abs(reading.progress - plot_points[k - 1].progress) > jump;
    for (std::size_t c = 0; c < (pushed ? 3 : 2); ++c) {
      if (jumped) curves[c].jumps.push_back(k);
      curves[c].x.push_back(x);
      curves[c].y.push_back(float(values[c]));
    }
  }
  const auto& bins = viewer.shell->frame.K_bins;
  for (Eigen::Index k = 0; viewer.shell->any() && k < bins.rows(); ++k) {
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
  const std::vector<Curve> curves = curves_of(panel.viewer);
  const ImVec2 low = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
  const float height = space.y / float(curves.size());
  for (std::size_t k = 0; k < curves.size(); ++k)
    draw_curve(panel, {low.x, low.y + height * float(k)},
               {low.x + space.x, low.y + height * float(k + 1) - panel.px(4)}, curves[k]);
  ImGui::End();
}

// What the colours of the view mean, over its right edge.

namespace {

/// Texts that end at given places, over a pale ground as large as they are.
class Ground {
 public:
  Ground(const Panel& panel, ImDrawList& list, ImVec2 corner)
      : list_(list), low_(corner), high_(corner), margin_(panel.px(6)) {
    list_.ChannelsSplit(2);
    list_.ChannelsSetCurrent(1);
  }
  ~Ground() {
    list_.ChannelsSetCurrent(0);
    list_.AddRectFilled({low_.x - margin_, low_.y - margin_},
                        {high_.x + margin_, high_.y + margin_},
                        ImGui::GetColorU32(ImGuiCol_WindowBg, 0.75f), margin_);
    list_.ChannelsMerge();
  }
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  void text(const std::string& words, float right, float top) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    list_.AddText({right - size.x, top}, ImGui::GetColorU32(ImGuiCol_Text), words.c_str());
    low_.x = std::min(low_.x, right - size.x);
    reach(top + size.y);
  }
  void reach(float bottom) { high_.y = std::max(high_.y, bottom); }

 private:
  ImDrawList& list_;
  ImVec2 low_, high_;
  float margin_;
};

void bar(const render::ColourScale& scale, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr int steps = 64;
  const float height = high.y - low.y;
  for (int k = 0; k < steps; ++k) {
    const render::Colour c = scale(scale.high - (scale.high - scale.low) * (k + 0.5) / steps);
    const auto byte = [](float v) { return int(std::lround(255 * v)); };
    list.AddRectFilled({low.x, low.y + height * float(k) / steps},
                       {high.x, low.y + height * float(k + 1) / steps},
                       IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255));
  }
  list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_TextDisabled));
}

}  // namespace

void colour_legend(const Panel& panel, const render::Box& view) {
  const ViewerState& viewer = panel.viewer;
  if (!viewer.shell->any() || viewer.show.colour_by == ColourBy::none) return;
  const float line = ImGui::GetTextLineHeight(), width = panel.px(14);
  // in a low view the bar leaves room for the notes below it
  const float height = std::min(panel.px(170), std::max(2 * line, float(view.height) - 8 * line));
  const float right = float(view.right()) - panel.px(14), top = float(view.y) + panel.px(14);
  Ground ground(panel, *ImGui::GetWindowDrawList(), {right, top});
  ground.text(label_of(*viewer.shell, viewer.show.colour_by), right, top);
  const Eigen::VectorXd values = values_of(*viewer.shell, viewer.show.colour_by);
  if (values.size() == 0) return ground.text("not known for this shell", right, top + 1.3f * line);
  const render::ColourScale& scale = viewer.show.scale;
  const float low = top + 1.6f * line, left = right - width;
  bar(scale, {left, low}, {right, low + height});
  ground.reach(low + height);
  for (const render::Tick& tick : render::linear_ticks(scale.low, scale.high, 4)) {
    if (!tick.major) continue;
    const auto down = float((scale.high - tick.value) / (scale.high - scale.low));
    ground.text(fmt::format("{:.6g}", tick.value), left - panel.px(5),
                low + height * down - 0.5f * line);
  }
  // the end colours stand for all that lies beyond them
  const double slack = 1e-9 * (scale.high - scale.low);
  float note = low + height + 0.8f * line;
  if (values.maxCoeff() > scale.high + slack) {
    ground.text(fmt::format("up to {:.3g}", values.maxCoeff()), right, note);
    note += 1.2f * line;
  }
  if (values.minCoeff() < scale.low - slack)
    ground.text(fmt::format("down to {:.3g}", values.minCoeff()), right, note);
}

}  // namespace gridshell::window
