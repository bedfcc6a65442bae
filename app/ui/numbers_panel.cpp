// Every number of the preset, as the field table has it: name, unit, range, meaning.
#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "app/ui/panel.h"
#include "engine/preset/field_table.h"
#include "engine/preset/use.h"

namespace gridshell::ui {
namespace {

using preset::Field;

/// Those that the shell hangs on; how it is pictured has controls of its own.
constexpr const char* shown_tables[] = {"rod",          "rod_v",  "joints",    "ends",
                                        "footprint",    "net",    "actuation", "loads",
                                        "imperfection", "limits", "accuracy",  "dynamics"};

float bound(double value) { return float(std::clamp(value, -1e9, 1e9)); }

/// A control for one kind of value; whether it was changed.
struct Control {
  preset::Preset& preset;
  const char* id;

  bool operator()(const preset::Real& kind) const {
    double& value = kind.in(preset);
    float shown = float(value);
    const float step = std::max(1e-6f, 0.005f * std::abs(shown));
    if (!ImGui::DragFloat(id, &shown, step, bound(kind.range.low), bound(kind.range.high), "%.6g",
                          ImGuiSliderFlags_AlwaysClamp) ||
        !kind.range.holds(double(shown)))
      return false;
    value = double(shown);
    return true;
  }
  bool operator()(const preset::Integer& kind) const {
    int& value = kind.in(preset);
    const auto limit = [](double v) { return int(std::clamp(v, -1e9, 1e9)); };
    return ImGui::DragInt(id, &value, 0.1f, limit(kind.range.low), limit(kind.range.high), "%d",
                          ImGuiSliderFlags_AlwaysClamp);
  }
  bool operator()(const preset::Flag& kind) const { return ImGui::Checkbox(id, &kind.in(preset)); }
  bool operator()(const preset::Word& kind) const {
    const int now = kind.get(preset);
    bool changed = false;
    if (!ImGui::BeginCombo(id, kind.words[std::size_t(now)].c_str())) return false;
    for (int k = 0; k < int(kind.words.size()); ++k)
      if (ImGui::Selectable(kind.words[std::size_t(k)].c_str(), k == now) && k != now)
        kind.set(preset, k), changed = true;
    ImGui::EndCombo();
    return changed;
  }
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }
};

/// Whether a control can change it.
bool has_control(const Field& field) {
  return std::holds_alternative<preset::Real>(field.kind) ||
         std::holds_alternative<preset::Integer>(field.kind) ||
         std::holds_alternative<preset::Flag>(field.kind) ||
         std::holds_alternative<preset::Word>(field.kind);
}

}  // namespace

bool NumbersPanel::edit(const Panel& panel, const Field& field) {
  const std::string name = name_of(field), id = "##" + name;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(field.key.c_str());
  const float label = ImGui::CalcTextSize(field.key.c_str()).x;
  ImGui::SameLine(std::max(panel.px(150), label + panel.px(16)));
  ImGui::SetNextItemWidth(-1);
  const bool changed = std::visit(Control{edited_, id.c_str()}, field.kind);
  panel.named(field.table + "." + field.key,
              fmt::format("{}{}; {}", field.meaning, field.unit.empty() ? "" : ", in " + field.unit,
                          allowed(field)));
  if (ImGui::IsItemActive()) active_ = name;
  // a number is meant when its last digit stands
  const bool meant = is_typed_into() ? false : changed || (typed_ && ImGui::IsItemDeactivated());
  if (changed && is_typed_into()) typed_ = true;
  if (meant) {
    typed_ = false;
    panel.desk.change(edited_, ImGui::IsItemActive());
    find_idle();
  }
  if (ImGui::IsItemDeactivated()) {
    if (active_ == name) panel.desk.let_go();
    active_.clear();
  }
  return meant;
}

void NumbersPanel::find_idle() {
  idle_.clear();
  for (const auto& key : preset::idle_keys(edited_))
    if (key.item < 0) idle_.insert(key.table + "." + key.key);
  // the second family has numbers of its own once it differs
  if (edited_.rod_v.differs) return;
  for (const Field& field : preset::field_table())
    if (field.table == "rod_v" && field.key != "differs")
      idle_.insert(field.table + "." + field.key);
}

/// While a hand is at a number, the engine's answer may be older than its wish.
void NumbersPanel::look(const window::Desk& desk) {
  if (!active_.empty() || seen_ == desk.sight) return;
  seen_ = desk.sight;
  edited_ = seen_->preset;
  find_idle();
}

void NumbersPanel::draw(const Panel& panel, const render::Box& box) {
  begin_fixed("numbers", box);
  heading(panel, "Numbers of the preset");
  if (panel.desk.sight->any()) {
    look(panel.desk);
    // an edit may take a number away or bring one
    const auto shown = [this](const Field& field, const char* table) {
      return field.table == table && has_control(field) &&
             !idle_.contains(field.table + "." + field.key);
    };
    for (const char* table : shown_tables) {
      bool any = false;
      for (const Field& field : preset::field_table()) any |= shown(field, table);
      if (!any || !ImGui::CollapsingHeader(table, ImGuiTreeNodeFlags_DefaultOpen)) continue;
      for (const Field& field : preset::field_table())
        if (shown(field, table)) edit(panel, field);
    }
  }
  ImGui::End();
}

}  // namespace gridshell::ui
