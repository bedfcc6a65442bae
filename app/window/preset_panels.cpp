#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "app/window/panel.h"
#include "engine/gridshell.h"

// The panel of all numbers of the preset, made from the field table; the panel of inverse design.

namespace gridshell::window {
namespace {

using preset::Field;

/// The tables that determine the shell. Those of its pictures have other controls.
constexpr std::string_view shown_tables[] = {
    "rod",   "rod_v",        "joints", "ends",    "footprint", "net",     "actuation",
    "loads", "imperfection", "limits", "contact", "accuracy",  "dynamics"};

float bound(double value) { return float(std::clamp(value, -1e9, 1e9)); }

/// Meaning of a number's 0, if the key's meaning gives one: "not given".
std::string meaning_of_zero(const Field& field) {
  const std::size_t at = field.meaning.find("0: ");
  if (at == std::string::npos || (at > 0 && field.meaning[at - 1] != ' ')) return "";
  std::string rest = field.meaning.substr(at + 3);
  if (rest.starts_with("the ")) rest.erase(0, 4);
  return rest.substr(0, rest.find_first_of(",;(%"));
}

/// Draws the control for the member of a key; returns whether it was changed.
struct Control {
  ViewerState& viewer;
  const Field& field;
  const char* id;

  std::string format(bool zero, const char* number) const {
    const std::string words = zero ? meaning_of_zero(field) : "";
    return !words.empty() ? words : number + (field.unit.empty() ? "" : " " + field.unit);
  }
  bool operator()(double* value) const { return drag(value, format(*value == 0, "%.6g")); }
  bool operator()(std::optional<double>* value) const {
    double number = value->value_or(0);
    if (!drag(&number, *value ? format(false, "%.6g") : "none")) return false;
    *value = number;
    return true;
  }
  bool drag(double* value, const std::string& text) const {
    float shown = float(*value);
    const float step = std::max(1e-6f, 0.005f * std::abs(shown));
    const auto& range = field.range;
    if (!ImGui::DragFloat(id, &shown, step, bound(range.low), bound(range.high), text.c_str(),
                          ImGuiSliderFlags_AlwaysClamp))
      return false;
    if (!range.contains(double(shown))) {
      viewer.say(fmt::format("{}: expected {}", name_of(field), allowed(field)), true);
      return false;
    }
    // only the digits that are shown, without those that a float adds
    *value = std::stod(fmt::format("{:.7g}", shown));
    return true;
  }
  bool operator()(int* value) const {
    return ImGui::DragInt(id, value, 0.1f, int(bound(field.range.low)),
                          int(bound(field.range.high)), format(*value == 0, "%d").c_str(),
                          ImGuiSliderFlags_AlwaysClamp);
  }
  bool operator()(bool* value) const { return ImGui::Checkbox(id, value); }
  bool operator()(const preset::OneWord& word) const {
    const auto now = std::size_t(word.get(word.member));
    const auto chosen = choose(id, field.words[now], field.words);
    if (!chosen || *chosen == now) return false;
    word.set(word.member, int(*chosen));
    return true;
  }
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }
};

/// Whether a control can change the key.
bool has_control(const Field& field, preset::Preset& preset) {
  return field.as<double>(preset) || field.as<std::optional<double>>(preset) ||
         field.as<int>(preset) || field.as<bool>(preset) || field.as_word(preset);
}

/// Gives a key of one preset the value that it has in another.
void take_value(const Field& field, preset::Preset& to, preset::Preset from) {
  if (double* value = field.as<double>(to)) *value = *field.as<double>(from);
  if (auto* value = field.as<std::optional<double>>(to))
    *value = *field.as<std::optional<double>>(from);
  if (int* value = field.as<int>(to)) *value = *field.as<int>(from);
  if (bool* value = field.as<bool>(to)) *value = *field.as<bool>(from);
  if (const auto word = field.as_word(to)) {
    const auto other = *field.as_word(from);
    word->set(word->member, other.get(other.member));
  }
}

/// The help of a key of [inverse], with unit and range.
std::string tip_of(const char* key) {
  for (const preset::Field& field : preset::field_table())
    if (field.table == "inverse" && field.key == key) return help_of(field);
  return "";
}

/// A value of [inverse] vary, with its texts.
struct Variable {
  preset::Vary kind;
  const char* label;
  const char* moves;
};
constexpr Variable variables[] = {
    {preset::Vary::pins_radial, "pins, radially", "positions of the ends, along the radius"},
    {preset::Vary::pins, "pins, in plane", "positions of the ends, in the boundary's plane"},
    {preset::Vary::pins_3d, "pins, in space", "positions of the ends, in every direction"},
    {preset::Vary::legs, "legs", "their lengths"},
    {preset::Vary::directions, "directions", "tangents of the ends"},
    {preset::Vary::diameters, "diameters", "of every rod, by a factor of two at most"},
};

/// Why a preset cannot vary this; null if it can.
const char* why_not(const preset::Preset& preset, preset::Vary kind) {
  if (kind == preset::Vary::directions && preset.ends.kind != preset::EndKind::tangent)
    return "the ends prescribe no direction by itself: expected [ends] kind \"tangent\"";
  if (kind == preset::Vary::diameters && (preset.rod.rectangular() || preset.rod_v.rectangular()))
    return "rectangular rods have no diameter";
  return nullptr;
}

void what_varies(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  std::vector<preset::Vary>& vary = viewer.design.inverse.vary;
  ImGui::TextUnformatted("What may change");
  int column = 0;
  for (const Variable& one : variables) {
    const char* not_here = why_not(viewer.shell->preset, one.kind);
    const auto at = std::ranges::find(vary, one.kind);
    bool on = at != vary.end();
    if (column++ % 2 == 1) ImGui::SameLine(panel.px(138));
    ImGui::BeginDisabled(not_here && !on);
    const std::string word{word_of(one.kind)};
    if (ImGui::Checkbox(one.label, &on)) {
      if (on)
        vary.push_back(one.kind);
      else
        vary.erase(at);
    }
    ImGui::EndDisabled();
    panel.named("vary_" + word, not_here ? not_here : word + ": " + one.moves);
  }
}

void choices(const Panel& panel) {
  preset::Inverse& inverse = panel.viewer.design.inverse;
  const auto number = [&](const char* text, const char* key, double& value, float step, float low,
                          float high, const char* format) {
    window::number(panel, text, std::string("design_") + key, tip_of(key), value, step, low, high,
                   format);
  };
  label(panel, "target");
  choose_word("##target", inverse.target);
  panel.named("design_target", tip_of("target"));
  number("norm", "norm", inverse.norm, 0.1f, 2, 32, "p = %.3g");
  number("furthest move", "move_limit_mm", inverse.move_limit_mm, 0.05f, 0.01f, 100, "%.3g mm");
  number("rounding", "round_mm", inverse.round_mm, 0.01f, 0, 10, "%.3g mm");
  label(panel, "iterations");
  ImGui::DragInt("##most", &panel.viewer.design.most_iterations, 0.1f, 1, 100, "at most %d",
                 ImGuiSliderFlags_AlwaysClamp);
  panel.named("design_iterations",
              "after so many it ends; started again it continues from the present shell, and moves "
              "count from there");
}

void buttons(const Panel& panel) {
  panel.button("design_start", "Start");
  ImGui::SameLine();
  panel.button("design_stop", "Stop");
  ImGui::SameLine();
  panel.button("design_keep", "Keep this");
  ImGui::SameLine();
  panel.button("design_put_back", "Put back");
}

void progress(const Panel& panel, const DesignProgress& design) {
  const double percent = 100 / design.length_scale_mm;
  const DesignPoint &first = design.points.front(), &now = design.points.back();
  const char* how = design.under_way ? "running"
                    : design.kept    ? "kept"
                    : design.stopped ? "stopped: keep or put back"
                                     : "done: keep or put back";
  ImGui::Text("iteration %d, %s", design.iterations, how);
  ImGui::Text("largest %.3f %% of ρ, %.3g mm", percent * now.max_mm, now.max_mm);
  ImGui::Text("mean %.3f %% of ρ, %.3g mm", percent * now.mean_mm, now.mean_mm);
  ImGui::Text("moved %.2f mm, eigenvalue x %.3g", now.largest_move_mm,
              now.eigenvalue / first.eigenvalue);
  panel.named("design_eigenvalue",
              "the furthest move of a pin or a leg; the Hessian's smallest eigenvalue on 32 edges "
              "a segment over that before, below [inverse] min_stability a step is passed over");
  if (now.thickest_mm > now.thinnest_mm)
    ImGui::Text("rods %.3f to %.3f mm", now.thinnest_mm, now.thickest_mm);
}

void plot(const Panel& panel, const DesignProgress& design) {
  Curve curve{"largest, mean (grey), % of ρ", "steps", "", {}, {}};
  curve.logarithmic = true;
  const double percent = 100 / design.length_scale_mm;
  for (const DesignPoint& point : design.points) {
    curve.x.push_back(float(point.iteration));
    curve.y.push_back(float(percent * point.max_mm));
    curve.second.push_back(float(percent * point.mean_mm));
  }
  const ImVec2 low = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
  const float height = std::max(space.y, panel.px(90));
  draw_curve(panel, low, {low.x + space.x, low.y + height - panel.px(4)}, curve);
  ImGui::Dummy({space.x, height - panel.px(8)});
  panel.named("design_plot", "distances of the joints from the target, of every certified step");
}

}  // namespace

void NumbersPanel::change(const Panel& panel, bool passing) {
  panel.viewer.post(Change{edited_}, passing);
  find_idle();
}

void NumbersPanel::edit(const Panel& panel, const Row& row) {
  static const preset::Preset defaults;
  const Field& field = *row.field;
  const std::string id = "##" + row.name;
  const bool changed_before = row.text != row.standard;
  const float back = panel.px(26);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(row.label.c_str());
  ImGui::SameLine(std::max(panel.px(118), ImGui::CalcTextSize(row.label.c_str()).x + panel.px(16)));
  ImGui::SetNextItemWidth(-back);
  // default values are pale
  if (!changed_before)
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(ImGuiCol_TextDisabled));
  const bool changed = std::visit(Control{panel.viewer, field, id.c_str()}, field.in(edited_, -1));
  if (!changed_before) ImGui::PopStyleColor();
  if (changed && field.key == "material") {
    preset::Rod& rod = field.table == "rod" ? edited_.rod : edited_.rod_v;
    preset::take_material(rod, preset::Rod(rod), [](const char*) { return false; });
  }
  panel.named(field.table + "." + field.key, row.help);
  if (ImGui::IsItemActive()) active_ = row.name;
  // a number is complete when the control is left
  const bool meant = is_typed_into() ? false : changed || (typed_ && ImGui::IsItemDeactivated());
  if (changed && is_typed_into()) typed_ = true;
  if (meant) {
    typed_ = false;
    change(panel, ImGui::IsItemActive());
  }
  if (ImGui::IsItemDeactivated()) {
    if (active_ == row.name) panel.viewer.end_drag();
    active_.clear();
  }
  if (!changed_before) return;
  ImGui::SameLine(ImGui::GetContentRegionMax().x - back + panel.px(4));
  if (ImGui::SmallButton(("↺##" + row.name).c_str())) {
    take_value(field, edited_, defaults);
    change(panel, false);
  }
  panel.named("default_" + field.table + "." + field.key, "back to the default, " + row.standard);
}

/// Makes the list of rows; a change may add or remove rows.
void NumbersPanel::list_rows() {
  static const preset::Preset defaults;
  if (std::exchange(listed_, true)) return;
  rows_.clear();
  for (const Field& field : preset::field_table()) {
    if (std::ranges::find(shown_tables, field.table) == std::end(shown_tables) || !is_shown(field))
      continue;
    const std::string name = name_of(field), text = value_text(field, edited_);
    rows_.push_back({&field, name, label_of(field), text, value_text(field, defaults),
                     fmt::format("{} = {}: {}", name, text, help_of(field)),
                     contains_words(name + " " + label_of(field), sought_)});
  }
}

void NumbersPanel::find_idle() {
  listed_ = false;
  idle_.clear();
  for (const auto& key : preset::unused_keys(edited_))
    if (key.item < 0) idle_.insert(key.table + "." + key.key);
  // the second family has its own numbers only if it differs
  if (edited_.rod_v.differs) return;
  for (const Field& field : preset::field_table())
    if (field.table == "rod_v" && field.key != "differs")
      idle_.insert(field.table + "." + field.key);
}

/// Takes the preset of the shell, except while a number is being changed: the shell may be older
/// than the last command.
void NumbersPanel::look(const ViewerState& viewer) {
  if (!active_.empty() || seen_ == viewer.shell) return;
  seen_ = viewer.shell;
  edited_ = seen_->preset;
  find_idle();
}

bool NumbersPanel::is_shown(const Field& field) {
  if (!has_control(field, edited_) || (!all_ && idle_.contains(field.table + "." + field.key)))
    return false;
  return contains_words(field.table + " " + field.key + " " + label_of(field) + " " + field.meaning,
                        sought_);
}

void NumbersPanel::list_tables(const Panel& panel, bool by_name) {
  ImGui::PushID(by_name);
  for (const preset::Table& table : preset::tables()) {
    const auto here = [&](const Row& row) {
      return row.field->table == table.name && row.by_name == by_name;
    };
    if (std::ranges::none_of(rows_, here)) continue;
    // rods of the second family
    const char* title = table.name == "rod_v" ? "rods along v" : table.name.c_str();
    const bool open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
    panel.named("table " + table.name, table.meaning);
    if (!open) continue;
    for (const Row& row : rows_)
      if (here(row)) edit(panel, row);
  }
  ImGui::PopID();
}

void NumbersPanel::draw(const Panel& panel, const render::Box& box) {
  begin_fixed("numbers", box);
  heading(panel, "Parameters of the preset");
  if (panel.viewer.shell->any()) {
    look(panel.viewer);
    ImGui::SetNextItemWidth(panel.px(160));
    if (std::exchange(panel.viewer.find_number, false)) ImGui::SetKeyboardFocusHere();
    const std::string sought = sought_;
    text_input("##sought", sought_, "search (Ctrl+F)");
    panel.named("search numbers", "words of a name, a table or what it means");
    ImGui::SameLine();
    const bool other = ImGui::Checkbox("all", &all_);
    panel.named("all numbers", "also those that this scene does not use");
    if (other || sought != sought_) listed_ = false;
    list_rows();
    // first the rows whose name was found, then those whose meaning was
    for (const bool by_name : {true, false}) list_tables(panel, by_name);
  }
  ImGui::End();
}

// The panel of inverse design: what may change, and the progress.

void design_panel(const Panel& panel, const render::Box& box) {
  const ShellView& shell = *panel.viewer.shell;
  begin_fixed("design", box);
  heading(panel, "Design: the shell meets its surface");
  const std::string why = why_not_designed(shell);
  if (shell.any() && shell.layout->net_nodes.cols() > 0) {
    ImGui::BeginDisabled(shell.designing());
    what_varies(panel);
    choices(panel);
    ImGui::EndDisabled();
  }
  if (!why.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", (why + ".").c_str());
    ImGui::PopTextWrapPos();
  }
  if (why.empty() || shell.design) buttons(panel);
  if (shell.design) {
    progress(panel, *shell.design);
    plot(panel, *shell.design);
  }
  ImGui::End();
}

}  // namespace gridshell::window
