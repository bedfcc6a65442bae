// The bottom of the window: the timeline of steps, the states that were found, the certificate of
// the state, and messages.
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
                 ? fmt::format("boundary to Rₐ = {:.4g} mm", shell.frame.boundary_radius_mm)
                 : fmt::format("boundary to progress {:.3g}", step.progress);
    case preset::StepKind::push:
      return shell.constrained.empty() ? "pushed" + at
                                       : fmt::format("pushed{}: {:.3g} mm, {:.3g} N", at,
                                                     shell.constrained.back().moved_mm.norm(),
                                                     shell.constrained.back().force_N.norm());
    case preset::StepKind::hold:
    case preset::StepKind::release:
    case preset::StepKind::load:
    case preset::StepKind::rest:
    case preset::StepKind::jitter:
    case preset::StepKind::tighten:
    case preset::StepKind::brace:
    case preset::StepKind::open:
      return std::string(word_of(step.kind)) + at;
  }
  return "";
}

std::string text_of_error(const Certificate& certificate) {
  if (!std::isfinite(certificate.error_estimate_mm))
    return "The error of the joints' positions is not known: it is estimated from what finer "
           "meshes change, and this state is computed on one mesh.";
  return fmt::format(
      "The positions of the joints are known to {:.2g} mm, from what finer meshes change.",
      certificate.error_estimate_mm);
}

void ViewerState::go_to_step(int step) {
  const int now = shell->undo_steps, all = now + shell->redo_steps;
  if (step == now && step > 0 && !timeline[std::size_t(step)].event.empty()) --step;
  for (int k = std::clamp(step, 0, all); k < now; ++k) send_command(Undo{});
  for (int k = now; k < std::clamp(step, 0, all); ++k) send_command(Redo{});
}

int ViewerState::current_state() const {
  if (!shell->found) return -1;
  const auto& all = *shell->found;
  const auto at = std::ranges::find_if(all, [&](const auto& one) {
    return std::abs(one->frame.energies.total() - shell->frame.energies.total()) <
               1e-4 * one->frame.energies.total() &&
           one->frame.nodes.cols() == shell->frame.nodes.cols() &&
           (one->frame.nodes - shell->frame.nodes).cwiseAbs().maxCoeff() <
               1e-4 * shell->layout->length_scale_mm;
  });
  return at == all.end() ? -1 : int(at - all.begin());
}

void ViewerState::recall(int state) {
  const int count = int(shell->found->size());
  send_command(Recall{(state % count + count) % count});
}

void ViewerState::go_to_loss() {
  if (shell->push.joint >= 0 && shell->preset.footprint.kind != preset::FootprintKind::circle)
    return say("the boundary of this shell stays: it is a push that is followed", true);
  std::vector<double> losses;
  for (const PathMark& mark : shell->marks) {
    if (mark.joint >= 0 || !mark.unstable) continue;
    if (!shell->stable() && mark.from <= shell->progress && shell->progress <= mark.to)
      return say("the shell is on the part of its path that is not stable", true);
    losses.push_back(0.5 * (mark.from + mark.to));
  }
  if (losses.empty())
    return say(shell->path_left.empty()
                   ? "every state computed on the boundary's path is stable"
                   : "the path on which stability is lost was left by " + shell->path_left +
                         ", and the one since then is stable; Undo goes back to it",
               true);
  std::ranges::sort(losses);
  const auto next =
      std::ranges::find_if(losses, [&](double at) { return at > shell->progress + 1e-6; });
  play(false);
  post(Move{next == losses.end() ? losses.front() : *next}, false);
}

void ViewerState::note_step() {
  timeline.resize(std::max(timeline.size(), std::size_t(shell->undo_steps) + 1));
  TimelineEntry& entry = timeline[std::size_t(shell->undo_steps)];
  const auto& steps = shell->steps;
  const bool still =
      entry.event_at ? std::ranges::find(steps, entry.event_at) != steps.end() : steps.empty();
  entry.text = text_of_step(*shell);
  entry.stable = shell->stable();
  if (!shell->event.empty()) {
    entry.event = shell->event;
    entry.event_at = steps.empty() ? nullptr : steps.back();
  } else if (!still) {
    entry.event.clear();
  }
  timeline.resize(std::size_t(shell->undo_steps + shell->redo_steps) + 1);
}

namespace {

/// Draws pictures of the states that were found at the right end of the strip; returns the width
/// that is left.
double state_pictures(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  if (panel.states.empty()) return box.width;
  const float high = float(box.height) - panel.px(6), wide = 1.6f * high, gap = panel.px(4);
  const int count = int(panel.states.size()), now = viewer.current_state();
  // if not all have room, those next to the current one
  const int most = std::max(1, int(0.5f * float(box.width) / (wide + gap)));
  const int first = std::clamp(now - most / 2, 0, std::max(0, count - most));
  const int shown = std::min(most, count - first);
  float x = float(box.right()) - panel.px(10) - float(shown) * (wide + gap);
  const double left = double(x) - box.x;
  for (int k = first; k < first + shown; ++k, x += wide + gap) {
    const ImVec2 low{x, float(box.y) + panel.px(3)}, corner{x + wide, low.y + high};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(panel.states[std::size_t(k)], low, corner);
    list.AddRect(low, corner, ImGui::GetColorU32(k == now ? ImGuiCol_PlotLines : ImGuiCol_Border),
                 0, 0, panel.px(k == now ? 2 : 1));
    ImGui::SetCursorScreenPos(low);
    ImGui::PushID(k);
    const ShellView& state = *(*viewer.shell->found)[std::size_t(k)];
    if (ImGui::InvisibleButton("state", {wide, high})) viewer.recall(k);
    if (ImGui::BeginPopupContextItem("beside")) {
      if (ImGui::MenuItem("Compare with this state"))
        viewer.compare(std::make_shared<const OtherShell>(
            OtherShell{fmt::format("state {}", k + 1), (*viewer.shell->found)[std::size_t(k)]}));
      panel.named(fmt::format("state {} compare", k + 1), "");
      ImGui::EndPopup();
    }
    ImGui::PopID();
    panel.named(fmt::format("state {}", k + 1),
                fmt::format("state {}: {}{}{:.5g} mJ, {:.4g} mm high; a click goes there, a right "
                            "click compares with it",
                            k + 1, state.symmetry, state.symmetry.empty() ? "" : ", ",
                            state.frame.energies.total(), state.frame.height_mm));
  }
  return left;
}

void step_point(const Panel& panel, int k, ImVec2 at) {
  const ViewerState& viewer = panel.viewer;
  const TimelineEntry& entry = viewer.timeline[std::size_t(k)];
  const TextColours& colours = text_colours(viewer.show.dark);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const int now = viewer.shell->undo_steps;
  const ImU32 colour = !entry.stable          ? colours.error
                       : !entry.event.empty() ? colours.warning
                                              : ImGui::GetColorU32(ImGuiCol_PlotLines);
  const float radius = panel.px(entry.event.empty() ? 4 : 6);
  // undone steps are hollow
  if (k > now)
    list.AddCircle(at, radius, colour, 0, panel.px(1.4));
  else
    list.AddCircleFilled(at, radius, colour);
  if (k == now)
    list.AddCircle(at, panel.px(9), ImGui::GetColorU32(ImGuiCol_Text), 0, panel.px(1.4));
}

/// "8 and 16 edges per segment".
std::string meshes_of(const std::vector<int>& meshes) {
  std::string text;
  for (std::size_t k = 0; k < meshes.size(); ++k)
    text += fmt::format("{}{}", k == 0 ? "" : k + 1 < meshes.size() ? ", " : " and ", meshes[k]);
  return text + " edges per segment";
}

/// Text of the certificate; in a narrow window only the error.
std::string certificate_of(const ShellView& shell, bool timed, bool narrow) {
  const Certificate& c = shell.certificate;
  const std::string error = std::isfinite(c.error_estimate_mm)
                                ? fmt::format("error ± {:.2g} mm", c.error_estimate_mm)
                                : "error not known";
  if (narrow) return error;
  const std::string took = timed ? fmt::format("   {:.0f} ms", 1000 * shell.seconds) : "";
  return fmt::format("{} ({})   residual {:.0e} N{}", error, meshes_of(shell.meshes), c.residual_N,
                     took);
}

std::string design_progress(const DesignProgress& design) {
  const double percent = 100 / design.length_scale_mm;
  const DesignPoint& now = design.points.back();
  return fmt::format("designing: iteration {}, largest {:.3f} %, mean {:.3f} % (Esc stops)",
                     design.iterations, percent * now.max_mm, percent * now.mean_mm);
}

/// Writes the progress of the movie over the last message.
void draw_movie_progress(const Panel& panel) {
  const std::string text = panel.viewer.movie_task.progress_text();
  const std::string line = "movie " + (text.empty() ? "0 %" : text);
  const char* stop = find_action("stop_movie")->label;
  const float width = ImGui::CalcTextSize(line.c_str()).x + ImGui::CalcTextSize(stop).x +
                      3 * ImGui::GetStyle().FramePadding.x + panel.px(18);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled({low.x - panel.px(8), low.y},
                                            {low.x + width, low.y + ImGui::GetFrameHeight()},
                                            ImGui::GetColorU32(ImGuiCol_WindowBg));
  ImGui::TextUnformatted(line.c_str());
  ImGui::SameLine(0, panel.px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {panel.px(6), 0});
  panel.button("stop_movie");
  ImGui::PopStyleVar();
}

}  // namespace

void timeline_panel(const Panel& panel, const render::Box& box) {
  ViewerState& viewer = panel.viewer;
  begin_fixed("timeline", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float wide = float(state_pictures(panel, box));
  const int count = int(viewer.timeline.size());
  const float left = float(box.x) + panel.px(16), y = float(box.y + 0.5 * box.height);
  const float step = std::min(panel.px(46), (wide - panel.px(32)) / float(std::max(1, count)));
  list.AddLine({left, y}, {left + step * float(std::max(0, count - 1)), y},
               text_colours(viewer.show.dark).muted, panel.px(1.4));
  for (int k = 0; k < count; ++k) {
    const TimelineEntry& entry = viewer.timeline[std::size_t(k)];
    const ImVec2 at{left + step * float(k), y};
    step_point(panel, k, at);
    const float half = 0.5f * std::min(step, panel.px(20));
    ImGui::SetCursorScreenPos({at.x - half, float(box.y) + panel.px(2)});
    ImGui::PushID(k);
    if (ImGui::InvisibleButton("step", {2 * half, float(box.height) - panel.px(4)}) &&
        viewer.engine.idle())
      viewer.go_to_step(k);
    // a drag along the strip goes to the step under the mouse
    const int under = int(std::lround((ImGui::GetIO().MousePos.x - left) / step));
    const int there = std::clamp(under, 0, count - 1);
    if (ImGui::IsItemActive() && there != k && there != viewer.shell->undo_steps &&
        viewer.engine.idle())
      viewer.go_to_step(there);
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
        "This equilibrium is not stable: along %d direction%s the energy falls "
        "(negative pivots of the Hessian with the constraints). The lowest mode shows the "
        "steepest.",
        shell.certificate.negative_pivots, shell.certificate.negative_pivots == 1 ? "" : "s");
    panel.tick("soft_mode");
    panel.button("rest_along");
    ImGui::SameLine();
    panel.button("rest_against");
  } else if (!shell.accuracy_warning.empty()) {
    ImGui::TextWrapped(
        "Every small displacement raises the energy, but the state is %s. A shell is first "
        "certified on the coarsest mesh; the finer ones did not reach the same state as closely as "
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
        "Every small displacement raises the energy: the Hessian with the constraints is positive "
        "definite. The residual force on a node is at most %.0e N. %s",
        shell.certificate.residual_N, text_of_error(shell.certificate).c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndPopup();
}

/// Shows an error that is too long for the line in full, and a button for a preset that works.
void notice(const Panel& panel, const render::Box& line, float room) {
  ViewerState& viewer = panel.viewer;
  const auto& offer = viewer.shell->offer;
  const bool fits = ImGui::CalcTextSize(viewer.message.c_str()).x <= room;
  if (!viewer.message_bad || viewer.file_request || (fits && !offer)) return;
  // above the row of the scale bar
  ImGui::SetNextWindowPos({float(line.middle().x), float(line.y) - panel.px(76)}, ImGuiCond_Always,
                          {0.5f, 1});
  ImGui::Begin("notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(panel.px(520));
  ImGui::PushStyleColor(ImGuiCol_Text, text_colours(viewer.show.dark).error);
  ImGui::TextWrapped("%s", viewer.message.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  if (offer) {
    const std::string text = fmt::format("Rₒ = {:.4g} mm, Rₐ = {:.4g} mm: do it",
                                         offer->original_radius_mm(), offer->actuated_radius_mm());
    if (ImGui::Button(text.c_str())) viewer.post(Change{*offer}, false);
    panel.named("offer", "the nearest shell that works");
    ImGui::SameLine();
  }
  if (ImGui::Button("Close")) viewer.say("");
  panel.named("close_notice", "");
  ImGui::End();
}

// The status line: certificate of the state, and the progress of the engine or the last message.

void status_line(const Panel& panel, const render::Box& box) {
  const ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  const TextColours& colours = text_colours(viewer.show.dark);
  begin_fixed("status", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (shell.any()) {
    const ImU32 colour = !shell.stable()                  ? colours.error
                         : shell.accuracy_warning.empty() ? colours.ok
                                                          : colours.warning;
    const std::string lacks = shell.accuracy_warning.empty() ? "" : ", " + shell.accuracy_warning;
    coloured_text(colour, (shell.stable() ? "● stable" : "● not stable") + lacks);
    if (ImGui::IsItemClicked()) ImGui::OpenPopup("why");
    panel.named("stability", "whether the state is stable; a click says why");
    why_popup(panel);
    const bool narrow = box.width < 900 * panel.density;
    if (!shell.symmetry.empty() && !narrow) {
      ImGui::SameLine(0, panel.px(14));
      ImGui::TextUnformatted(shell.symmetry.c_str());
      panel.named("symmetry", "symmetries of the square that leave this shape as it is");
    }
    ImGui::SameLine(0, panel.px(14));
    ImGui::TextUnformatted(certificate_of(shell, viewer.timed, narrow).c_str());
    panel.named("certificate", certificate_of(shell, viewer.timed, false) +
                                   ": estimated error of the joints, from the meshes named; "
                                   "largest residual force; time of the last equilibrium");
    ImGui::SameLine(0, panel.px(18));
  }
  const double busy = viewer.engine.busy_seconds();
  std::string text =
      busy > 0.3 ? fmt::format("solving for {:.1f} s (Esc stops)", busy) : viewer.message;
  if (shell.designing()) text = design_progress(*shell.design);
  const bool bad = busy <= 0.3 && viewer.message_bad && !shell.designing();
  // only the first line; the tooltip has the complete message
  coloured_text(bad ? colours.error : ImGui::GetColorU32(ImGuiCol_TextDisabled),
                text.substr(0, text.find('\n')));
  panel.named("message", text);
  const float room = float(box.right()) - ImGui::GetItemRectMin().x - panel.px(10);
  if (viewer.movie_task.under_way()) draw_movie_progress(panel);
  ImGui::End();
  if (bad) notice(panel, box, room);
}

}  // namespace gridshell::window
