// Every key and mouse action, from the tables that bind them.
#include "app/ui/panel.h"

namespace gridshell::ui {
namespace {

void row(const std::string& left, const std::string& right) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(left.c_str());
  ImGui::TableNextColumn();
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(right.c_str());
  ImGui::PopTextWrapPos();
}

bool begin_table(const Panel& panel, const char* name, double left) {
  if (!ImGui::BeginTable(name, 2)) return false;
  ImGui::TableSetupColumn("how", ImGuiTableColumnFlags_WidthFixed, panel.px(left));
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

/// The keys of some menus.
void keys(const Panel& panel, const std::string& menus) {
  if (!begin_table(panel, menus.c_str(), 62)) return;
  for (const window::Action& action : window::actions())
    if (action.key.key && menus.find(action.menu) != std::string::npos)
      row(name_of(action.key), std::string(action.label) + ": " + action.help);
  ImGui::EndTable();
}

}  // namespace

void help_sheet(const Panel& panel, const render::Box& box) {
  begin_fixed("help", box, 0, Layer::over);
  ImGui::TextUnformatted("Keys and mouse");
  ImGui::SameLine();
  ImGui::TextDisabled("(F1 or Esc closes)");
  ImGui::Separator();
  if (ImGui::BeginTable("sheet", 2)) {
    ImGui::TableNextColumn();
    keys(panel, "File Edit Shell");
    ImGui::TableNextColumn();
    if (begin_table(panel, "mouse", 240)) {
      for (const window::MouseAction& action : window::mouse_actions())
        row(action.how, action.help);
      row("Ctrl + click on a number", "types it");
      ImGui::EndTable();
    }
    keys(panel, "View Colour Help");
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::ui
