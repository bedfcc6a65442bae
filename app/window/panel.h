// What panels share: their positions, the names of controls, and tooltips.
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
#include "engine/gridshell.h"
#include "render/canvas/canvas.h"
#include "render/gl/opengl.h"

namespace gridshell::window {

/// One frame of the interface: what panels draw into.
struct Panel {
  ViewerState& viewer;
  double density = 1;                            ///< pixels a point of text
  std::map<std::string, render::Box>& controls;  ///< position of each control, by its name
  std::vector<ImTextureID> states = {};          ///< one picture each of viewer.shell->found

  float px(double points) const { return float(points * density); }
  /// Notes where the last control is, and gives it a tooltip.
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

/// A list that opens to choose from; returns the index of the chosen text, if one was chosen.
std::optional<std::size_t> choose(const std::string& id, const std::string& shown,
                                  const std::vector<std::string>& texts);

/// A list of all names of an enum.
template <class Enum>
void choose_word(const std::string& id, Enum& value) {
  if (const auto k = choose(id, std::string(word_of(value)), all_words<Enum>())) value = Enum(*k);
}

/// What an action does, with its key.
std::string help_of(const Action& action);
/// The meaning of a key, with its unit and what is allowed.
std::string help_of(const preset::Field& field);

/// Whether a menu or a list is open.
bool is_popup_open();
/// A label, with space for the control that follows it.
void label(const Panel& panel, const char* text);
/// A small heading within a panel.
void heading(const Panel& panel, const char* text);
/// A slider over the panel's width with its number, which a click types, as the control
/// NAME_number. Calls `set` while the mouse changes the value and once it was typed; then the drag
/// ends.
void slider(const Panel& panel, const char* name, float value, float low, float high,
            const char* format, const std::string& tip, const std::function<void(float)>& set);
/// Without what a float adds.
inline double four_digits(float value) { return std::round(1e4 * double(value)) / 1e4; }

// ---- the panels, by position ----

void menu_bar(const Panel& panel);
void shell_panel(const Panel& panel, const render::Box& box);
void picked_figures(const Panel& panel);
void plots_panel(const Panel& panel, const render::Box& box);
void design_panel(const Panel& panel, const render::Box& box);
void status_line(const Panel& panel, const render::Box& box);
/// The steps, to go back to; the reason for the certificate of the state; and the states found, as
/// small pictures.
void timeline_panel(const Panel& panel, const render::Box& box);
void why_popup(const Panel& panel);
void help_sheet(const Panel& panel, const render::Box& box);
void terms_sheet(const Panel& panel, const render::Box& box);
void colour_legend(const Panel& panel, const render::Box& view);
/// Over the picture of the shell: what is picked, measured and under the mouse, forces, scale bar,
/// axes.
void view_overlay(const Panel& panel, const render::Box& view);
/// Where a node is drawn, pixels of the window.
Eigen::Vector2d in_view(const ViewerState& viewer, const render::Box& view, int node);

/// "diameter" of diameter_mm.
std::string label_of(const preset::Field& field);

/// Whether a text has all words that are looked for, in any order and case.
bool contains_words(std::string text, std::string sought);

/// A line of text to type into, with space for 1 kB more and flags of the library; true once it is
/// entered.
bool text_input(const char* id, std::string& text, const char* hint = "", int flags = 0);

/// Every number of the preset, from the field table; remembers what is being changed, and what it
/// says of each as long as none changes.
class NumbersPanel {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  /// A number with its texts.
  struct Row {
    const preset::Field* field;
    std::string name, label, text, standard, help;
    bool by_name;  ///< the words that are looked for are in its name, not in what it means
  };

  bool is_shown(const preset::Field& field);
  void edit(const Panel& panel, const Row& row);
  void change(const Panel& panel, bool passing);
  void look(const ViewerState& viewer);
  void find_idle();
  void list_rows();
  void list_tables(const Panel& panel, bool by_name);

  std::shared_ptr<const ShellView> seen_;  // that the numbers are of
  preset::Preset edited_;
  std::vector<Row> rows_;       // those that are shown, as long as listed_
  std::set<std::string> idle_;  // keys that count for nothing in it
  std::string active_;          // the key under the mouse
  std::string sought_;          // what is looked for
  bool typed_ = false;          // digits that are not meant yet
  bool all_ = false;            // those that count for nothing are shown, too
  bool listed_ = false;
};

// Fonts, colours and distances of the interface.

/// Loads the text font (DejaVu Sans: it has □, ρ, δ and Δ) at so many pixels a point of text.
/// Errors: io when the system has none.
Result<void> load_fonts(double density);

/// Light or dark.
void choose_colours(bool dark, double density);

/// Colours of texts: errors and unstable states, valid states, missing parts, and remarks.
struct TextColours {
  ImU32 error, ok, warning, muted;
};
const TextColours& text_colours(bool dark);
void coloured_text(ImU32 colour, const std::string& text);

// A small plot within a panel.

/// A position on the abscissa, or an interval of it.
struct CurveMark {
  float from, to;
  bool unstable;  ///< no shell stays there; else something happened
  std::string what;
};

/// One curve, or two over the same x.
struct Curve {
  const char* y_label;
  const char* x_label;
  const char* without;  ///< said where there is nothing to plot
  std::vector<float> x, y;
  bool bars = false;
  std::vector<std::size_t> jumps = {};     ///< points that no line leads to
  std::vector<float> second = {};          ///< another one, paler
  bool logarithmic = false;                ///< y, which is above 0
  std::vector<std::size_t> unstable = {};  ///< points
  std::vector<std::size_t> coarse = {};    ///< points of a drag's coarse mesh: pale
  std::vector<CurveMark> marks = {};
  bool whole = false;  ///< x counts something
};

/// Draws it between two corners, pixels.
void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve);

/// Asks for the file of viewer.file_request; remembers what lies in the folder that is shown.
class FilePrompt {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  /// What of a folder can be picked: folders, and files that the use is for.
  struct Entry {
    std::string name;
    bool folder = false, run = false;
    std::string size = {}, changed = {};  ///< as shown
  };

  void look(FileUse use, const std::string& folder);
  void places(const Panel& panel, FileRequest& request) const;
  bool list(const Panel& panel, FileRequest& request);
  bool complete(FileRequest& request) const;

  std::vector<Entry> entries_;
  FileUse use_ = FileUse::open;
  bool refocus_ = false;  // the path is typed on
  std::string folder_;
  std::optional<std::filesystem::file_time_type> changed_;
};

// A shell of one's own.

/// A form for boundary, rods, spacing and material, and the flat grid that they give.
class NewShellForm {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  std::string preset() const;
  void build();
  void fields(const Panel& panel);
  void refusal(const Panel& panel);
  void number(const Panel& panel, const char* text, const char* name, double& value, float low,
              float high, const char* format) const;

  std::size_t boundary_ = 0;
  int rods_ = 12;
  double radius_mm_ = 126, half_mm_[2] = {160, 110}, spacing_mm_ = 20, ratio_ = 0.8,
         diameter_mm_ = 0.254;
  std::string file_;
  preset::Material material_ = preset::Material::none;
  std::string built_;  // the text that the next two are of
  Result<preset::Presets> presets_ = invalid("");
  Result<Scene> scene_ = invalid("");
};

// All presets to choose from, as pictures.

class PresetPicker {
 public:
  /// `gl` outlives it.
  explicit PresetPicker(const render::Gl& gl) : gl_(&gl) {}

  void draw(const Panel& panel, const render::Box& box);

 private:
  void load(const std::vector<PresetCard>& cards);
  void opened_last(const Panel& panel) const;
  void card(const Panel& panel, const PresetCard& card, std::size_t number);

  const render::Gl* gl_;
  std::string sought_;
  std::vector<std::optional<render::Texture>> pictures_;  // one per card, from the first sight on
};

}  // namespace gridshell::window
