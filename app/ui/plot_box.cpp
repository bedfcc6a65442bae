#include "app/ui/plot_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/ui/look.h"

namespace gridshell::ui {
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
  template <class Shown>
  void label_y(const Span& y, const Curve& curve, const Shown& shown) {
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

}  // namespace gridshell::ui
