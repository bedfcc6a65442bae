// The menus, filled from the table of actions.
#include "app/ui/panel.h"

namespace gridshell::ui {

void menu_bar(const Panel& panel) {
  if (!ImGui::BeginMainMenuBar()) return;
  const char* open_menu = nullptr;
  bool open = false;
  for (const window::Action& action : window::actions()) {
    if (!open_menu || std::string(open_menu) != action.menu) {
      if (open) ImGui::EndMenu();
      open_menu = action.menu;
      open = ImGui::BeginMenu(action.menu);
      if (!open) panel.named(std::string("menu ") + action.menu, "");
    }
    if (!open) continue;
    const bool ticked = action.on && action.on(panel.desk);
    if (ImGui::MenuItem(action.label, name_of(action.key).c_str(), ticked)) action.act(panel.desk);
    panel.named(std::string("menu ") + action.menu + " " + action.name, action.help);
  }
  if (open) ImGui::EndMenu();
  ImGui::EndMainMenuBar();
}

}  // namespace gridshell::ui
