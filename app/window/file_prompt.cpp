// The prompts for a preset, with pictures of all, and for a file, with the contents of its folder.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "app/window/imgui_painter.h"
#include "app/window/panel.h"
#include "render/gl/image.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

struct FileText {
  const char *title, *button, *hint;
};
/// The texts of the prompt, in the order of FileUse.
constexpr FileText file_texts[] = {
    {"Open", "Open", "a preset's file (.toml), or the folder of a run"},
    {"Compare with a run or scan", "Compare", "the folder of a run, or of a scan"},
    {"Save preset as", "Save", "a preset; tables of its ends and rods are saved next to it"},
    {"Save picture as", "Save", "a PNG of the view"},
    {"Export", "Export", "a file whose ending is the format"}};

/// Whether a file can be chosen for this purpose.
bool requested(FileUse use, const fs::path& file) {
  if (use == FileUse::open || use == FileUse::save_preset) return file.extension() == ".toml";
  if (use == FileUse::save_picture) return file.extension() == ".png";
  return use == FileUse::export_shell;
}

/// Whether a folder is a run or a scan, which can be chosen; other folders are opened.
bool is_run(const fs::path& folder) {
  std::error_code error;
  return std::ranges::any_of(std::array{"summary.json", "scan.json", "scan.csv"},
                             [&](const char* name) { return fs::exists(folder / name, error); });
}

/// "4.2 MB"
std::string size_text(std::uintmax_t bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB"};
  std::size_t unit = 0;
  double size = double(bytes);
  for (; size >= 1000 && unit < 3; ++unit) size /= 1000;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

std::string date_text(const fs::file_time_type& time) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(
      std::chrono::file_clock::to_sys(time).time_since_epoch());
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time_t(seconds.count())));
}

/// The typed path; a name without a folder is in the folder that is shown.
fs::path path_of(const FileRequest& request) {
  const fs::path path = request.path;
  std::error_code error;
  return path.has_parent_path() || fs::exists(path, error) ? path : request.folder / path;
}

/// The filter for the list of files: the typed name if no such file exists, else empty.
std::string filter_of(const FileRequest& request) {
  std::error_code error;
  if (!is_read(request.use) || fs::exists(path_of(request), error)) return "";
  return fs::path(request.path).filename().string();
}

/// Controls for the size of a picture in print, and that size in pixels.
void picture_size(const Panel& panel, FileRequest& request, const PictureSize& view) {
  auto width = float(request.width_mm), dpi = float(request.dpi);
  ImGui::SetNextItemWidth(panel.px(110));
  if (ImGui::DragFloat("##width", &width, 0.5f, 10, 1000, "%.4g mm wide",
                       ImGuiSliderFlags_AlwaysClamp))
    request.width_mm = double(width);
  panel.named("picture_width_mm", "its width in print; Ctrl+click to type");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(panel.px(110));
  if (ImGui::DragFloat("##dpi", &dpi, 1, 36, 1200, "%.4g dpi", ImGuiSliderFlags_AlwaysClamp))
    request.dpi = double(dpi);
  panel.named("picture_dpi", "dots per inch; Ctrl+click to type");
  const double pixels = request.width_mm / 25.4 * request.dpi;
  ImGui::SameLine();
  ImGui::TextDisabled("%.0f x %.0f pixels", pixels, pixels * view.height / view.width);
}

/// Buttons for the endings of exported files; one that is pressed replaces the ending of the path.
void endings(const Panel& panel, FileRequest& request) {
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  for (const app::ExportFormat& format : panel.viewer.library.export_formats) {
    const std::string text = fmt::format("{}  {}", format.ending, format.read_by);
    const float wide =
        ImGui::CalcTextSize(text.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x + panel.px(8);
    if (ImGui::GetItemRectMax().x + wide < right &&
        &format != &panel.viewer.library.export_formats.front())
      ImGui::SameLine();
    const bool now = fs::path(request.path).extension() == format.ending;
    if (ImGui::RadioButton(text.c_str(), now))
      request.path = fs::path(request.path).replace_extension(format.ending).string();
    panel.named("ending " + format.ending, fmt::format("the {}", format.thing));
  }
}

/// A group of presets, by the beginnings of their names; the last group has all others.
struct CardGroup {
  const char* title;
  std::vector<std::string_view> begins;
};
const CardGroup groups[] = {
    {"Movies of the paper", {"s1_", "s2_", "s3_", "s4_", "s5_"}},
    {"Figures of the paper", {"fig"}},
    {"Pages of the paper", {"page_fig"}},
    {"Designed to meet a surface", {"design_", "ring_"}},
    {"Curves, nets and surfaces of your own", {"curve_", "net_", "surface_"}},
    {"Networks of rods", {"network_"}},
    {"Timber", {"timber_"}},
    {"Literature", {"lit_", "page_literature"}},
    {"Models, limits, loads, steps", {""}}};

constexpr double card_points = 216;             // the least width of a card
constexpr float height_of_width = 160 / 256.f;  // of the pictures in presets/pictures/cards

/// A title; one that is wider than its card ends in dots.
std::string shortened(const std::string& title, float width) {
  if (ImGui::CalcTextSize(title.c_str()).x <= width) return title;
  std::string begin = title;
  const auto too_long = [&] { return ImGui::CalcTextSize((begin + "…").c_str()).x > width; };
  while (!begin.empty() && too_long()) {
    // UTF-8: all bytes of a letter except the first are 10xxxxxx
    while (begin.size() > 1 && (begin.back() & 0xc0) == 0x80) begin.pop_back();
    begin.pop_back();
  }
  return begin + "…";
}

}  // namespace

const char* group_of(const std::string& preset) {
  const auto begins = [&](std::string_view begin) { return preset.starts_with(begin); };
  return std::ranges::find_if(
             groups,
             [&](const CardGroup& group) { return std::ranges::any_of(group.begins, begins); })
      ->title;
}

/// Reads the folder again if another one is shown or if it changed.
void FilePrompt::look(FileUse use, const std::string& folder) {
  std::error_code error;
  const fs::path at = folder.empty() ? "." : folder;
  const auto changed = fs::last_write_time(at, error);
  if (use == use_ && folder == folder_ && changed == changed_) return;
  use_ = use, folder_ = folder, changed_ = changed;
  entries_.clear();
  for (fs::directory_iterator entry(at, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    const bool is_folder = entry->is_directory(gone);
    if (name.starts_with('.') || !(is_folder || requested(use, entry->path()))) continue;
    Entry& one = entries_.emplace_back(name, is_folder);
    one.run = is_folder && is_read(use) && is_run(entry->path());
    if (const auto size = entry->file_size(gone); !is_folder && !gone) one.size = size_text(size);
    if (const auto time = entry->last_write_time(gone); !gone) one.changed = date_text(time);
  }
  std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
    return std::pair(!a.folder, a.name) < std::pair(!b.folder, b.name);
  });
}

/// Buttons for folders that are often used.
void FilePrompt::folder_buttons(const Panel& panel, FileRequest& request) const {
  const char* home = std::getenv("HOME");
  std::error_code error;
  const std::pair<const char*, fs::path> all[] = {{"Home", home ? home : ""},
                                                  {"Working folder", fs::current_path(error)},
                                                  {"Saved files", panel.viewer.library.save_to}};
  for (const auto& [name, folder] : all) {
    if (!fs::is_directory(folder, error)) continue;
    if (ImGui::Button(name))
      request.path =
          (folder / (is_read(request.use) ? "" : fs::path(request.path).filename())).string();
    panel.named(std::string("folder ") + name, folder.string());
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

/// The list of folders and files; a click chooses one. Returns true for a double click on a file
/// or run, which opens it.
bool FilePrompt::list(const Panel& panel, FileRequest& request) {
  const fs::path path = request.path;
  std::error_code error;
  if (path.has_parent_path() && fs::is_directory(path.parent_path(), error))
    request.folder = path.parent_path().string();
  const fs::path folder = request.folder.empty() ? fs::path(".") : fs::path(request.folder);
  look(request.use, request.folder);
  const std::string filter = filter_of(request);
  bool taken = false;
  if (!ImGui::BeginTable("files", 3)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, panel.px(70));
  ImGui::TableSetupColumn("changed", ImGuiTableColumnFlags_WidthFixed, panel.px(120));
  ImGui::TableNextColumn();
  if (ImGui::Selectable("../##up"))
    request.path = (fs::absolute(folder).lexically_normal().parent_path() / "").string();
  panel.named("file ..", "the folder above");
  for (const Entry& entry : entries_) {
    if (!filter.empty() && !contains_words(entry.name, filter)) continue;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const fs::path there = folder / entry.name;
    const std::string label = entry.name + (entry.run ? "   (run)" : entry.folder ? "/" : "");
    if (ImGui::Selectable(
            label.c_str(), path == there,
            ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
      request.path = entry.folder && !entry.run ? (there / "").string() : there.string();
      taken |= ImGui::IsMouseDoubleClicked(0) && (entry.run || !entry.folder);
    }
    panel.named("file " + entry.name, "");
    for (const std::string& text : {entry.size, entry.changed}) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", text.c_str());
    }
  }
  ImGui::EndTable();
  return taken;
}

/// Completes the typed name to that of the first entry that contains it. Returns whether the path
/// can be opened; false if it is a folder, which is shown instead.
bool FilePrompt::complete(FileRequest& request) const {
  if (!is_read(request.use)) return true;
  const std::string filter = filter_of(request);
  const auto first = std::ranges::find_if(
      entries_, [&](const Entry& entry) { return contains_words(entry.name, filter); });
  if (!filter.empty() && first != entries_.end())
    request.path = (fs::path(request.folder) / first->name).string();
  const fs::path path = path_of(request);
  std::error_code error;
  if (!fs::is_directory(path, error) || is_run(path) || !path.has_filename()) return true;
  request.path = (path / "").string();
  return false;
}

void FilePrompt::draw(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  FileRequest request = *viewer.file_request;
  const FileText& text = file_texts[std::size_t(request.use)];
  begin_fixed("file", box, 0, Layer::over);
  heading(panel, text.title);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing() || std::exchange(refocus_, false)) ImGui::SetKeyboardFocusHere();
  bool taken = text_input("##path", request.path, "", ImGuiInputTextFlags_AutoSelectAll);
  panel.named("file_path",
              is_read(request.use)
                  ? "part of a name or a path; Enter opens the first that is shown below"
                  : "path of the file; Enter takes it");
  ImGui::TextDisabled("%s", text.hint);
  folder_buttons(panel, request);
  if (request.use == FileUse::save_picture) picture_size(panel, request, viewer.view);
  if (request.use == FileUse::export_shell) endings(panel, request);
  const float foot = 2.6f * ImGui::GetFrameHeightWithSpacing();
  bool double_click = false;
  if (ImGui::BeginChild("entries", {0, -foot}, true)) double_click = list(panel, request);
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
  if (taken && !complete(*viewer.file_request)) taken = false, refocus_ = true;
  if (taken || double_click) viewer.take_file();
  if (cancelled) viewer.file_request.reset();
}

// The picker of presets.

void PresetPicker::load(const std::vector<PresetCard>& cards) {
  for (std::size_t k = pictures_.size(); k < cards.size(); ++k) {
    auto& picture = pictures_.emplace_back();
    const auto image = render::decode_png(cards[k].picture, cards[k].name);
    if (!image) continue;  // a card without a picture
    picture.emplace(*gl_);
    fill_texture(*gl_, picture->id(), image->width, image->height, image->rgba.data());
  }
}

void PresetPicker::card(const Panel& panel, const PresetCard& card, std::size_t number) {
  const float gap = panel.px(4), line = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorPos();
  const float width = ImGui::GetContentRegionAvail().x, inside = width - 2 * gap,
              high = height_of_width * inside;
  const float height = high + 2.4f * line + 2 * gap;
  ImGui::PushID(card.name.c_str());
  if (ImGui::Selectable("##card", false, 0, {0, height})) panel.viewer.open(card.name);
  panel.named("preset " + card.name, card.title);
  ImGui::SetCursorPos({at.x + gap, at.y + gap});
  if (const auto& picture = pictures_[number])
    ImGui::Image(texture_id(picture->id()), {inside, high});
  ImGui::SetCursorPos({at.x + gap, at.y + high + 1.5f * gap});
  ImGui::TextUnformatted(shortened(card.name, inside).c_str());
  ImGui::SetCursorPos({at.x + gap, at.y + high + 1.5f * gap + 1.15f * line});
  ImGui::TextDisabled("%s", shortened(card.title, inside).c_str());
  ImGui::SetCursorPos({at.x, at.y + height + panel.px(6)});
  ImGui::PopID();
}

void PresetPicker::opened_last(const Panel& panel) const {
  if (panel.viewer.recent.empty() || !sought_.empty()) return;
  heading(panel, "Recent");
  const auto recent = panel.viewer.recent;
  for (const std::string& name : recent) {
    const std::string label = std::filesystem::path(name).filename().string();
    if (ImGui::Button((label + "##" + name).c_str())) panel.viewer.open(name);
    panel.named("recent " + name, name);
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

void PresetPicker::draw(const Panel& panel, const render::Box& box) {
  const std::vector<PresetCard>& cards = panel.viewer.library.cards;
  load(cards);
  begin_fixed("presets", box, 0, Layer::over);
  ImGui::TextUnformatted("Pick a preset");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(panel.px(200));
  text_input("##sought", sought_, "search");
  panel.named("search presets", "words of a name or a title");
  ImGui::SameLine();
  panel.button("open_file");
  ImGui::SameLine();
  ImGui::TextDisabled("(Ctrl+O comes back here; F1 lists keys and mouse)");
  opened_last(panel);
  const float width = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, int(width / panel.px(card_points)));
  if (std::ranges::none_of(cards, [&](const PresetCard& card) {
        return contains_words(card.name + " " + card.title, sought_);
      }))
    ImGui::TextDisabled("no preset has these words");
  for (const CardGroup& group : groups) {
    const auto shown = [&](const PresetCard& card) {
      return group_of(card.name) == group.title &&
             contains_words(card.name + " " + card.title, sought_);
    };
    if (std::ranges::none_of(cards, shown)) continue;
    heading(panel, group.title);
    if (!ImGui::BeginTable(group.title, columns)) continue;
    for (std::size_t k = 0; k < cards.size(); ++k) {
      if (!shown(cards[k])) continue;
      ImGui::TableNextColumn();
      card(panel, cards[k], k);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::window
