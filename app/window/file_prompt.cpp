// Asks for a file: its path, what lies in its folder, and what is to be known of it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/window/panel.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

struct FileText {
  const char *title, *button, *hint;
};
/// In the order of the enum.
constexpr FileText file_texts[] = {
    {"Open", "Open", "a preset's file (.toml), or the folder of a run"},
    {"Compare with a run", "Compare", "the folder of a run"},
    {"Save preset as", "Save", "a preset; tables of its ends and rods come beside it"},
    {"Save picture as", "Save", "a PNG of the view"},
    {"Export", "Export",
     ".vtp .pvd (ParaView), .obj .dxf (Rhino, Blender), .glb .html (any browser), .csv;\nof the flat "
     "footprint .svg, of the workshop .pdf"}};

/// What of a folder can be picked: folders, and files that the use is for.
struct Entry {
  std::string name;
  bool folder = false;
};

bool wanted(FileUse use, const fs::path& file) {
  if (use == FileUse::open || use == FileUse::save_preset) return file.extension() == ".toml";
  if (use == FileUse::save_picture) return file.extension() == ".png";
  return use == FileUse::export_shell;
}

std::vector<Entry> entries_of(FileUse use, const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const bool is_folder = at->is_directory(error);
    if (!name.starts_with('.') && (is_folder || wanted(use, at->path())))
      entries.push_back({name, is_folder});
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::pair(!a.folder, a.name) < std::pair(!b.folder, b.name);
  });
  return entries;
}

/// A run's folder is picked, others are gone into.
bool is_run(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "summary.json", error);
}

void list(const Panel& panel, FileRequest& request) {
  const fs::path path = request.path;
  std::error_code error;
  if (path.has_parent_path() && fs::is_directory(path.parent_path(), error))
    request.folder = path.parent_path().string();
  const fs::path folder = request.folder.empty() ? fs::path(".") : fs::path(request.folder);
  if (ImGui::Selectable("../##up"))
    request.path = (fs::absolute(folder).lexically_normal().parent_path() / "").string();
  panel.named("file ..", "the folder above");
  for (const Entry& entry : entries_of(request.use, folder)) {
    const fs::path there = folder / entry.name;
    const bool loads = request.use == FileUse::open || request.use == FileUse::compare;
    const bool run = entry.folder && loads && is_run(there);
    const std::string label =
        fmt::format("{}{}", entry.name, run ? "   (run)" : entry.folder ? "/" : "");
    if (ImGui::Selectable(label.c_str(), path == there))
      request.path = entry.folder && !run ? (there / "").string() : there.string();
    panel.named("file " + entry.name, "");
  }
}

/// Its size in print, and what that is in pixels.
void picture_size(const Panel& panel, FileRequest& request, const PictureSize& view) {
  auto width = float(request.width_mm), dpi = float(request.dpi);
  ImGui::SetNextItemWidth(panel.px(110));
  if (ImGui::DragFloat("##width", &width, 0.5f, 10, 1000, "%.4g mm wide",
                       ImGuiSliderFlags_AlwaysClamp))
    request.width_mm = double(width);
  panel.named("picture_width_mm", "its width in print; Ctrl+click to type");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(panel.px(110));
  if (ImGui::DragFloat("##dpi", &dpi, 1, 36, 1200, "%.4g dpi", ImGuiSliderFlags_AlwaysClamp)) request.dpi = double(dpi);
  panel.named("picture_dpi", "dots per inch; Ctrl+click to type");
  const double pixels = request.width_mm / 25.4 * request.dpi;
  ImGui::SameLine();
  ImGui::TextDisabled("%.0f x %.0f pixels", pixels, pixels * view.height / view.width);
}

}  // namespace

void file_prompt(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  FileRequest request = *viewer.file_request;
  const FileText& text = file_texts[std::size_t(request.use)];
  begin_fixed("file", box, 0, Layer::over);
  heading(panel, text.title);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  bool taken = text_input("##path", request.path);
  panel.named("file_path", "path of the file; Enter takes it");
  ImGui::TextDisabled("%s", text.hint);
  if (request.use == FileUse::save_picture) picture_size(panel, request, viewer.view);
  const float foot = 2.6f * ImGui::GetFrameHeightWithSpacing();
  if (ImGui::BeginChild("entries", {0, -foot}, true)) list(panel, request);
  ImGui::EndChild();
  coloured_text(text_colours(viewer.show.dark).error, viewer.message_bad ? viewer.message : "");
  const bool replaces = !request.replaced.empty() && request.replaced == request.path;
  taken |= ImGui::Button(replaces ? "Replace" : text.button);
  panel.named("file_take", text.title);
  ImGui::SameLine();
  const bool cancelled = ImGui::Button("Cancel");
  panel.named("file_cancel", "Esc");
  ImGui::End();
  viewer.file_request = request;
  if (taken) viewer.take_file();
  if (cancelled) viewer.file_request.reset();
}

}  // namespace gridshell::window
