#include "app/window/panel.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <imgui_internal.h>
#include <algorithm>
#include <cctype>
#include <sstream>

namespace gridshell::window {
namespace {

constexpr float tip_after_s = 0.6f;

constexpr float text_px = 14.f;
// ranges of characters that the font has: Latin, Greek, arrows, mathematical signs, □ ● ▶
constexpr ImWchar letters[] = {0x20,   0xff,   0x391,  0x3c9,  0x2010, 0x2044, 0x2070, 0x209f,
                               0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

std::string file_of_font(const char* family) {
  const auto free_pattern = [](FcPattern* pattern) { FcPatternDestroy(pattern); };
  using Pattern = std::unique_ptr<FcPattern, decltype(free_pattern)>;
  Pattern requested(FcNameParse(reinterpret_cast<const FcChar8*>(family)), free_pattern);
  FcConfigSubstitute(nullptr, requested.get(), FcMatchPattern);
  FcDefaultSubstitute(requested.get());
  FcResult result = FcResultMatch;
  Pattern found(FcFontMatch(nullptr, requested.get(), &result), free_pattern);
  FcChar8* file = nullptr;
  if (!found || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return "";
  return reinterpret_cast<const char*>(file);
}

ImVec4 rgb(int hex, float alpha = 1) {
  return {float(hex >> 16 & 255) / 255, float(hex >> 8 & 255) / 255, float(hex & 255) / 255, alpha};
}

void row(const std::string& left, const std::string& right) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(left.c_str());
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", right.c_str());
}

bool begin_table(const Panel& panel, const char* name, double left) {
  if (!ImGui::BeginTable(name, 2)) return false;
  ImGui::TableSetupColumn("how", ImGuiTableColumnFlags_WidthFixed, panel.px(left));
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

/// A table of the keys of the actions in some menus; `menus`: their names, separated by blanks.
void keys(const Panel& panel, const std::string& menus) {
  if (!begin_table(panel, menus.c_str(), 104)) return;
  for (const Action& action : actions())
    if (action.key.key && menus.find(action.menu) != std::string::npos)
      row(name_of(action.key), std::string(action.label) + ": " + action.help);
  ImGui::EndTable();
}

/// The help of an action, and why it has no effect now.
std::string tip_of(const std::string& help, const std::string& why_not) {
  return why_not.empty() ? help : help + "\nNot now: " + why_not;
}

/// Begins a panel over the window, with its title and a hint on how to close it.
void begin_sheet(const char* name, const render::Box& box, const char* title, const char* closes) {
  begin_fixed(name, box, 0, Layer::over);
  ImGui::TextUnformatted(title);
  ImGui::SameLine();
  ImGui::TextDisabled("%s", closes);
  ImGui::Separator();
}

}  // namespace

std::string help_of(const Action& action) {
  const std::string key = name_of(action.key);
  return action.help + (key.empty() ? "" : " (" + key + ")");
}

void Panel::named(const std::string& name, const std::string& tip) const {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  controls[name] = {low.x, low.y, high.x - low.x, high.y - low.y};
  if (tip.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  // a tip may cover what the user needs: none while text is typed or a mouse button is down, and
  // over a control only after some time
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (ImGui::GetIO().WantTextInput) return;
  const bool still = imgui.HoveredId == 0 || imgui.HoveredIdTimer > tip_after_s;
  if (!still || ImGui::IsAnyMouseDown()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(320));
  ImGui::TextUnformatted(tip.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void Panel::button(const char* name, const char* text) const {
  const Action& action = *find_action(name);
  const std::string why_not = action.why_not_now(viewer);
  ImGui::BeginDisabled(!why_not.empty());
  if (ImGui::Button(text ? text : action.label)) action.act(viewer);
  ImGui::EndDisabled();
  named(name, tip_of(help_of(action), why_not));
}

void Panel::tick(const char* name) const {
  const Action& action = *find_action(name);
  bool on = action.on(viewer);
  if (ImGui::Checkbox(action.label, &on)) action.perform(viewer);
  named(name, help_of(action));
}

void begin_fixed(const char* name, const render::Box& box, ImGuiWindowFlags more, Layer layer) {
  const bool fixed = layer == Layer::fixed;
  ImGui::SetNextWindowPos({float(box.x), float(box.y)});
  ImGui::SetNextWindowSize({float(box.width), float(box.height)});
  // transparent, since the frame is cleared in this colour, and filling takes as long as text
  if (fixed) ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0, 0, 0, 0));
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   (fixed ? ImGuiWindowFlags_NoBringToFrontOnFocus : 0) | more);
  if (fixed) ImGui::PopStyleColor();
}

bool is_typed_into() { return ImGui::IsItemActive() && ImGui::GetIO().WantTextInput; }

std::optional<std::size_t> choose(const std::string& id, const std::string& shown,
                                  const std::vector<std::string>& texts) {
  std::optional<std::size_t> chosen;
  if (!ImGui::BeginCombo(id.c_str(), shown.c_str())) return chosen;
  for (std::size_t k = 0; k < texts.size(); ++k)
    if (ImGui::Selectable(texts[k].c_str(), texts[k] == shown)) chosen = k;
  ImGui::EndCombo();
  return chosen;
}

std::string help_of(const preset::Field& field) {
  return fmt::format("{}{}; {}", field.meaning, field.unit.empty() ? "" : ", in " + field.unit,
                     allowed(field));
}

std::string label_of(const preset::Field& field) {
  if (!field.label.empty()) return field.label;
  std::string label = preset::without_unit(field.key, field.unit);
  std::ranges::replace(label, '_', ' ');
  return label;
}

bool contains_words(std::string text, std::string sought) {
  const auto lower = [](std::string& s) {
    std::ranges::transform(s, s.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  };
  lower(text), lower(sought);
  std::istringstream words(sought);
  for (std::string word; words >> word;)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

bool text_input(const char* id, std::string& text, const char* hint, int flags) {
  constexpr std::size_t room = 1024;  // bytes that can be typed
  std::vector<char> typed(text.size() + room);
  std::ranges::copy(text, typed.begin());
  const bool entered = ImGui::InputTextWithHint(id, hint, typed.data(), typed.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue | flags);
  text = typed.data();
  return entered;
}

bool is_popup_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void label(const Panel& panel, const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(panel.px(138));
  ImGui::SetNextItemWidth(-1);
}

void number(const Panel& panel, const char* text, const std::string& name, const std::string& tip,
            double& value, float step, float low, float high, const char* format) {
  float shown = float(value);
  label(panel, text);
  if (ImGui::DragFloat(("##" + name).c_str(), &shown, step, low, high, format,
                       ImGuiSliderFlags_AlwaysClamp))
    value = std::stod(fmt::format("{:.7g}", shown));
  panel.named(name, tip);
}

void heading(const Panel& panel, const char* text) {
  ImGui::Dummy({0, panel.px(2)});
  ImGui::TextDisabled("%s", text);
  ImGui::Separator();
}

Result<void> load_fonts(double density) {
  static const std::string file = file_of_font("DejaVu Sans");
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontConfig config;
  config.OversampleH = 1;
  config.PixelSnapH = true;
  const float size = float(std::round(text_px * density));
  if (file.empty() || !atlas.AddFontFromFileTTF(file.c_str(), size, &config, letters))
    return fail(Fault::io, "no font for the window: install fonts-dejavu-core");
  atlas.Build();
  return {};
}

void choose_colours(bool dark, double density) {
  ImGuiStyle style;
  if (dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  style.WindowRounding = 0;
  // textured lines need a texture with linear filtering, and that of the letters has none
  style.AntiAliasedLinesUseTex = false;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.PopupRounding = 3;
  style.WindowBorderSize = style.FrameBorderSize = 1;
  style.WindowPadding = {10, 8};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {7, 5};
  style.ScrollbarSize = 11;
  style.ScaleAllSizes(float(density));
  auto& colours = style.Colors;
  colours[ImGuiCol_WindowBg] = dark ? rgb(0x24262b) : rgb(0xf4f5f7);
  colours[ImGuiCol_PopupBg] = dark ? rgb(0x2b2e34) : rgb(0xffffff);
  colours[ImGuiCol_MenuBarBg] = dark ? rgb(0x2b2e34) : rgb(0xe9ebef);
  colours[ImGuiCol_Border] = dark ? rgb(0x3a3e46) : rgb(0xd5d8de);
  colours[ImGuiCol_Text] = dark ? rgb(0xe6e8ec) : rgb(0x1b1d22);
  colours[ImGuiCol_TextDisabled] = dark ? rgb(0x8b919c) : rgb(0x6b7280);
  colours[ImGuiCol_FrameBg] = dark ? rgb(0x33373f) : rgb(0xffffff);
  colours[ImGuiCol_FrameBgHovered] = dark ? rgb(0x3d424c) : rgb(0xe6eefb);
  colours[ImGuiCol_FrameBgActive] = dark ? rgb(0x464c58) : rgb(0xd6e4fa);
  colours[ImGuiCol_Button] = dark ? rgb(0x3a404b) : rgb(0xdfe4ec);
  colours[ImGuiCol_ButtonHovered] = dark ? rgb(0x4a5362) : rgb(0xcbd8ee);
  colours[ImGuiCol_ButtonActive] = dark ? rgb(0x57627a) : rgb(0xb3c8ec);
  colours[ImGuiCol_Header] = dark ? rgb(0x3a404b) : rgb(0xdfe4ec);
  colours[ImGuiCol_HeaderHovered] = dark ? rgb(0x4a5362) : rgb(0xcbd8ee);
  colours[ImGuiCol_HeaderActive] = dark ? rgb(0x57627a) : rgb(0xb3c8ec);
  colours[ImGuiCol_NavHighlight] = colours[ImGuiCol_CheckMark] = colours[ImGuiCol_PlotLines] =
      dark ? rgb(0x6ea2f5) : rgb(0x2f6bd0);
  // pale, since the number of a slider is drawn over its grab
  colours[ImGuiCol_SliderGrab] = dark ? rgb(0x4a6ba6) : rgb(0xa9c6f5);
  colours[ImGuiCol_SliderGrabActive] = dark ? rgb(0x5b80c4) : rgb(0x86aef0);
  ImGui::GetStyle() = style;
}

const TextColours& text_colours(bool dark) {
  static constexpr TextColours on_dark{IM_COL32(255, 120, 110, 255), IM_COL32(110, 210, 130, 255),
                                       IM_COL32(240, 185, 80, 255), IM_COL32(139, 145, 156, 255)};
  static constexpr TextColours on_light{IM_COL32(186, 28, 20, 255), IM_COL32(24, 122, 52, 255),
                                        IM_COL32(168, 98, 0, 255), IM_COL32(107, 114, 128, 255)};
  return dark ? on_dark : on_light;
}

void coloured_text(ImU32 colour, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

// The menus, filled from the table of actions.

void menu_bar(const Panel& panel) {
  if (!ImGui::BeginMainMenuBar()) return;
  const char* open_menu = nullptr;
  bool open = false;
  for (const Action& action : actions()) {
    if (!open_menu || std::string(open_menu) != action.menu) {
      if (open) ImGui::EndMenu();
      open_menu = action.menu;
      if (panel.viewer.menu_to_open == action.menu) ImGui::OpenPopup(action.menu);
      open = ImGui::BeginMenu(action.menu);
      if (!open) panel.named(std::string("menu ") + action.menu, "");
    }
    if (!open) continue;
    const bool ticked = action.on && action.on(panel.viewer);
    const std::string why_not = action.why_not_now(panel.viewer);
    if (action.below_line) ImGui::Separator();
    if (ImGui::MenuItem(action.label, name_of(action.key).c_str(), ticked, why_not.empty()))
      action.act(panel.viewer);
    panel.named(std::string("menu ") + action.menu + " " + action.name,
                tip_of(action.help, why_not));
  }
  if (open) ImGui::EndMenu();
  panel.viewer.menu_to_open.clear();
  ImGui::EndMainMenuBar();
}

void terms_sheet(const Panel& panel, const render::Box& box) {
  begin_sheet("terms", box, "What is this?", "(Esc closes)");
  if (begin_table(panel, "terms", 150)) {
    for (const auto& [term, meaning] : terms()) row(term, meaning);
    ImGui::EndTable();
  }
  ImGui::End();
}

// Every key and mouse action, from the tables that bind them.

void help_sheet(const Panel& panel, const render::Box& box) {
  begin_sheet("help", box, "Keys and mouse", "(F1 or Esc closes)");
  if (ImGui::BeginTable("sheet", panel.viewer.small_window ? 1 : 2)) {
    ImGui::TableNextColumn();
    keys(panel, "File Edit Shell");
    ImGui::TableNextColumn();
    if (begin_table(panel, "mouse", 240)) {
      for (const MouseAction& action : mouse_actions()) row(action.how, action.help);
      row("click on a number", "types it; a drag changes it");
      row("Tab",
          "into the panels by the keyboard; arrows and Tab move on, Space presses, Ctrl+Tab "
          "takes the next panel, Esc leaves them");
      row("Alt + letter, F10", "opens a menu");
      ImGui::EndTable();
    }
    keys(panel, "View Colour Help");
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::window
