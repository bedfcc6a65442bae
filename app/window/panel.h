// The panels of the interface, and what they have in common: named controls, tooltips, small plots.
#pragma once

#include <imgui.h>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/window/actions.h"
#include "app/window/new_shell.h"
#include "app/window/plot_curve.h"
#include "engine/gridshell.h"
#include "render/canvas/canvas.h"
#include "render/gl/opengl.h"

namespace gridshell::window {

/// What the panels of one frame read and write.
struct Panel {
  ViewerState& viewer;
  double density = 1;                            ///< pixels a point of text
  std::map<std::string, render::Box>& controls;  ///< position of each control, by its name
  std::vector<ImTextureID> states = {};          ///< a picture for each of viewer.shell->found

  float px(double points) const { return float(points * density); }
  /// Stores the position of the last control under a name, and gives it a tooltip.
  void named(const std::string& name, const std::string& tip) const;
  /// A button or a tick of an action, with its help and key. A button may have another text if the
  /// panel names the action, and is pale if it has no effect now.
  void button(const char* action, const char* text = nullptr) const;
  void tick(const char* action) const;
};

/// Opens a window of fixed position without a title; ImGui::End() closes it. Fixed windows are
/// behind those of the layer `over`.
enum class Layer { fixed, over };
void begin_fixed(const char* name, const render::Box& box, ImGuiWindowFlags more = 0,
                 Layer layer = Layer::fixed);

/// Whether the user is typing into the last control: its value is not complete yet.
bool is_typed_into();

/// A drop-down list; returns the index of the chosen text, if one was chosen.
std::optional<std::size_t> choose(const std::string& id, const std::string& shown,
                                  const std::vector<std::string>& texts);

/// A drop-down list of all names of an enum.
template <class Enum>
void choose_word(const std::string& id, Enum& value) {
  if (const auto k = choose(id, std::string(word_of(value)), all_words<Enum>())) value = Enum(*k);
}

/// The help of an action, with its key.
std::string help_of(const Action& action);
/// The meaning of a key, with its unit and what is allowed.
std::string help_of(const preset::Field& field);

/// Whether a menu or a list is open.
bool is_popup_open();
/// A label, with space for the control that follows it.
void label(const Panel& panel, const char* text);
/// A number that is dragged by `step` a pixel or typed, with a label before it and a tip.
void number(const Panel& panel, const char* text, const std::string& name, const std::string& tip,
            double& value, float step, float low, float high, const char* format);
/// A small heading within a panel.
void heading(const Panel& panel, const char* text);
/// A slider as wide as the panel, and its number, the control NAME_number, which can be clicked and
/// typed. Calls `set` while the mouse changes the value, and once when a number was typed; then
/// ends the drag.
void slider(const Panel& panel, const char* name, float value, float low, float high,
            const char* format, const std::string& tip, const std::function<void(float)>& set);
/// Rounded to four decimals, which removes the digits that a float adds to a typed number.
inline double four_digits(float value) { return std::round(1e4 * double(value)) / 1e4; }

// ---- the panels ----

void menu_bar(const Panel& panel);
void shell_panel(const Panel& panel, const render::Box& box);
void picked_figures(const Panel& panel);
void plots_panel(const Panel& panel, const render::Box& box);
void design_panel(const Panel& panel, const render::Box& box);
void status_line(const Panel& panel, const render::Box& box);
/// The steps that were done, to which a click returns, and pictures of the states that were found.
void timeline_panel(const Panel& panel, const render::Box& box);
/// Explains the certificate of the state.
void why_popup(const Panel& panel);
void help_sheet(const Panel& panel, const render::Box& box);
void terms_sheet(const Panel& panel, const render::Box& box);
void colour_legend(const Panel& panel, const render::Box& view);
/// Draws over the picture of the shell: what is picked, measured or under the mouse, forces, scale
/// bar and axes.
void view_overlay(const Panel& panel, const render::Box& view);
/// Position of a node, pixels of the window.
Eigen::Vector2d in_view(const ViewerState& viewer, const render::Box& view, int node);

/// The label of a key, without its unit: "diameter" for diameter_mm.
std::string label_of(const preset::Field& field);

/// Whether a text contains all words of `sought`, in any order and case.
bool contains_words(std::string text, std::string sought);

/// A text field, which takes up to 1 kB more than `text` has; `flags`: ImGuiInputTextFlags. Returns
/// true when the text is entered.
bool text_input(const char* id, std::string& text, const char* hint = "", int flags = 0);

/// The panel of all numbers of the preset, made from the field table. It stores the value that is
/// being edited, and the texts of the rows until a value changes.
class NumbersPanel {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  /// A number with its texts.
  struct Row {
    const preset::Field* field;
    std::string name, label, text, standard, help;
    bool by_name;  ///< the search found its name, not only its meaning
  };

  bool is_shown(const preset::Field& field);
  void edit(const Panel& panel, const Row& row);
  void change(const Panel& panel, bool passing);
  void look(const ViewerState& viewer);
  void find_idle();
  void list_rows();
  void list_tables(const Panel& panel, bool by_name);

  std::shared_ptr<const ShellView> seen_;  // the shell whose numbers these are
  preset::Preset edited_;
  std::vector<Row> rows_;       // the rows that are shown, valid if listed_
  std::set<std::string> idle_;  // keys that have no effect in this preset
  std::string active_;          // the key under the mouse
  std::string sought_;          // the text of the search
  bool typed_ = false;          // a number is being typed
  bool all_ = false;            // whether keys without effect are shown, too
  bool listed_ = false;
};

// Fonts, colours and distances of the interface.

/// Loads the text font (DejaVu Sans, which has □, ρ, δ and Δ) with `density` pixels per point of
/// text. Errors: io if the system has no such font.
Result<void> load_fonts(double density);

/// Sets light or dark colours, and distances for this density.
void choose_colours(bool dark, double density);

/// Colours of texts: errors and unstable states, valid states, missing parts, and remarks.
struct TextColours {
  ImU32 error, ok, warning, muted;
};
const TextColours& text_colours(bool dark);
void coloured_text(ImU32 colour, const std::string& text);

/// Draws a curve in the rectangle between two corners, pixels.
void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve);

/// The prompt for the file of viewer.file_request. It stores the contents of the shown folder.
class FilePrompt {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  /// An entry of a folder that can be picked: a folder, or a file that suits the purpose.
  struct Entry {
    std::string name;
    bool folder = false, run = false;
    std::string size = {}, changed = {};  ///< as texts
  };

  void look(FileUse use, const std::string& folder);
  void folder_buttons(const Panel& panel, FileRequest& request) const;
  bool list(const Panel& panel, FileRequest& request);
  bool complete(FileRequest& request) const;

  std::vector<Entry> entries_;
  FileUse use_ = FileUse::open;
  bool refocus_ = false;  // the path gets the keyboard again
  std::string folder_;
  std::optional<std::filesystem::file_time_type> changed_;
};

// A new shell.

/// A form for boundary, rods, spacing and material, and the flat grid that they give.
class NewShellForm {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  void build();
  void fields(const Panel& panel);
  void refusal(const Panel& panel);

  NewShell values_;
  std::string built_;  // the text of the preset from which the next two were made
  Result<preset::Presets> presets_ = invalid("");
  Result<Scene> scene_ = invalid("");
};

/// All presets as pictures, to choose from.
class PresetPicker {
 public:
  /// `gl` must outlive it.
  explicit PresetPicker(const render::Gl& gl) : gl_(&gl) {}

  void draw(const Panel& panel, const render::Box& box);

 private:
  void load(const std::vector<PresetCard>& cards);
  void opened_last(const Panel& panel) const;
  void card(const Panel& panel, const PresetCard& card, std::size_t number);

  const render::Gl* gl_;
  std::string sought_;
  std::vector<std::optional<render::Texture>> pictures_;  // one per card, loaded when shown
};

}  // namespace gridshell::window
