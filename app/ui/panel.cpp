#include "app/ui/panel.h"

#include <imgui_internal.h>

namespace gridshell::ui {
namespace {

constexpr float tip_after_s = 0.6f;

std::string help_of(const window::Action& action) {
  const std::string key = name_of(action.key);
  return action.help + (key.empty() ? "" : " (" + key + ")");
}

}  // namespace

void Panel::named(const std::string& name, const std::string& tip) const {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  controls[name] = {low.x, low.y, high.x - low.x, high.y - low.y};
  if (tip.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  // not over what a hand is about to use
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const bool rests = imgui.HoveredId == 0 || imgui.HoveredIdTimer > tip_after_s;
  if (!rests || ImGui::IsAnyMouseDown()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(320));
  ImGui::TextUnformatted(tip.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void Panel::button(const char* name) const {
  const window::Action& action = *window::find_action(name);
  if (ImGui::Button(action.label)) action.act(desk);
  named(name, help_of(action));
}

void Panel::button(const char* name, const char* text, bool able) const {
  const window::Action& action = *window::find_action(name);
  ImGui::BeginDisabled(!able);
  if (ImGui::Button(text)) action.act(desk);
  ImGui::EndDisabled();
  named(name, help_of(action));
}

void Panel::tick(const char* name) const {
  const window::Action& action = *window::find_action(name);
  bool on = action.on(desk);
  if (ImGui::Checkbox(action.label, &on)) action.act(desk);
  named(name, help_of(action));
}

void begin_fixed(const char* name, const render::Box& box, ImGuiWindowFlags more, Layer layer) {
  ImGui::SetNextWindowPos({float(box.x), float(box.y)});
  ImGui::SetNextWindowSize({float(box.width), float(box.height)});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   (layer == Layer::fixed ? ImGuiWindowFlags_NoBringToFrontOnFocus : 0) | more);
}

bool is_typed_into() { return ImGui::IsItemActive() && ImGui::GetIO().WantTextInput; }

void heading(const Panel& panel, const char* text) {
  ImGui::Dummy({0, panel.px(2)});
  ImGui::TextDisabled("%s", text);
  ImGui::Separator();
}

}  // namespace gridshell::ui
