#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
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
        low_x_(low.x),
        from_{low.x + panel.px(58), low.y + 1.3f * line_},
        to_{high.x, high.y - 1.3f * line_} {}

  void draw(const Curve& curve) {
    title(curve.x.empty() ? curve.y_label
                          : fmt::format("{} over {}", curve.y_label, curve.x_label));
    if (curve.x.empty()) return draw_frame(), say_none(curve.without);
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
    const std::vector<LabelY> labels = labels_y(y, curve.logarithmic);
    for (const LabelY& label : labels) from_.x = std::max(from_.x, low_x_ + label.width);
    draw_frame();
    draw_marks(curve, x);
    ticks_y(y, labels);
    ticks_x(x, curve.whole);
    const auto points = points_of(curve.y);
    if (curve.bars)
      draw_bars(points, height_of(y, 0));
    else
      draw_line(points, curve, curve.y, ink());
    if (!curve.second.empty()) draw_line(points_of(curve.second), curve, curve.second, pale());
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
    list_.AddText({low_x_, from_.y - 1.3f * line_}, ImGui::GetColorU32(ImGuiCol_Text),
                  text.c_str());
  }
  void draw_frame() {
    list_.AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg));
    list_.AddRect(from_, to_, ImGui::GetColorU32(ImGuiCol_Border));
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
  /// Draws the pieces of a curve with the ordinates `y`, which are at `points`.
  void draw_line(const std::vector<ImVec2>& points, const Curve& curve, const std::vector<float>& y,
                 ImU32 colour) {
    for (const CurvePiece& piece : pieces_of(curve, y)) {
      const ImU32 shade = piece.coarse ? pale() : colour;
      // one by one: a polyline becomes thin at a sharp corner
      for (std::size_t k = piece.from; k + 1 < piece.end; ++k)
        list_.AddLine(points[k], points[k + 1], shade, panel_.px(1.4));
      if (piece.is_point()) list_.AddCircleFilled(points[piece.from], panel_.px(2), shade);
    }
    list_.AddCircleFilled(points.back(), panel_.px(3), colour);
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
  /// A label of the axis y.
  struct LabelY {
    float y;  ///< as it is drawn: the logarithm on a logarithmic axis
    std::string text;
    float width;  ///< with the gap to the frame, pixels
  };
  std::vector<LabelY> labels_y(const Span& y, bool logarithmic) const {
    const int count = std::max(1, int((to_.y - from_.y) / (2.2f * line_)));
    const std::vector<render::Tick> ticks =
        logarithmic ? render::log_ticks(std::pow(10., y.low), std::pow(10., y.high), count)
                    : render::linear_ticks(double(y.low), double(y.high), count);
    std::vector<LabelY> labels;
    for (const render::Tick& tick : ticks) {
      if (!tick.major) continue;
      std::string text = fmt::format("{:.6g}", tick.value);
      const float width = ImGui::CalcTextSize(text.c_str()).x + panel_.px(4);
      labels.push_back(
          {float(logarithmic ? std::log10(tick.value) : tick.value), std::move(text), width});
    }
    return labels;
  }
  /// Draws labels at round values, and lines of a grid at them.
  void ticks_y(const Span& y, const std::vector<LabelY>& labels) {
    float last = to_.y + line_;  // height of the label below
    for (const LabelY& label : labels) {
      const float at = height_of(y, label.y);
      list_.AddLine({from_.x, at}, {to_.x, at}, grid());
      if (last - at < line_) continue;
      last = at;
      list_.AddText({from_.x - label.width, at - 0.5f * line_}, pale(), label.text.c_str());
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
  float line_, low_x_;  // height of a line of text; the left edge of title and labels
  ImVec2 from_, to_;    // corners of the frame
};

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
    panel.viewer.save_plots({curve});
  panel.named(name + " save", "");
  ImGui::EndPopup();
}

}  // namespace

void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve) {
  PlotBox(panel, low, high).draw(curve);
}

// The panel of plots: three curves of the states so far, and K□ in bins.

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
