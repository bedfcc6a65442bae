// Marks, texts, scale bar, axes and the legend of colours over the picture of the shell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel.h"
#include "render/canvas/legend.h"
#include "render/canvas/text.h"
#include "render/gl/renderer.h"
#include "render/movie/frame_overlay.h"

namespace gridshell::window {

Eigen::Vector2d in_view(const ViewerState& viewer, const render::Box& view, int node) {
  return render::to_pixel(viewer.camera, int(view.width), int(view.height),
                          node_position(*viewer.shell, viewer.show, node)) +
         Eigen::Vector2d(view.x, view.y);
}

namespace {

constexpr ImU32 mark_colour = IM_COL32(50, 140, 240, 255);

/// Draws over one view.
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
  void write_other();
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
  void label(const std::string& text, ImVec2 at);
  float draw_length(float x, float wide, const std::string& text, ImU32 colour, bool arrow);

  const Panel& panel_;
  ViewerState& viewer_;
  const ShellView& shell_;
  render::Box view_;
  ImDrawList& list_;
  float wide_;
};

/// Marks what was picked: a ring on a joint, a rod and the point on it, the edges of a cell.
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

/// A ring around the joint or edge point under the mouse.
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

/// A text on a background next to a point; to its left if the legend is at its right, wrapped if
/// the view is narrow.
void Overlay::label(const std::string& text, ImVec2 at) {
  const float gap = panel_.px(12), room = panel_.px(3),
              legend = float(view_.right()) - panel_.px(110);
  const float most = std::max(panel_.px(120), legend - float(view_.x) - 2 * gap);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
  float left = at.x + gap;
  if (left + size.x > legend) left = std::max(float(view_.x) + gap, at.x - gap - size.x);
  const ImVec2 low{left, at.y - 1.4f * ImGui::GetTextLineHeight()};
  list_.AddRectFilled({low.x - room, low.y - room}, {low.x + size.x + room, low.y + size.y + room},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, 0.85f), room);
  list_.AddText(ImGui::GetFont(), ImGui::GetFontSize(), low, ImGui::GetColorU32(ImGuiCol_Text),
                text.c_str(), nullptr, most);
}

/// Force and displacement next to each constrained joint.
void Overlay::write_forces() {
  for (const ConstrainedJoint& one : shell_.constrained)
    label(fmt::format("{:.3g} N, {:.2f} mm", one.force_N.norm(), one.moved_mm.norm()),
          point_of(one.joint));
}

/// Writes the measured distance of two joints, or the angle at the second of three.
void Overlay::write_measure() {
  const std::vector<int>& joints = viewer_.measured;
  if (viewer_.measuring && joints.size() < 2)
    label("measuring: click on two joints, and on a third one for the angle (W ends it)",
          {float(view_.x), float(view_.y) + panel_.px(58)});
  if (joints.empty()) return;
  for (const int joint : joints) ring(joint, 9);
  line(joints, false);
  // next to what is measured, not over it
  const int right = *std::ranges::max_element(
      joints, {}, [&](int joint) { return in_view(viewer_, view_, joint).x(); });
  if (joints.size() > 1) label(text_of_measure(shell_, joints), point_of(right));
}

/// Writes the name of the other shell (green, or at the right), and the distances of joints.
void Overlay::write_other() {
  if (!viewer_.show.other) return;
  const bool side_by_side = viewer_.show.shells() > 1;
  const std::string text =
      viewer_.show.other->name + (side_by_side ? ": " : " (green): ") + viewer_.difference_text();
  const float top = float(view_.y) + panel_.px(34), right = float(view_.right());
  if (!side_by_side) return label(text, {float(view_.x), top});
  list_.AddLine({right, float(view_.y)}, {right, float(view_.bottom())},
                ImGui::GetColorU32(ImGuiCol_Border));
  const render::Box left =
      std::exchange(view_, render::Box{right, view_.y, view_.width, view_.height});
  label(text, {right, top});
  view_ = left;
  label("current", {float(view_.x), top});
}

/// Draws a length at the lower edge of the view, with a text above it; returns the position of the
/// next one.
float Overlay::draw_length(float x, float wide, const std::string& text, ImU32 colour, bool arrow) {
  const float y = float(view_.bottom()) - panel_.px(16), tall = panel_.px(4);
  const float written = ImGui::CalcTextSize(text.c_str()).x, room = std::max(wide, written);
  x += 0.5f * (room - wide);
  list_.AddLine({x, y}, {x + wide, y}, colour, panel_.px(1.6));
  if (arrow)
    list_.AddTriangleFilled({x + wide - 2 * tall, y - tall}, {x + wide, y},
                            {x + wide - 2 * tall, y + tall}, colour);
  for (const float end : {x, x + wide})
    if (!arrow) list_.AddLine({end, y - tall}, {end, y + tall}, colour, panel_.px(1.6));
  list_.AddText({x + 0.5f * (wide - written), y - panel_.px(4) - ImGui::GetTextLineHeight()},
                ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return x + 0.5f * (wide + room) + panel_.px(24);
}

/// Draws a scale bar of round length, and keys for the arrows of loads and the bars of braces. In a
/// perspective picture the lengths apply in the plane through the camera's target.
void Overlay::draw_scale() {
  const double per_px = mm_per_pixel(viewer_.camera, viewer_.view);
  const double length_mm = render::nice_ceiling(per_px * panel_.px(80));
  float x =
      draw_length(float(view_.x) + panel_.px(104), float(length_mm / per_px),
                  render::scale_bar_text(length_mm), ImGui::GetColorU32(ImGuiCol_Text), false);
  const auto ink = [](const render::Colour& c) {
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, c.a});
  };
  const record::Frame& frame = shell_.frame;
  if (viewer_.show.braces && frame.brace_force_N.size() > 0)
    x = draw_length(x, panel_.px(30), "braces", ink(render::brace_ink), false);
  const std::string sums = viewer_.show.loads ? render::load_caption(frame) : "";
  if (const auto key = arrow_key_of(shell_, viewer_.show))
    x = draw_length(x, float(key->length_mm / per_px), key->name, ink(key->colour), true);
  if (x + ImGui::CalcTextSize(sums.c_str()).x < float(view_.right()))
    list_.AddText({x, float(view_.bottom()) - panel_.px(16) - 0.5f * ImGui::GetTextLineHeight()},
                  ImGui::GetColorU32(ImGuiCol_Text), sums.c_str());
}

/// Draws the axes x, y and z; a click on an end turns the camera to look along it.
void Overlay::draw_axes() {
  struct AxisEnd {
    const char *name, *action;
    Eigen::Vector3d direction;
    ImU32 colour;
  };
  const AxisEnd ends[] = {{"x", "view_side", Eigen::Vector3d::UnitX(), IM_COL32(200, 60, 50, 255)},
                          {"y", "view_front", Eigen::Vector3d::UnitY(), IM_COL32(60, 150, 60, 255)},
                          {"z", "view_top", Eigen::Vector3d::UnitZ(), IM_COL32(60, 100, 210, 255)}};
  const render::CameraAxes axes = render::camera_axes(viewer_.camera);
  const ImVec2 centre{float(view_.x) + panel_.px(40), float(view_.bottom()) - panel_.px(62)};
  const float reach = panel_.px(24), half = panel_.px(8);
  for (const AxisEnd& end : ends) {
    const ImVec2 at{centre.x + reach * float(end.direction.dot(axes.right)),
                    centre.y - reach * float(end.direction.dot(axes.up))};
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

/// Right-aligned texts over a pale background, which is drawn last in the size of all of them.
class TextBackground {
 public:
  TextBackground(const Panel& panel, ImDrawList& list, ImVec2 corner)
      : list_(list), low_(corner), high_(corner), margin_(panel.px(6)) {
    list_.ChannelsSplit(2);
    list_.ChannelsSetCurrent(1);
  }
  ~TextBackground() {
    list_.ChannelsSetCurrent(0);
    list_.AddRectFilled({low_.x - margin_, low_.y - margin_},
                        {high_.x + margin_, high_.y + margin_},
                        ImGui::GetColorU32(ImGuiCol_WindowBg, 0.75f), margin_);
    list_.ChannelsMerge();
  }
  TextBackground(const TextBackground&) = delete;
  TextBackground& operator=(const TextBackground&) = delete;

  void text(const std::string& words, float right, float top) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    list_.AddText({right - size.x, top}, ImGui::GetColorU32(ImGuiCol_Text), words.c_str());
    low_.x = std::min(low_.x, right - size.x);
    reach(top + size.y);
  }
  void widen(float left) { low_.x = std::min(low_.x, left); }
  void reach(float bottom) { high_.y = std::max(high_.y, bottom); }

 private:
  ImDrawList& list_;
  ImVec2 low_, high_;
  float margin_;
};

void bar(const render::ColourScale& scale, ImVec2 low, ImVec2 high) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr int steps = 64;
  const float height = high.y - low.y;
  for (int k = 0; k < steps; ++k) {
    const render::Colour c = scale(scale.high - (scale.high - scale.low) * (k + 0.5) / steps);
    const auto byte = [](float v) { return int(std::lround(255 * v)); };
    list.AddRectFilled({low.x, low.y + height * float(k) / steps},
                       {high.x, low.y + height * float(k + 1) / steps},
                       IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255));
  }
  list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_TextDisabled));
}

}  // namespace

void view_overlay(const Panel& panel, const render::Box& view) {
  if (!panel.viewer.shell->any()) return;
  Overlay overlay(panel, view);
  overlay.mark_picked();
  overlay.mark_under();
  overlay.write_forces();
  overlay.write_measure();
  overlay.write_other();
  overlay.draw_scale();
  overlay.draw_axes();
}

// The legend of the colours, at the right edge of the view.

/// An end of the range of colours, next to the bar, which can be dragged or typed; returns the
/// width of the control.
float range_end(const Panel& panel, const char* name, float left, float top) {
  ViewerState& viewer = panel.viewer;
  const bool is_high = std::string(name) == "range_high";
  float low = float(viewer.show.scale.low), high = float(viewer.show.scale.high);
  float& end = is_high ? high : low;
  const float width = ImGui::CalcTextSize(fmt::format("{:.4g}", end).c_str()).x + panel.px(8);
  ImGui::SetCursorScreenPos({left - panel.px(1) - width, top});
  ImGui::SetNextItemWidth(width);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {panel.px(4), 0});
  ImGui::PushStyleColor(ImGuiCol_FrameBg, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0);
  const float step = 0.005f * std::max(1e-6f, high - low);
  if (ImGui::DragFloat((std::string("##") + name).c_str(), &end, step, 0, 0, "%.4g"))
    viewer.set_range(double(low), double(high));
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
  panel.named(name, is_high ? "the high end of the colours; Ctrl+click to type"
                            : "the low end of the colours; Ctrl+click to type");
  return width;
}

void colour_legend(const Panel& panel, const render::Box& view) {
  ViewerState& viewer = panel.viewer;
  if (!viewer.shell->any() || viewer.show.colour_by == ColourBy::none) return;
  const float line = ImGui::GetTextLineHeight(), width = panel.px(14);
  // in a low view the bar is shorter, so that the texts below it have room
  const float height = std::min(panel.px(170), std::max(2 * line, float(view.height) - 8 * line));
  const float right = float(view.right()) - panel.px(14), top = float(view.y) + panel.px(14);
  TextBackground background(panel, *ImGui::GetWindowDrawList(), {right, top});
  background.text(label_of(*viewer.shell, viewer.show), right, top);
  const Eigen::VectorXd values = values_of(*viewer.shell, viewer.show);
  if (values.size() == 0)
    return background.text("not known for this shell", right, top + 1.3f * line);
  const render::ColourScale& scale = viewer.show.scale;
  const float low = top + 1.6f * line, left = right - width;
  bar(scale, {left, low}, {right, low + height});
  background.reach(low + height);
  const float apart = 1.2f * line / height;  // least distance of two texts, over that of the bar
  for (const render::Tick& tick : render::linear_ticks(scale.low, scale.high, 4)) {
    const auto down = float((scale.high - tick.value) / (scale.high - scale.low));
    if (tick.major && down > apart && down < 1 - apart)
      background.text(fmt::format("{:.6g}", tick.value), left - panel.px(5),
                      low + height * down - 0.5f * line);
  }
  background.widen(left - panel.px(5) - range_end(panel, "range_high", left, low - 0.5f * line));
  range_end(panel, "range_low", left, low + height - 0.5f * line);
  // the end colours also show all values outside the range
  const double slack = 1e-9 * (scale.high - scale.low);
  float note = low + height + 0.8f * line;
  if (values.maxCoeff() > scale.high + slack) {
    background.text(fmt::format("up to {:.3g}", values.maxCoeff()), right, note);
    note += 1.2f * line;
  }
  if (values.minCoeff() < scale.low - slack) {
    background.text(fmt::format("down to {:.3g}", values.minCoeff()), right, note);
    note += 1.2f * line;
  }
  const bool fixed = viewer.range_of == RangeOf::hand;
  const char* word = fixed ? "fixed" : "fix";
  const float wide = ImGui::CalcTextSize(word).x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetCursorScreenPos({right - wide, note});
  if (ImGui::SmallButton(word)) find_action(fixed ? "range_run" : "range_hand")->act(viewer);
  panel.named("range_fixed", fixed ? "lets the range widen with what is seen again"
                                   : "keeps the colours' range as it is now");
  background.reach(note + line);
}

}  // namespace gridshell::window
