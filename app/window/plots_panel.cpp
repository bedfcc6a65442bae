#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/window/panel.h"
#include "render/canvas/text.h"

namespace gridshell::window {
namespace {

/// Lowest and highest value with a margin; never of zero width. Unknown values are ignored.
struct Span {
  float low = 0, high = 1;

  Span(float from, float to) : low(from), high(to) {}
  explicit Span(const std::vector<float>& values) {
    float least = std::numeric_limits<float>::infinity(), most = -least;
    for (const float value : values)
      if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
    if (least > most) return;
    const float middle = 0.5f * (least + most);
    const float half = std::max(0.55f * (most - least), 1e-4f + 0.02f * std::abs(middle));
    low = middle - half;
    high = middle + half;
  }
  float at(float value) const { return (value - low) / (high - low); }
};

/// A plot in a rectangle of the panel.
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
    title(curve.x.empty() ? curve.y_label
                          : fmt::format("{} over {}", curve.y_label, curve.x_label));
    if (curve.x.empty()) return say_none(curve.without);
    const Span x = curve.bars ? Span(-1, 1) : Span(curve.x);
    const auto shown = [&](float value) {
      return curve.logarithmic ? std::log10(std::max(1e-9f, value)) : value;
    };
    std::vector<float> heights;
    for (const auto* values : {&curve.y, &curve.second})
      for (const float value : *values) heights.push_back(shown(value));
    if (curve.bars) heights.push_back(0);  // where they start
    const Span y(heights);
    const auto points_of = [&](const std::vector<float>& values) {
      std::vector<ImVec2> points;
      for (std::size_t k = 0; k < values.size(); ++k)
        points.push_back(
            {from_.x + x.at(curve.x[k]) * (to_.x - from_.x), height_of(y, shown(values[k]))});
      return points;
    };
    draw_marks(curve, x);
    ticks_y(y, curve.logarithmic);
    ticks_x(x, curve.whole);
    const auto points = points_of(curve.y);
    if (curve.bars)
      draw_bars(points, height_of(y, 0));
    else
      draw_line(points, curve, ink());
    if (!curve.second.empty()) draw_line(points_of(curve.second), curve, pale());
    for (const std::size_t k : curve.unstable)
      list_.AddCircleFilled(points[k], panel_.px(2.5), text_colours(panel_.viewer.show.dark).error);
    show_nearest(curve, points);
  }

 private:
  float height_of(const Span& y, float value) const {
    return to_.y - std::clamp(y.at(value), 0.f, 1.f) * (to_.y - from_.y);
  }
  ImU32 pale() const { return text_colours(panel_.viewer.show.dark).muted; }
  static ImU32 grid() { return ImGui::GetColorU32(ImGuiCol_Border, 0.6f); }
  static ImU32 ink() { return ImGui::GetColorU32(ImGuiCol_PlotLines); }

  void title(const std::string& text) {
    list_.AddText({from_.x - panel_.px(58), from_.y - 1.3f * line_},
                  ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  }
  void say_none(const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    list_.AddText({0.5f * (from_.x + to_.x - size.x), 0.5f * (from_.y + to_.y - size.y)}, pale(),
                  text);
  }
  void draw_bars(const std::vector<ImVec2>& points, float zero) {
    const float half = 0.35f * (to_.x - from_.x) / float(points.size());
    for (const ImVec2& p : points)
      if (std::isfinite(p.y))
        list_.AddRectFilled({p.x - half, std::min(p.y, zero)}, {p.x + half, std::max(p.y, zero)},
                            ink());
    list_.AddLine({from_.x, zero}, {to_.x, zero}, pale());
  }
  void draw_line(const std::vector<ImVec2>& points, const Curve& curve, ImU32 colour) {
    std::vector<std::size_t> ends = curve.jumps;
    ends.push_back(points.size());
    std::size_t from = 0;
    for (const std::size_t end : ends) {
      const ImU32 shade = std::ranges::binary_search(curve.coarse, from) ? pale() : colour;
      draw_known(points, from, end, shade);
      from = end;
    }
    list_.AddCircleFilled(points.back(), panel_.px(3), colour);
  }
  /// Draws a line through the points from `from` to before `end`, with gaps at unknown ones.
  void draw_known(const std::vector<ImVec2>& points, std::size_t from, std::size_t end,
                  ImU32 shade) {
    const auto known = [&](std::size_t k) {
      return std::isfinite(points[k].x) && std::isfinite(points[k].y);
    };
    while (from < end) {
      while (from < end && !known(from)) ++from;
      std::size_t to = from;
      while (to < end && known(to)) ++to;
      // one by one: a polyline becomes thin at a sharp corner
      for (std::size_t k = from; k + 1 < to; ++k)
        list_.AddLine(points[k], points[k + 1], shade, panel_.px(1.4));
      if (to == from + 1) list_.AddCircleFilled(points[from], panel_.px(2), shade);
      from = to;
    }
  }
  /// Draws unstable intervals as bands, and events as lines.
  void draw_marks(const Curve& curve, const Span& x) {
    const TextColours& colours = text_colours(panel_.viewer.show.dark);
    const auto at = [&](float value) {
      return from_.x + std::clamp(x.at(value), 0.f, 1.f) * (to_.x - from_.x);
    };
    for (const CurveMark& mark : curve.marks) {
      if (mark.to < x.low || mark.from > x.high) continue;
      const float low = at(mark.from), high = std::max(at(mark.to), low + panel_.px(1.5));
      const ImU32 colour = mark.unstable ? colours.error : colours.warning;
      list_.AddRectFilled({low, from_.y}, {high, to_.y},
                          mark.unstable ? (colour & 0xffffff) | 0x38000000 : colour);
    }
  }
  /// Draws labels at round values, and lines of a grid at them.
  void ticks_y(const Span& y, bool logarithmic) {
    const int count = std::max(1, int((to_.y - from_.y) / (2.2f * line_)));
    float last = to_.y + line_;  // height of the label below
    const std::vector<render::Tick> ticks =
        logarithmic ? render::log_ticks(std::pow(10., y.low), std::pow(10., y.high), count)
                    : render::linear_ticks(double(y.low), double(y.high), count);
    for (const render::Tick& tick : ticks) {
      if (!tick.major) continue;
      const float at = height_of(y, float(logarithmic ? std::log10(tick.value) : tick.value));
      const std::string text = fmt::format("{:.6g}", tick.value);
      list_.AddLine({from_.x, at}, {to_.x, at}, grid());
      if (last - at < line_) continue;
      last = at;
      list_.AddText(
          {from_.x - ImGui::CalcTextSize(text.c_str()).x - panel_.px(4), at - 0.5f * line_}, pale(),
          text.c_str());
    }
  }
  void ticks_x(const Span& x, bool whole) {
    const float y = to_.y + panel_.px(2);
    const int count = std::max(1, int((to_.x - from_.x) / (3.2f * line_)));
    float last = from_.x - panel_.px(6);  // right end of the label before
    for (const render::Tick& tick : render::linear_ticks(double(x.low), double(x.high), count)) {
      if (!tick.major || (whole && tick.value != std::round(tick.value))) continue;
      const float at = from_.x + x.at(float(tick.value)) * (to_.x - from_.x);
      const std::string text = fmt::format("{:.6g}", tick.value);
      const float wide = ImGui::CalcTextSize(text.c_str()).x;
      list_.AddLine({at, from_.y}, {at, to_.y}, grid());
      // within the plot
      const float left = std::clamp(at - 0.5f * wide, from_.x, to_.x - wide);
      if (left < last + panel_.px(6)) continue;
      last = left + wide;
      list_.AddText({left, y}, pale(), text.c_str());
    }
  }
  /// Shows the values of the known point nearest to the mouse.
  void show_nearest(const Curve& curve, const std::vector<ImVec2>& points) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool menu = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (menu || !ImGui::IsMouseHoveringRect(from_, to_) || ImGui::IsAnyMouseDown()) return;
    const auto next = std::ranges::min_element(points, {}, [&](const ImVec2& p) {
      return std::isfinite(p.x + p.y) ? std::abs(p.x - mouse.x) : INFINITY;
    });
    if (!std::isfinite(next->x + next->y)) return;
    const auto k = std::size_t(next - points.begin());
    list_.AddCircle(*next, panel_.px(4), ImGui::GetColorU32(ImGuiCol_Text), 0, panel_.px(1.4));
    std::string reported =
        fmt::format("{} {:.5g}\n{} {:.5g}", curve.x_label, curve.x[k], curve.y_label, curve.y[k]);
    if (!curve.second.empty()) reported += fmt::format(", {:.5g}", curve.second[k]);
    if (std::ranges::binary_search(curve.coarse, k)) reported += "\non the coarse mesh of a drag";
    const float over = curve.x[k];
    for (const CurveMark& mark : curve.marks)
      if (mark.from <= over && over <= mark.to) reported += "\n" + mark.what;
    ImGui::SetTooltip("%s", reported.c_str());
  }

  const Panel& panel_;
  ImDrawList& list_;
  float line_;
  ImVec2 from_, to_;
};

constexpr double jump = 0.2;  // progress between two equilibria that no line connects

/// Abscissa of the curves if none was chosen: the depth of the last push, else the motion of the
/// boundary, else, if it does not move, the number of the equilibrium.
int abscissa_of(const ViewerState& viewer, std::span<const PlotPoint> points) {
  if (points.empty() || points.back().joint >= 0) return quantity_called("depth_mm");
  const bool moved = std::ranges::any_of(points, [&](const PlotPoint& point) {
    return std::abs(point.progress - points.front().progress) > 1e-9;
  });
  if (!moved) return quantity_called("equilibrium");
  return quantity_called(
      std::isfinite(viewer.shell->frame.boundary_radius_mm) ? "boundary_radius_mm" : "progress");
}

/// Points since the constraint of the pushed joint was set.
std::span<const PlotPoint> last_points(const ViewerState& viewer) {
  std::span<const PlotPoint> all = viewer.plot_points;
  std::size_t since = all.size();
  while (since > 0 && all[since - 1].joint == all.back().joint) --since;
  return all.subspan(since);
}

/// Adds the marks of the paths to a curve over the position on the path.
void put_marks(const ShellView& shell, const Quantity& over, Curve& curve) {
  const std::string_view name = over.name;
  const int pushed = shell.constrained.empty() ? -1 : shell.constrained.back().joint;
  for (const PathMark& mark : shell.marks) {
    double from = mark.from, to = mark.to;
    if (mark.joint < 0 && name == "boundary_radius_mm")
      from = shell.radius_at(mark.to), to = shell.radius_at(mark.from);
    else if (mark.joint < 0 ? name != "progress" : name != "depth_mm" || mark.joint != pushed)
      continue;
    if (from > to) std::swap(from, to);
    curve.marks.push_back({float(from), float(to), mark.unstable, mark.what});
  }
}

Curve curve_of(const ViewerState& viewer, const PlotAxes& axes) {
  const std::span<const PlotPoint> points = last_points(viewer);
  const int x = axes.x >= 0 ? axes.x : abscissa_of(viewer, points);
  const Quantity &over = quantities[std::size_t(x)], &shown = quantities[std::size_t(axes.y)];
  Curve curve{shown.label, over.label, "nothing was done yet", {}, {}};
  curve.whole = x == quantity_called("equilibrium");
  if (&shown == &quantities[std::size_t(quantity_called("force_N"))] &&
      (points.empty() || points.back().joint < 0))
    return curve.without = "no joint is fixed", curve;
  for (std::size_t k = 0; k < points.size(); ++k) {
    // no line between states of their own, where the boundary jumped, or to the coarse mesh of a
    // drag, which has other values
    const auto apart = [&](const PlotPoint& a, const PlotPoint& b) {
      return curve.whole || a.coarse != b.coarse ||
             (b.joint < 0 && std::abs(b.progress - a.progress) > jump);
    };
    if (k > 0 && apart(points[k - 1], points[k])) curve.jumps.push_back(k);
    if (points[k].coarse) curve.coarse.push_back(curve.x.size());
    if (!points[k].stable) curve.unstable.push_back(curve.x.size());
    curve.x.push_back(float(points[k].*over.value));
    curve.y.push_back(float(points[k].*shown.value));
  }
  put_marks(*viewer.shell, over, curve);
  return curve;
}

Curve bins_of(const ShellView& shell) {
  Curve curve{"mean K□ of cells (rad)", "x/L", "no cells", {}, {}, true};
  const auto& bins = shell.frame.K_bins;
  if (!shell.any() || !bins.leftCols(1).array().isFinite().any()) return curve;
  for (Eigen::Index k = 0; k < bins.rows(); ++k) {  // a bin without cells is unknown
    curve.x.push_back(-1 + (2 * float(k) + 1) / float(bins.rows()));
    curve.y.push_back(float(bins(k, 0)));
  }
  return curve;
}

PlottedCurve plotted(const Curve& curve) {
  return {curve.x_label,
          curve.y_label,
          {curve.x.begin(), curve.x.end()},
          {curve.y.begin(), curve.y.end()}};
}

/// The menu of a plot: other quantities, and saving the plot.
void plot_menu(const Panel& panel, PlotAxes& axes, const Curve& curve, const std::string& name) {
  if (!ImGui::BeginPopupContextItem(name.c_str())) return;
  const auto choose_quantity = [](const char* label, int& chosen) {
    if (!ImGui::BeginMenu(label)) return;
    for (int k = 0; k < int(std::size(quantities)); ++k)
      if (ImGui::MenuItem(quantities[std::size_t(k)].label, nullptr, chosen == k)) chosen = k;
    ImGui::EndMenu();
  };
  choose_quantity("Show", axes.y);
  choose_quantity("Over", axes.x);
  if (ImGui::MenuItem("Save as PDF, SVG, PNG and CSV", nullptr, false, !curve.x.empty()))
    panel.viewer.save_plot(plotted(curve));
  panel.named(name + " save", "");
  ImGui::EndPopup();
}

}  // namespace

void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve) {
  PlotBox(panel, low, high).draw(curve);
}

// The panel of plots: three curves of the states so far, and K□ in bins.

void ViewerState::save_plots() {
  for (const PlotAxes& axes : plot_axes)
    if (const Curve curve = curve_of(*this, axes); !curve.x.empty()) save_plot(plotted(curve));
}

void plots_panel(const Panel& panel, const render::Box& box) {
  begin_fixed("plots", box);
  heading(panel, "Plots");
  ViewerState& viewer = panel.viewer;
  const ImVec2 low = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
  const std::size_t count = viewer.plot_axes.size() + 1;
  const float height = space.y / float(count);
  for (std::size_t k = 0; k < count; ++k) {
    const ImVec2 corner{low.x, low.y + height * float(k)},
        end{low.x + space.x, corner.y + height - panel.px(4)};
    if (k + 1 == count) {
      draw_curve(panel, corner, end, bins_of(*viewer.shell));
      break;
    }
    const Curve curve = curve_of(viewer, viewer.plot_axes[k]);
    draw_curve(panel, corner, end, curve);
    const std::string name = fmt::format("plot {}", k + 1);
    ImGui::SetCursorScreenPos(corner);
    if (ImGui::InvisibleButton(name.c_str(), {end.x - corner.x, end.y - corner.y}))
      ImGui::OpenPopup(name.c_str());
    panel.controls[name] = {corner.x, corner.y, end.x - corner.x, end.y - corner.y};
    plot_menu(panel, viewer.plot_axes[k], curve, name);
  }
  ImGui::End();
}

}  // namespace gridshell::window
