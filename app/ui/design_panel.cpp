// Inverse design: what may change so that the shell meets its surface, and how far it has come.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/ui/plot_box.h"
#include "engine/preset/field_table.h"

namespace gridshell::ui {
namespace {

using window::DesignCourse;
using window::DesignPoint;
using window::Desk;

/// What a key of [inverse] means, with unit and range.
std::string tip_of(const char* key) {
  for (const preset::Field& field : preset::field_table())
    if (field.table == "inverse" && field.key == key)
      return fmt::format("{}{}; {}", field.meaning, field.unit.empty() ? "" : ", in " + field.unit,
                         allowed(field));
  return "";
}

/// What one of the words of `vary` moves; why it cannot here, if so.
struct Variable {
  preset::Vary kind;
  const char* label;
  const char* moves;
};
constexpr Variable variables[] = {
    {preset::Vary::pins_radial, "pins, radially", "where ends are held, along the radius"},
    {preset::Vary::pins, "pins, in plane", "where ends are held, in the boundary's plane"},
    {preset::Vary::pins_3d, "pins, in space", "where ends are held, in every direction"},
    {preset::Vary::legs, "legs", "their lengths"},
    {preset::Vary::directions, "directions", "along which tangent ends are held"},
    {preset::Vary::diameters, "diameters", "of every rod, by a factor of two at most"},
};

const char* why_not(const preset::Preset& preset, preset::Vary kind) {
  if (kind == preset::Vary::directions && preset.ends.kind != preset::EndKind::tangent)
    return "the ends hold no direction by itself: [ends] kind must be \"tangent\"";
  if (kind == preset::Vary::diameters && (preset.rod.rectangular() || preset.rod_v.rectangular()))
    return "rectangular rods have no diameter";
  return nullptr;
}

void what_varies(const Panel& panel) {
  Desk& desk = panel.desk;
  std::vector<preset::Vary>& vary = desk.design.inverse.vary;
  ImGui::TextUnformatted("What may change");
  int column = 0;
  for (const Variable& one : variables) {
    const char* not_here = why_not(desk.sight->preset, one.kind);
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

/// A label, and room for what follows beside it.
void label(const Panel& panel, const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(panel.px(138));
  ImGui::SetNextItemWidth(-1);
}

void number(const Panel& panel, const char* text, const char* key, double& value, float step,
            float low, float high, const char* format) {
  label(panel, text);
  float shown = float(value);
  if (ImGui::DragFloat((std::string("##") + key).c_str(), &shown, step, low, high, format,
                       ImGuiSliderFlags_AlwaysClamp))
    value = std::round(1e4 * double(shown)) / 1e4;
  panel.named(std::string("design_") + key, tip_of(key));
}

void choices(const Panel& panel) {
  preset::Inverse& inverse = panel.desk.design.inverse;
  label(panel, "target");
  if (ImGui::BeginCombo("##target", std::string(word_of(inverse.target)).c_str())) {
    for (const auto& entry : words(preset::Target{}))
      if (ImGui::Selectable(std::string(entry.word).c_str(), entry.value == inverse.target))
        inverse.target = entry.value;
    ImGui::EndCombo();
  }
  panel.named("design_target", tip_of("target"));
  number(panel, "norm", "norm", inverse.norm, 0.1f, 2, 32, "p = %.3g");
  number(panel, "furthest move", "move_limit_mm", inverse.move_limit_mm, 0.05f, 0.01f, 100,
         "%.3g mm");
  number(panel, "rounding", "round_mm", inverse.round_mm, 0.01f, 0, 10, "%.3g mm");
  label(panel, "iterations");
  ImGui::DragInt("##most", &panel.desk.design.most_iterations, 0.1f, 1, 100, "at most %d",
                 ImGuiSliderFlags_AlwaysClamp);
  panel.named("design_iterations",
              "after so many it ends; started again it goes on from the shell in hand, and moves "
              "count from there");
}

void buttons(const Panel& panel) {
  const window::Sight& sight = *panel.desk.sight;
  const bool under_way = sight.designing(), pending = sight.design && !sight.design->kept;
  panel.button("design_start", "Start", !under_way && window::why_not_designed(sight).empty());
  ImGui::SameLine();
  panel.button("design_stop", "Stop", under_way);
  ImGui::SameLine();
  panel.button("design_keep", "Keep this", pending);
  ImGui::SameLine();
  panel.button("design_put_back", "Put back", sight.design != nullptr);
}

void standing(const Panel& panel, const DesignCourse& course) {
  const double percent = 100 / course.length_scale_mm;
  const DesignPoint &first = course.points.front(), &now = course.points.back();
  const char* how = course.under_way ? "under way"
                    : course.kept    ? "kept"
                    : course.stopped ? "stopped: keep or put back"
                                     : "done: keep or put back";
  ImGui::Text("iteration %d, %s", course.iterations, how);
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

void plot(const Panel& panel, const DesignCourse& course) {
  Curve curve{"largest and (grey) mean, % of ρ", "iteration", "", {}, {}};
  curve.logarithmic = true;
  const double percent = 100 / course.length_scale_mm;
  for (const DesignPoint& point : course.points) {
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

void design_panel(const Panel& panel, const render::Box& box) {
  const window::Sight& sight = *panel.desk.sight;
  begin_fixed("design", box);
  heading(panel, "Design: the shell meets its surface");
  const std::string why = window::why_not_designed(sight);
  if (sight.any() && sight.layout->net_nodes.cols() > 0) {
    ImGui::BeginDisabled(sight.designing());
    what_varies(panel);
    choices(panel);
    ImGui::EndDisabled();
  }
  if (!why.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", (why + ".").c_str());
    ImGui::PopTextWrapPos();
  }
  if (why.empty() || sight.design) buttons(panel);
  if (sight.design) {
    standing(panel, *sight.design);
    plot(panel, *sight.design);
  }
  ImGui::End();
}

}  // namespace gridshell::ui
