// All presets to choose from.
#include <algorithm>
#include <cmath>

#include "app/ui/panel.h"

namespace gridshell::ui {
namespace {

/// A title that is too long for its card ends in dots.
std::string shortened(const std::string& title, float width) {
  if (ImGui::CalcTextSize(title.c_str()).x <= width) return title;
  std::string begin = title;
  const auto too_long = [&] { return ImGui::CalcTextSize((begin + "…").c_str()).x > width; };
  while (!begin.empty() && too_long()) begin.pop_back();
  return begin + "…";
}

}  // namespace

void preset_picker(const Panel& panel, const render::Box& box) {
  begin_fixed("presets", box, 0, Layer::over);
  ImGui::TextUnformatted("Pick a preset");
  ImGui::SameLine();
  ImGui::TextDisabled("(Ctrl+O comes back here; F1 lists keys and mouse)");
  ImGui::Separator();
  const float width = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, int(width / panel.px(300)));
  if (ImGui::BeginTable("cards", columns)) {
    for (const window::PresetCard& card : panel.desk.library.cards) {
      ImGui::TableNextColumn();
      ImGui::PushID(card.name.c_str());
      const ImVec2 at = ImGui::GetCursorPos();
      const float height = 2.6f * ImGui::GetTextLineHeight();
      if (ImGui::Selectable("##card", false, 0, {0, height})) panel.desk.open(card.name);
      panel.named("preset " + card.name, card.title);
      ImGui::SetCursorPos({at.x + panel.px(4), at.y + panel.px(1)});
      ImGui::TextUnformatted(card.name.c_str());
      ImGui::SetCursorPos(
          {at.x + panel.px(4), at.y + panel.px(1) + 1.2f * ImGui::GetTextLineHeight()});
      ImGui::TextDisabled("%s",
                          shortened(card.title, ImGui::GetColumnWidth() - panel.px(10)).c_str());
      ImGui::SetCursorPos({at.x, at.y + height + panel.px(6)});
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::ui
