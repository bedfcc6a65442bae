// What is written and drawn over the picture of the shell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel.h"
#include "render/canvas/text.h"
#include "render/gl/renderer.h"

namespace gridshell::window {

Eigen::Vector2d in_view(const ViewerState& viewer, const render::Box& view, int node) {
  return render::to_pixel(viewer.camera, int(view.width), int(view.height),
                          place_of(*viewer.shell, viewer.show, node)) +
         Eigen::Vector2d(view.x, view.y);
}

namespace {

constexpr ImU32 mark_colour = IM_COL32(50, 140, 240, 255);

/// What is drawn over one view.
class Overlay {
 public:
  Overlay(const Panel& panel, const render::Box& view)
      : panel_(panel),
        viewer_(panel.viewer),
        shell_(*panel.viewer.shell),
        view_(view),
        list_(*ImGui::GetWindowDrawList()),
        wide_(panel.px(2.2)) {}

  void mark_picked();
  void mark_under();
  void write_forces();
  void write_measure();
  void tell_other();
  void draw_scale();
  void draw_axes();

 private:
  ImVec2 point_of(int node) const {
    const Eigen::Vector2d at = in_view(viewer_, view_, node);
    return {float(at.x()), float(at.y())};
  }
  void line(const std::vector<int>& nodes, bool closed) {
    for (const int node : nodes) list_.PathLineTo(point_of(node));
    list_.PathStroke(mark_colour, closed, wide_);
  }
  void ring(int node, double points) {
    list_.AddCircle(point_of(node), panel_.px(points), mark_colour, 0, wide_);
  }
  void label(const std::string& text, ImVec2 beside);

  const Panel& panel_;
  ViewerState& viewer_;
  const ShellView& shell_;
  const render::Box& view_;
  ImDrawList& list_;
  float wide_;
};

/// What the panel shows the figures of: a ring on a joint, a rod and the point on it, a cell's
/// edge.
void Overlay::mark_picked() {
  const record::Layout& layout = *shell_.layout;
  if (viewer_.picked_joint >= 0 && viewer_.picked_joint < int(layout.joints.size()))
    ring(viewer_.picked_joint, 9);
  if (const auto [rod, point] = viewer_.picked_rod; rod >= 0 && rod < int(layout.rods.size())) {
    const std::vector<int>& nodes = layout.rods[std::size_t(rod)];
    line(nodes, false);
    ring(nodes[std::min(std::size_t(point), nodes.size() - 1)], 5);
  }
  if (viewer_.picked_cell >= 0 && viewer_.picked_cell < int(layout.cells.size())) {
    const auto& joints = layout.cells[std::size_t(viewer_.picked_cell)].joints;
    line({joints.begin(), joints.end()}, true);
  }
}

/// A ring around the joint or edge point that the mouse would take.
void Overlay::mark_under() {
  const record::Layout& layout = *shell_.layout;
  const int joint = viewer_.joint_under, edge = viewer_.edge_under;
  if (joint >= 0 && joint < int(layout.joints.size())) {
    const record::Joint& under = layout.joints[std::size_t(joint)];
    label(fmt::format("({}, {})", under.i, under.j), point_of(joint));
    return ring(joint, 7);
  }
  if (edge >= 0 && edge < int(layout.edge_points.size()))
    ring(layout.edge_points[std::size_t(edge)], 7);
}

/// A text on a ground of its own beside a point; to its left where the legend stands.
void Overlay::label(const std::string& text, ImVec2 at) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float beside = panel_.px(12), room = panel_.px(3);
  const bool left = at.x + beside + size.x > float(view_.right()) - panel_.px(110);
  const ImVec2 low{left ? at.x - beside - size.x : at.x + beside, at.y - 1.4f * size.y};
  list_.AddRectFilled({low.x - room, low.y - room}, {low.x + size.x + room, low.y + size.y + room},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, 0.85f), room);
  list_.AddText(low, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

/// Force and way beside each joint that is held.
void Overlay::write_forces() {
  for (const HeldJoint& held : shell_.held)
    label(fmt::format("{:.3g} N, {:.2f} mm", held.force_N.norm(), held.moved_mm.norm()),
          point_of(held.joint));
}

/// Between two joints their distance, at the second of three the angle.
void Overlay::write_measure() {
  const std::vector<int>& joints = viewer_.measured;
  if (viewer_.measuring && joints.size() < 2)
    label("measuring: click on two joints, and on a third one for the angle (W ends it)",
          {float(view_.x), float(view_.y) + panel_.px(58)});
  if (joints.empty()) return;
  for (const int joint : joints) ring(joint, 9);
  line(joints, false);
  // beside what is measured, not over it
  const int right = *std::ranges::max_element(
      joints, {}, [&](int joint) { return in_view(viewer_, view_, joint).x(); });
  if (joints.size() > 1) label(text_of_measure(shell_, joints), point_of(right));
}

/// What the green rods are, and how far the joints are from theirs.
void Overlay::tell_other() {
  if (!viewer_.show.other) return;
  const std::string text = viewer_.show.other->name + " (green): " + viewer_.difference_text();
  label(text, {float(view_.x), float(view_.y) + panel_.px(34)});
}

/// A round length of some hundred pixels; of a picture in perspective it holds in the
/// plane that the camera looks at.
void Overlay::draw_scale() {
  const double per_px = mm_per_pixel(viewer_.camera, viewer_.view);
  const double length_mm = render::nice_ceiling(per_px * panel_.px(80));
  const auto wide = float(length_mm / per_px), tall = panel_.px(4);
  const float x = float(view_.x) + panel_.px(104), y = float(view_.bottom()) - panel_.px(16);
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
  list_.AddLine({x, y}, {x + wide, y}, colour, panel_.px(1.6));
  for (const float end : {x, x + wide})
    list_.AddLine({end, y - tall}, {end, y + tall}, colour, panel_.px(1.6));
  const std::string text = fmt::format("{:g} mm", length_mm);
  list_.AddText({x + 0.5f * (wide - ImGui::CalcTextSize(text.c_str()).x),
                 y - panel_.px(4) - ImGui::GetTextLineHeight()},
                colour, text.c_str());
}

/// x, y and z from where the camera looks; a click on an end looks along it.
void Overlay::draw_axes() {
  struct AxisEnd {
    const char *name, *action;
    Eigen::Vector3d way;
    ImU32 colour;
  };
  const AxisEnd ends[] = {{"x", "view_side", Eigen::Vector3d::UnitX(), IM_COL32(200, 60, 50, 255)},
                          {"y", "view_front", Eigen::Vector3d::UnitY(), IM_COL32(60, 150, 60, 255)},
                          {"z", "view_top", Eigen::Vector3d::UnitZ(), IM_COL32(60, 100, 210, 255)}};
  const render::CameraAxes axes = render::camera_axes(viewer_.camera);
  const ImVec2 centre{float(view_.x) + panel_.px(40), float(view_.bottom()) - panel_.px(62)};
  const float reach = panel_.px(24), half = panel_.px(8);
  for (const AxisEnd& end : ends) {
    const ImVec2 at{centre.x + reach * float(end.way.dot(axes.right)),
                    centre.y - reach * float(end.way.dot(axes.up))};
    list_.AddLine(centre, at, end.colour, panel_.px(1.6));
    list_.AddCircleFilled(at, half, end.colour);
    const ImVec2 size = ImGui::CalcTextSize(end.name);
    list_.AddText({at.x - 0.5f * size.x, at.y - 0.5f * size.y}, IM_COL32_WHITE, end.name);
    ImGui::SetCursorScreenPos({at.x - half, at.y - half});
    if (ImGui::InvisibleButton(end.name, {2 * half, 2 * half}))
      find_action(end.action)->act(viewer_);
    panel_.named(std::string("axis ") + end.name, help_of(*find_action(end.action)));
  }
  const bool parallel = find_action("orthographic")->on(viewer_);
  ImGui::SetCursorScreenPos({float(view_.x) + panel_.px(6), float(view_.bottom()) - panel_.px(24)});
  if (ImGui::SmallButton(parallel ? "parallel" : "perspective"))
    find_action("orthographic")->act(viewer_);
  panel_.named("projection", help_of(*find_action("orthographic")));
}

}  // namespace

void view_overlay(const Panel& panel, const render::Box& view) {
  if (!panel.viewer.shell->any()) return;
  Overlay overlay(panel, view);
  overlay.mark_picked();
  overlay.mark_under();
  overlay.write_forces();
  overlay.write_measure();
  overlay.tell_other();
  overlay.draw_scale();
  overlay.draw_axes();
}

}  // namespace gridshell::window
