// The form for a new shell, which shows the flat grid in plan.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel.h"
#include "engine/core/json.h"

namespace gridshell::window {
namespace {

/// The kinds of boundary, named as in presets.
const std::vector<std::string> boundaries{"circle", "ellipse", "superellipse", "file"};
const std::vector<std::string> boundary_texts{"circle", "ellipse", "rounded rectangle",
                                              "outline in a drawing"};

/// Draws rods and boundaries of a scene in plan, as large as the rectangle permits.
void draw_plan(const Panel& panel, const Scene& scene, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg));
  list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_Border));
  const Eigen::Matrix3Xd& ring = scene.original_boundary;
  const Eigen::Vector3d from = ring.rowwise().minCoeff(), to = ring.rowwise().maxCoeff();
  const double scale = 0.9 * std::min((high.x - low.x) / (to.x() - from.x()),
                                      (high.y - low.y) / (to.y() - from.y()));
  const Eigen::Vector3d middle = 0.5 * (from + to);
  const auto at = [&](const Eigen::Vector3d& point) {
    return ImVec2(0.5f * (low.x + high.x) + float(scale * (point.x() - middle.x())),
                  0.5f * (low.y + high.y) - float(scale * (point.y() - middle.y())));
  };
  const auto loop = [&](const Eigen::Matrix3Xd& points, ImU32 colour) {
    for (const auto& point : points.colwise()) list.PathLineTo(at(point));
    list.PathStroke(colour, true, panel.px(1.4));
  };
  loop(ring, ImGui::GetColorU32(ImGuiCol_TextDisabled));
  loop(scene.actuated_boundary, ImGui::GetColorU32(ImGuiCol_PlotLines));
  for (const FootprintRod& rod : scene.footprint.rods)
    list.AddLine(at(scene.flat.at(rod.at(rod.span.begin))), at(scene.flat.at(rod.at(rod.span.end))),
                 ImGui::GetColorU32(ImGuiCol_Text), panel.px(1));
}

}  // namespace

std::string NewShell::preset() const {
  std::string text = fmt::format("title = \"New shell\"\n[rod]\ndiameter_mm = {}\n", diameter_mm);
  if (material != preset::Material::none)
    text += fmt::format("material = \"{}\"\n", word_of(material));
  text += fmt::format("[footprint]\nspacing_mm = {}\n", spacing_mm);
  const std::string& kind = boundaries[boundary];
  if (kind == "circle")
    return text + fmt::format(
                      "rods = {}\nradius_mm = {}\nplacement = \"{}\"\n[actuation]\nratio = "
                      "{}\n",
                      rods, radius_mm, rods % 2 == 0 ? "half" : "on_axis", ratio);
  text += fmt::format("kind = \"curve\"\nboundary = \"{}\"\n", kind);
  text += kind == "file" ? fmt::format("file = {}\n", line_of(Json(file)))
                         : fmt::format("half_x_mm = {}\nhalf_y_mm = {}\n", half_mm[0], half_mm[1]);
  return text + fmt::format("[actuation]\nscale = {}\n", ratio);
}

void NewShellForm::build() {
  if (const std::string text = values_.preset(); text != built_) {
    built_ = text;
    presets_ = preset::read_preset_text(text, "new shell", "new_shell");
    scene_ =
        presets_.and_then([](const preset::Presets& presets) { return scene_of(presets.base); });
  }
}

void NewShellForm::fields(const Panel& panel) {
  const auto number = [&](const char* text, const char* name, double& value, float low, float high,
                          const char* format) {
    window::number(panel, text, name, text, value, 0.005f * float(std::abs(value)), low, high,
                   format);
  };
  label(panel, "boundary");
  if (const auto k = choose("##boundary", boundary_texts[values_.boundary], boundary_texts))
    values_.boundary = *k;
  panel.named("new_boundary", "the curve that cuts the flat square grid");
  if (boundaries[values_.boundary] == "circle") {
    number("radius Rₒ", "new_radius", values_.radius_mm, 1, 1e6f, "%.6g mm");
    label(panel, "rods per direction");
    ImGui::DragInt("##rods", &values_.rods, 0.1f, 2, 500, "%d", ImGuiSliderFlags_AlwaysClamp);
    panel.named("new_rods", "number of parallel rods in each of the two directions");
  } else if (boundaries[values_.boundary] == "file") {
    label(panel, "drawing");
    text_input("##drawing", values_.file, "plan.dxf, .svg or .obj");
    panel.named("new_file", "path of a drawing; its largest closed line is the boundary");
  } else {
    number("half width", "new_half_x", values_.half_mm[0], 1, 1e6f, "%.6g mm");
    number("half depth", "new_half_y", values_.half_mm[1], 1, 1e6f, "%.6g mm");
  }
  number("spacing d", "new_spacing", values_.spacing_mm, 0.1f, 1e5f, "%.6g mm");
  number(values_.boundary == 0 ? "drawn in to Rₐ/Rₒ" : "drawn in to", "new_ratio", values_.ratio,
         0.3f, 1, "%.3g");
  label(panel, "material");
  choose_word("##material", values_.material);
  panel.named("new_material", "stiffness, density and strength; none: the paper's nitinol wire");
  number("rod diameter", "new_diameter", values_.diameter_mm, 0.01f, 1000, "%.6g mm");
}

/// Shows why there is no such shell, and a button for a radius with room for the rods.
void NewShellForm::refusal(const Panel& panel) {
  ImGui::PushStyleColor(ImGuiCol_Text, text_colours(panel.viewer.show.dark).error);
  ImGui::TextWrapped("%s", scene_.error().message.c_str());
  ImGui::PopStyleColor();
  // the longest leg is 0.8 times the spacing, as in the paper
  const double fits = (0.5 * (values_.rods - 1) + 0.8) * values_.spacing_mm;
  if (boundaries[values_.boundary] != "circle" || std::abs(fits - values_.radius_mm) < 1e-9) return;
  if (ImGui::Button(fmt::format("Rₒ = {:.5g} mm: do it", fits).c_str())) values_.radius_mm = fits;
  panel.named("new_fit", "a radius that has room for as many rods");
}

void NewShellForm::draw(const Panel& panel, const render::Box& box) {
  begin_fixed("new shell", box, 0, Layer::over);
  heading(panel, "New shell");
  const float left = std::min(panel.px(290), 0.5f * ImGui::GetContentRegionAvail().x);
  build();
  ImGui::BeginChild("fields", {left, 0});
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  fields(panel);
  build();
  ImGui::BeginDisabled(!scene_);
  const bool taken = ImGui::Button("Form it");
  ImGui::EndDisabled();
  panel.named("new_form", "forms this shell; all other parameters can be changed then");
  ImGui::SameLine();
  const bool cancelled = ImGui::Button("Cancel");
  panel.named("new_cancel", "Esc");
  if (scene_)
    ImGui::TextDisabled("%d joints, %d rods", int(scene_->footprint.joints.size()),
                        int(scene_->footprint.rods.size()));
  else
    refusal(panel);
  ImGui::EndChild();
  ImGui::SameLine();
  const ImVec2 low = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  if (scene_) draw_plan(panel, *scene_, low, {low.x + room.x, low.y + room.y});
  ImGui::Dummy(room);
  panel.named("new_plan", "the flat grid from above: its boundary, and in blue where it moves to");
  ImGui::End();
  if (taken) panel.viewer.open(presets_->base);
  if (cancelled) panel.viewer.new_shell = false;
}

}  // namespace gridshell::window
