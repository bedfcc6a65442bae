// What the colours of the view mean, over its right edge.
#include <fmt/format.h>

#include "app/ui/panel.h"
#include "render/plot/ticks.h"

namespace gridshell::ui {

void colour_legend(const Panel& panel, const render::Box& view) {
  const window::Desk& desk = panel.desk;
  if (!desk.sight->any() || desk.show.colour_by == window::ColourBy::none) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const char* label = window::label_of(*desk.sight, desk.show.colour_by);
  const float line = ImGui::GetTextLineHeight(), width = panel.px(14), height = panel.px(170);
  const float right = float(view.right()) - panel.px(14), top = float(view.y) + panel.px(14);
  list.AddText({right - ImGui::CalcTextSize(label).x, top}, ink, label);
  const window::Values values = window::values_of(*desk.sight, desk.show.colour_by);
  if (!values.any()) {
    const char* none = "not known for this shell";
    list.AddText({right - ImGui::CalcTextSize(none).x, top + 1.3f * line}, ink, none);
    return;
  }
  const render::ColourScale& scale = desk.show.scale;
  const float low = top + 1.6f * line, left = right - width;
  constexpr int steps = 64;
  for (int k = 0; k < steps; ++k) {
    const render::Colour c = scale(scale.high - (scale.high - scale.low) * (k + 0.5) / steps);
    const auto byte = [](float v) { return int(255 * v + 0.5f); };
    list.AddRectFilled({left, low + height * float(k) / steps},
                       {right, low + height * float(k + 1) / steps},
                       IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255));
  }
  list.AddRect({left, low}, {right, low + height}, ImGui::GetColorU32(ImGuiCol_TextDisabled));
  // the end colours stand for all that lies beyond them
  const Eigen::VectorXd& all = values.of_cells.size() > 0 ? values.of_cells : values.of_nodes;
  const auto note = [&](const std::string& text, float y) {
    list.AddText({right - ImGui::CalcTextSize(text.c_str()).x, y}, ink, text.c_str());
  };
  const double slack = 1e-9 * (scale.high - scale.low);
  if (all.maxCoeff() > scale.high + slack)
    note(fmt::format("up to {:.3g}", all.maxCoeff()), low + height + 0.8f * line);
  if (all.minCoeff() < scale.low - slack)
    note(fmt::format("down to {:.3g}", all.minCoeff()), low + height + 2.f * line);
  for (const render::Tick& tick : render::linear_ticks(scale.low, scale.high, 4)) {
    if (!tick.major) continue;
    const std::string text = fmt::format("{:.6g}", tick.value);
    const auto down = float((scale.high - tick.value) / (scale.high - scale.low));
    list.AddText({left - ImGui::CalcTextSize(text.c_str()).x - panel.px(5),
                  low + height * down - 0.5f * line},
                 ink, text.c_str());
  }
}

}  // namespace gridshell::ui
