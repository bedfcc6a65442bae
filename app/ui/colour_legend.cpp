// What the colours of the view mean, over its right edge.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/ui/panel.h"
#include "render/plot/ticks.h"

namespace gridshell::ui {
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
  const window::Desk& desk = panel.desk;
  if (!desk.sight->any() || desk.show.colour_by == window::ColourBy::none) return;
  const float line = ImGui::GetTextLineHeight(), width = panel.px(14);
  // in a low view the bar leaves room for the notes below it
  const float height = std::min(panel.px(170), std::max(2 * line, float(view.height) - 8 * line));
  const float right = float(view.right()) - panel.px(14), top = float(view.y) + panel.px(14);
  Ground ground(panel, *ImGui::GetWindowDrawList(), {right, top});
  ground.text(window::label_of(*desk.sight, desk.show.colour_by), right, top);
  const window::Values values = window::values_of(*desk.sight, desk.show.colour_by);
  if (!values.any()) return ground.text("not known for this shell", right, top + 1.3f * line);
  const render::ColourScale& scale = desk.show.scale;
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
  const Eigen::VectorXd& all = values.of_cells.size() > 0 ? values.of_cells : values.of_nodes;
  const double slack = 1e-9 * (scale.high - scale.low);
  float note = low + height + 0.8f * line;
  if (all.maxCoeff() > scale.high + slack) {
    ground.text(fmt::format("up to {:.3g}", all.maxCoeff()), right, note);
    note += 1.2f * line;
  }
  if (all.minCoeff() < scale.low - slack)
    ground.text(fmt::format("down to {:.3g}", all.minCoeff()), right, note);
}

}  // namespace gridshell::ui
