#include "app/ui/look.h"

#include <fontconfig/fontconfig.h>

#include <cmath>
#include <memory>
#include <string>

namespace gridshell::ui {
namespace {

constexpr float text_px = 14.f;
// Latin, Greek, arrows, mathematical signs, □ ● ▶
constexpr ImWchar letters[] = {0x20,   0xff,   0x391,  0x3c9,  0x2010, 0x2044, 0x2070, 0x209f,
                               0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

std::string file_of_font(const char* family) {
  const auto free_pattern = [](FcPattern* pattern) { FcPatternDestroy(pattern); };
  using Pattern = std::unique_ptr<FcPattern, decltype(free_pattern)>;
  Pattern wish(FcNameParse(reinterpret_cast<const FcChar8*>(family)), free_pattern);
  FcConfigSubstitute(nullptr, wish.get(), FcMatchPattern);
  FcDefaultSubstitute(wish.get());
  FcResult result = FcResultMatch;
  Pattern found(FcFontMatch(nullptr, wish.get(), &result), free_pattern);
  FcChar8* file = nullptr;
  if (!found || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return "";
  return reinterpret_cast<const char*>(file);
}

ImVec4 rgb(int hex, float alpha = 1) {
  return {float(hex >> 16 & 255) / 255, float(hex >> 8 & 255) / 255, float(hex & 255) / 255, alpha};
}

}  // namespace

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
  // such lines are drawn by a smooth texture, and the letters' is none
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
  colours[ImGuiCol_CheckMark] = colours[ImGuiCol_PlotLines] = dark ? rgb(0x6ea2f5) : rgb(0x2f6bd0);
  // a slider's number stands over its grab
  colours[ImGuiCol_SliderGrab] = dark ? rgb(0x4a6ba6) : rgb(0xa9c6f5);
  colours[ImGuiCol_SliderGrabActive] = dark ? rgb(0x5b80c4) : rgb(0x86aef0);
  ImGui::GetStyle() = style;
}

ImU32 bad_ink(bool dark) {
  return dark ? IM_COL32(255, 120, 110, 255) : IM_COL32(186, 28, 20, 255);
}
ImU32 good_ink(bool dark) {
  return dark ? IM_COL32(110, 210, 130, 255) : IM_COL32(24, 122, 52, 255);
}
ImU32 doubt_ink(bool dark) {
  return dark ? IM_COL32(240, 185, 80, 255) : IM_COL32(168, 98, 0, 255);
}
ImU32 pale_ink(bool dark) {
  return dark ? IM_COL32(139, 145, 156, 255) : IM_COL32(107, 114, 128, 255);
}

}  // namespace gridshell::ui
