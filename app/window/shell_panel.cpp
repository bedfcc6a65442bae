// Controls of the shell: path, boundary, constrained joints, relaxation, accuracy, colours.
#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/panel.h"
#include "app/window/shell_drawing.h"
#include "engine/gridshell.h"
#include "render/movie/frame_overlay.h"

namespace gridshell::window {

namespace {

/// Whether the value of the last control shall be used: while the mouse drags it, and when a typed
/// number was entered, which then is `value`.
bool is_meant(const std::string& label, float& value, bool changed) {
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID number = ImGui::GetID((label + " typed").c_str()),
                any = ImGui::GetID((label + " any typed").c_str());
  if (is_typed_into()) {
    if (changed) kept.SetFloat(number, value), kept.SetBool(any, true);
    return false;
  }
  if (!ImGui::IsItemDeactivated() || !kept.GetBool(any)) return changed;
  kept.SetBool(any, false);
  value = kept.GetFloat(number);
  return true;
}

}  // namespace

void slider(const Panel& panel, const char* name, float value, float low, float high,
            const char* format, const std::string& tip, const std::function<void(float)>& set) {
  const std::string label = std::string("##") + name, number = label + " number";
  const float field = panel.px(92);
  float typed = value;
  const auto keeps_text = [&](const std::string& id) {
    return ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
  };
  // the slider's own number is hidden, since the field next to it shows it
  const bool hidden = !keeps_text(label);
  if (hidden) ImGui::PushStyleColor(ImGuiCol_Text, 0);
  ImGui::SetNextItemWidth(-field - ImGui::GetStyle().ItemSpacing.x);
  bool changed =
      ImGui::SliderFloat(label.c_str(), &value, low, high, format, ImGuiSliderFlags_AlwaysClamp);
  if (hidden) ImGui::PopStyleColor();
  panel.named(name, tip);
  changed = is_meant(label, value, changed);
  bool left = ImGui::IsItemDeactivated();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const bool other = ImGui::DragFloat(number.c_str(), &typed, 0.002f * std::max(1e-3f, high - low),
                                      low, high, format, ImGuiSliderFlags_AlwaysClamp);
  panel.named(std::string(name) + "_number", "a click types it; " + tip);
  left = left || ImGui::IsItemDeactivated();
  if (is_meant(number, typed, other)) value = typed, changed = true;
  if (changed) set(value);
  if (left) panel.viewer.end_drag();
}

namespace {

/// Marks ranges without a stable state (red) and events (amber) on a slider; `share_of` maps a
/// progress to a fraction of the slider.
template <class ShareOf>
void mark_slider(const Panel& panel, const char* name, const ShareOf& share_of) {
  const TextColours& colours = text_colours(panel.viewer.show.dark);
  const render::Box& box = panel.controls.at(name);
  const ImVec2 low{float(box.x), float(box.y)}, high{float(box.right()), float(box.bottom())};
  const float margin = 2 + 0.5f * ImGui::GetStyle().GrabMinSize, room = high.x - low.x - 2 * margin;
  const auto at = [&](double progress) {
    return low.x + margin + float(std::clamp(share_of(progress), 0.0, 1.0)) * room;
  };
  for (const PathMark& mark : panel.viewer.shell->marks) {
    if (mark.joint >= 0) continue;
    const float a = at(mark.from), b = at(mark.to), half = panel.px(1);
    ImGui::GetWindowDrawList()->AddRectFilled({std::min(a, b) - half, high.y - panel.px(4)},
                                              {std::max(a, b) + half, high.y},
                                              mark.unstable ? colours.error : colours.warning);
  }
}

/// The marks as text, one line each.
std::string text_of_marks(const ShellView& shell) {
  std::string text;
  const bool circle = shell.preset.footprint.kind == preset::FootprintKind::circle;
  for (const PathMark& mark : shell.marks)
    if (mark.joint < 0)
      text += fmt::format("\n{}: {}{}", mark.what, circle ? "Rₐ = " : "progress ",
                          text_of_range(
                              mark, [&](double at) { return circle ? shell.radius_at(at) : at; })) +
              (circle ? " mm" : "");
  return text;
}

void speed(const Panel& panel, float gap) {
  constexpr int seconds[] = {2, 4, 8, 16, 32};
  double& now = panel.viewer.play_speed;
  std::vector<std::string> texts;
  for (const int one : seconds) texts.push_back(fmt::format("{} s", one));
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-1);
  if (const auto k = choose("##speed", fmt::format("{:g} s", 1 / now), texts))
    now = 1.0 / seconds[*k];
  panel.named("speed", "how long the whole path plays");
}

void path(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  heading(panel, "Boundary");
  const bool push = viewer.shell->push.joint >= 0;
  const float gap = 0.5f * ImGui::GetStyle().ItemSpacing.x;
  panel.button("play", viewer.playing ? "Stop##play" : "Play##play");
  for (const char* action : {"step_back", "step_on"}) {
    ImGui::SameLine(0, gap);
    panel.button(action);
  }
  speed(panel, gap);
  float part = float(viewer.part());
  // before the push, refinement moves the joint a little; that does not count
  if (std::abs(part) < 5e-4f || (push && viewer.shell->steps.empty())) part = 0;
  ImGui::TextUnformatted(push ? "Push, of the preset's depth" : "Progress");
  if (std::exchange(viewer.take_keyboard, false)) {
    // newer versions of the library focus nothing in a window that never had the focus
    ImGui::SetWindowFocus();
    ImGui::SetKeyboardFocusHere();
  }
  slider(panel, "path", part, 0, std::max(1.f, part), "%.3f",
         push ? "fraction of the preset's depth"
              : "fraction of the boundary's displacement" + text_of_marks(*viewer.shell),
         [&](float to) { viewer.playing = false, viewer.go(to, true); });
  const double whole = std::max(1.0, viewer.part());
  if (!push) mark_slider(panel, "path", [&](double at) { return at / whole; });
}

void boundary(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  if (shell.preset.footprint.kind != preset::FootprintKind::circle) return;
  const double from = shell.preset.original_radius_mm();
  const double now = shell.frame.boundary_radius_mm;
  const double mm_per_progress = shell.progress > 0 ? (now - from) / shell.progress : -1;
  const double low = 0.6 * from, high = from + shell.least_progress * mm_per_progress;
  ImGui::TextUnformatted("Radius of the boundary, Rₐ");
  slider(panel, "R_a", float(now), float(low), float(high), "%.2f mm",
         fmt::format("radius of the actuated boundary, from {:.1f} to {:.1f} mm", low, high) +
             text_of_marks(shell),
         [&](float to) {
           viewer.playing = false,
           viewer.post(Move{(four_digits(to) - from) / mm_per_progress}, true);
         });
  mark_slider(panel, "R_a", [&](double at) { return (shell.radius_at(at) - low) / (high - low); });
}

/// A small button at the right end of a line; returns whether it was pressed.
bool small_button(const Panel& panel, const char* label, const std::string& name, const char* help,
                  double width) {
  ImGui::SameLine(ImGui::GetContentRegionMax().x - panel.px(width));
  const bool pressed = ImGui::SmallButton(fmt::format("{}##{}", label, name).c_str());
  panel.named(name, help);
  return pressed;
}

/// Lists the first edge points that were dragged off the boundary, with buttons to put them back.
void dragged_edges(const Panel& panel) {
  constexpr std::size_t most = 3;
  const auto& dragged = panel.viewer.shell->edges_dragged;
  for (std::size_t k = 0; k < std::min(most, dragged.size()); ++k) {
    const auto [edge_point, off_mm] = dragged[k];
    ImGui::Text("edge point %d  %.2f mm off", edge_point, off_mm);
    if (small_button(panel, "put back", fmt::format("put back {}", edge_point),
                     "takes this edge point back onto the boundary", 64))
      panel.viewer.send_command(ResetEdgePoint{edge_point});
  }
  if (dragged.size() < 2) return;
  ImGui::Text("%d edge points off in all", int(dragged.size()));
  if (small_button(panel, "put back", "put back all",
                   "takes every edge point back onto the boundary", 64))
    panel.viewer.send_command(ResetEdgePoint{});
}

void constraints(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  heading(panel, "Push");
  panel.tick("push_freely");
  for (const ConstrainedJoint& one : shell.constrained) {
    const record::Joint& joint = shell.layout->joints[std::size_t(one.joint)];
    ImGui::Text("(%d, %d)  %.4f N  %.2f mm", joint.i, joint.j, one.force_N.norm(),
                one.moved_mm.norm());
    if (small_button(panel, "let go", fmt::format("let go {},{}", joint.i, joint.j),
                     "takes the force off this joint", 52))
      viewer.send_command(Release{one.joint});
  }
  dragged_edges(panel);
  if (shell.constrained.empty() && shell.edges_dragged.empty())
    ImGui::TextDisabled("drag a joint or an edge point");
  panel.tick("gravity");
  ImGui::SameLine();
  panel.button("jitter");
}

void stability(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  if (viewer.shell->stable()) return;
  heading(panel, "Not stable");
  ImGui::PushStyleColor(ImGuiCol_Text, text_colours(viewer.show.dark).error);
  ImGui::TextWrapped("%d negative pivot%s: the shell would leave this state.",
                     viewer.shell->certificate.negative_pivots,
                     viewer.shell->certificate.negative_pivots == 1 ? "" : "s");
  ImGui::PopStyleColor();
  panel.button("rest_along");
  ImGui::SameLine();
  panel.button("rest_against");
  panel.tick("soft_mode");
}

void contacts(const Panel& panel) {
  const std::string touching = render::contact_caption(panel.viewer.shell->frame);
  if (touching.empty()) return;
  heading(panel, "Contact");
  ImGui::PushStyleColor(ImGuiCol_Text, text_colours(panel.viewer.show.dark).error);
  ImGui::TextWrapped("%s, where the purple marks are: the shell goes through itself or the table.",
                     touching.c_str());
  ImGui::PopStyleColor();
}

void accuracy(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  heading(panel, "Accuracy");
  preset::Preset changed = viewer.shell->preset;
  constexpr double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5};
  const auto text = [](double tolerance) { return fmt::format("tolerance {:g}", tolerance); };
  std::vector<std::string> texts;
  for (const double one : tolerances) texts.push_back(text(one));
  ImGui::SetNextItemWidth(panel.px(150));
  if (const auto k = choose("##tolerance", text(changed.accuracy.tolerance), texts)) {
    changed.accuracy.tolerance = tolerances[*k];
    changed.accuracy.edges_per_segment = 0;
    viewer.post(Change{changed}, false);
  }
  panel.named("tolerance", "largest error of a joint, over Rₒ or ρ, when nothing is dragged");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  // the net alone is geometry, which no command moves
  constexpr RodModel models[] = {RodModel::automatic, RodModel::bend, RodModel::twist};
  texts.clear();
  for (const RodModel model : models) texts.emplace_back(word_of(model));
  if (const auto k = choose("##model", std::string(word_of(changed.accuracy.model)), texts)) {
    changed.accuracy.model = models[*k];
    viewer.post(Change{changed}, false);
  }
  panel.named("model", "the model: auto takes the simplest model that is exact for the scene");
}

/// A list of the actions whose names begin with `begin`, of which exactly one is on. Returns the
/// help of that one.
const char* choose_action(const Panel& panel, const char* id, const std::string& begin) {
  std::vector<const Action*> all;
  std::vector<std::string> labels;
  const Action* now = nullptr;
  for (const Action& action : actions()) {
    if (!std::string(action.name).starts_with(begin)) continue;
    all.push_back(&action);
    labels.emplace_back(action.label);
    if (action.on(panel.viewer)) now = &action;
  }
  ImGui::SetNextItemWidth(-1);
  if (const auto k = choose(id, now->label, labels)) (now = all[*k])->act(panel.viewer);
  return now->help;
}

void colours(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  heading(panel, "Colour");
  choose_action(panel, "##colour", "colour_");
  panel.named("colour", meaning_of(viewer.show.colour_by));
  if (viewer.show.colour_by != ColourBy::none)
    panel.named("range", choose_action(panel, "##range", "range_"));
}

/// Sizes to choose from; 0: twice the view.
struct SizeChoice {
  int width, height;
};
constexpr SizeChoice sizes[] = {{0, 0}, {1280, 720}, {1920, 1080}, {3840, 2160}};

std::string size_text(const SizeChoice& size) {
  return size.width == 0 ? "twice the view" : fmt::format("{} x {}", size.width, size.height);
}

void keep(const Panel& panel) {
  ViewerState& viewer = panel.viewer;
  PictureFormat& picture = viewer.picture;
  heading(panel, "Save");
  panel.button("save_picture");
  ImGui::SameLine();
  panel.button("save_movie");
  ImGui::SetNextItemWidth(panel.px(120));
  if (ImGui::BeginCombo("##size", size_text({picture.width, picture.height}).c_str())) {
    for (const SizeChoice& size : sizes)
      if (ImGui::Selectable(size_text(size).c_str(), size.width == picture.width))
        picture.width = size.width, picture.height = size.height;
    int requested[2] = {picture.width, picture.height};
    if (ImGui::InputInt2("##asked", requested, ImGuiInputTextFlags_EnterReturnsTrue))
      viewer.size_picture(requested[0], requested[1]);
    panel.named("picture_pixels", "width and height, pixels; Enter takes them");
    ImGui::EndCombo();
  }
  panel.named("picture_size", "size of a saved picture, pixels");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  choose_word("##quality", picture.quality);
  panel.named("picture_quality",
              "of a saved picture: draft has no shadow, figure has soft light and takes seconds");
}

}  // namespace

void shell_panel(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  begin_fixed("shell", box);
  ImGui::TextWrapped("%s", viewer.shell->any()    ? viewer.shell->preset.title.c_str()
                           : viewer.engine.idle() ? "No shell yet: pick a preset."
                                                  : "The shell is being formed.");
  // in one row as far as there is space
  const float gap = 0.5f * ImGui::GetStyle().ItemSpacing.x;
  panel.button("pick_preset");
  const float right = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x +
                      0.5f * ImGui::GetStyle().WindowPadding.x;
  for (const char* action : {"undo", "redo", "numbers"}) {
    const float wide =
        ImGui::CalcTextSize(find_action(action)->label).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (ImGui::GetItemRectMax().x + gap + wide <= right) ImGui::SameLine(0, gap);
    panel.button(action);
  }
  if (viewer.shell->any()) {
    // sections that grow come last, so that nothing shifts under the mouse
    path(panel);
    boundary(panel);
    accuracy(panel);
    colours(panel);
    keep(panel);
    constraints(panel);
    stability(panel);
    contacts(panel);
    picked_figures(panel);
  }
  ImGui::End();
}

}  // namespace gridshell::window
