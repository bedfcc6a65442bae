// All presets to choose from.
#include <algorithm>
#include <cmath>

#include "app/ui/panel.h"

namespace gridshell::ui {

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
      const ImVec2 low = ImGui::GetCursorScreenPos();
      // a long title ends at the card's edge
      ImGui::PushClipRect(low, {low.x + ImGui::GetColumnWidth() - panel.px(10), low.y + height},
                          true);
      ImGui::TextDisabled("%s", card.title.c_str());
      ImGui::PopClipRect();
      ImGui::SetCursorPos({at.x, at.y + height + panel.px(6)});
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::ui
