// What was done to the shell, step by step along the bottom, to go back to; and why a state is
// what its certificate says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel.h"

namespace gridshell::window {

std::string text_of_step(const ShellView& shell) {
  if (shell.steps.empty()) return "formed";
  const preset::Step& step = *shell.steps.back();
  const std::string at =
      step.joint.size() > 1 ? fmt::format(" ({}, {})", step.joint[0], step.joint[1]) : "";
  switch (step.kind) {
    case preset::StepKind::move:
      return std::isfinite(shell.frame.boundary_radius_mm)
                 ? fmt::format("boundary to R_a = {:.4g} mm", shell.frame.boundary_radius_mm)
                 : fmt::format("boundary to progress {:.3g}", step.progress);
    case preset::StepKind::push:
      return shell.held.empty() ? "pushed" + at
                                : fmt::format("pushed{}: {:.3g} mm, {:.3g} N", at,
                                              shell.held.back().moved_mm.norm(),
                                              shell.held.back().force_N.norm());
    case preset::StepKind::hold:
    case preset::StepKind::release:
    case preset::StepKind::load:
    case preset::StepKind::rest:
    case preset::StepKind::jitter:
      return std::string(word_of(step.kind)) + at;
  }
  return "";
}

void ViewerState::go_to_step(int step) {
  const int now = shell->undo_steps, all = now + shell->redo_steps;
  for (int k = std::clamp(step, 0, all); k < now; ++k) send_command(Undo{});
  for (int k = now; k < std::clamp(step, 0, all); ++k) send_command(Redo{});
}

void ViewerState::note_step() {
  timeline.resize(std::max(timeline.size(), std::size_t(shell->undo_steps) + 1));
  TimelineEntry& entry = timeline[std::size_t(shell->undo_steps)];
  const auto& steps = shell->steps;
  const bool still = entry.event_at ? std::ranges::find(steps, entry.event_at) != steps.end()
                                    : steps.empty();
  entry.text = text_of_step(*shell);
  entry.stable = shell->stable();
  if (!shell->message.empty()) {
    entry.event = shell->message;
    entry.event_at = steps.empty() ? nullptr : steps.back();
  } else if (!still) {
    entry.event.clear();
  }
  timeline.resize(std::size_t(shell->undo_steps + shell->redo_steps) + 1);
}

void timeline_panel(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  begin_fixed("timeline", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const TextColours& colours = text_colours(viewer.show.dark);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const int count = int(viewer.timeline.size()), now = shell.undo_steps;
  const float left = float(box.x) + panel.px(16), y = float(box.y + 0.5 * box.height);
  const float step = std::min(panel.px(46), (float(box.width) - panel.px(32)) / float(count));
  list.AddLine({left, y}, {left + step * float(count - 1), y}, colours.muted, panel.px(1.4));
  for (int k = 0; k < count; ++k) {
    const TimelineEntry& entry = viewer.timeline[std::size_t(k)];
    const ImVec2 at{left + step * float(k), y};
    const ImU32 colour = !entry.stable            ? colours.error
                         : !entry.event.empty()   ? colours.warning
                                                  : ImGui::GetColorU32(ImGuiCol_PlotLines);
    const float radius = panel.px(entry.event.empty() ? 4 : 6);
    // what was undone is hollow
    if (k > now)
      list.AddCircle(at, radius, colour, 0, panel.px(1.4));
    else
      list.AddCircleFilled(at, radius, colour);
    if (k == now)
      list.AddCircle(at, panel.px(9), ImGui::GetColorU32(ImGuiCol_Text), 0, panel.px(1.4));
    const float half = 0.5f * std::min(step, panel.px(20));
    ImGui::SetCursorScreenPos({at.x - half, float(box.y) + panel.px(2)});
    ImGui::PushID(k);
    if (ImGui::InvisibleButton("step", {2 * half, float(box.height) - panel.px(4)}))
      viewer.go_to_step(k);
    ImGui::PopID();
    panel.named(fmt::format("step {}", k),
                fmt::format("{}{}{}{}", entry.text, entry.event.empty() ? "" : "; ", entry.event,
                            entry.stable ? "" : "; not stable"));
  }
  ImGui::End();
}

void why_popup(const Panel& panel) {
  if (!ImGui::BeginPopup("why")) return;
  const ShellView& shell = *panel.viewer.shell;
  ImGui::PushTextWrapPos(panel.px(420));
  if (!shell.stable()) {
    ImGui::TextWrapped(
        "This is an equilibrium that no shell stays in: along %d direction%s the energy falls "
        "(negative pivots of the Hessian with what is held held). The soft mode shows the steepest.",
        shell.certificate.negative_pivots, shell.certificate.negative_pivots == 1 ? "" : "s");
    panel.tick("soft_mode");
    panel.button("rest_along");
    ImGui::SameLine();
    panel.button("rest_against");
  } else if (!shell.accuracy_warning.empty()) {
    ImGui::TextWrapped(
        "Every small move raises the energy, but the state is %s. A hand-held shell is certified "
        "on the coarsest mesh first; the finer ones did not come to the same state as closely as "
        "the tolerance asks for. A smaller tolerance takes finer meshes.",
        shell.accuracy_warning.c_str());
    if (ImGui::Button("Ten times finer")) {
      preset::Preset finer = shell.preset;
      finer.accuracy.tolerance /= 10;
      panel.viewer.post(Change{finer}, false);
    }
    panel.named("finer", "a tenth of the tolerance");
  } else {
    ImGui::TextWrapped(
        "Every small move raises the energy: the Hessian is positive definite with what is held "
        "held. No node feels more than %.0e N that nothing holds. Where the joints are is known to "
        "%.2g mm, from what finer meshes change.",
        shell.certificate.residual_N, shell.certificate.error_estimate_mm);
  }
  ImGui::PopTextWrapPos();
  ImGui::EndPopup();
}

}  // namespace gridshell::window
