#include "app/window/actions.h"

#include <algorithm>
#include <cmath>

#include "app/window/shell_drawing.h"
#include "render/gl/renderer.h"
#include "render/movie/run_summary.h"

namespace gridshell::window {
namespace {

constexpr double near_px = 12;        // at 1280 x 720, to a joint or an edge point
constexpr double rod_px = 5;          // to a rod
constexpr double bulge_spacings = 3;  // depth, in spacings d, below which edge points are covered
constexpr double click_px = 3;        // a press that moves less is a click

/// The position of the point of a segment that is nearest to `at`, as a fraction, 0 to 1.
double fraction_along(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                      const Eigen::Vector2d& at) {
  const Eigen::Vector2d segment = to - from;
  return std::clamp((at - from).dot(segment) / std::max(segment.squaredNorm(), 1e-12), 0.0, 1.0);
}

}  // namespace

Eigen::Vector2d Picker::pixel_of(int node) const {
  return render::to_pixel(viewer_.camera, int(viewer_.view.width), int(viewer_.view.height),
                          node_position(*viewer_.shell, viewer_.show, node));
}

/// Finds the joint or edge point under the mouse; of several near ones that nearest to the camera.
void Picker::find(double x, double y) {
  joint_ = edge_ = -1;
  // the shell at the right, if there are two, cannot be edited
  if (!viewer_.shell->any() || x > viewer_.view.width) return;
  const record::Layout& layout = *viewer_.shell->layout;
  const Eigen::Vector3d forward = render::camera_axes(viewer_.camera).forward;
  const double within = near_px * std::max(1.0, viewer_.view.height / 720);
  double best = 1e300;
  const bool cells_shown = render::of_cells(viewer_.show.colour_by) &&
                           values_of(*viewer_.shell, viewer_.show).size() > 0;
  const auto score = [&](int node, double through_mm) {
    const double off = (pixel_of(node) - Eigen::Vector2d(x, y)).norm();
    if (off > within || (cells_shown && is_covered(node, through_mm))) return 1e300;
    const double depth = forward.dot(viewer_.shell->frame.nodes.col(node));
    return off + 0.05 * depth / mm_per_pixel(viewer_.camera, viewer_.view);
  };
  // a shell that bulges hides its boundary from above, but the user may want to drag that
  const double under_mm = bulge_spacings * layout.spacing_mm;
  for (int k = 0; k < int(layout.joints.size()); ++k)
    if (const double s = score(k, 0); s < best) best = s, joint_ = k;
  for (int k = 0; k < int(layout.edge_points.size()); ++k)
    if (const double s = score(layout.edge_points[std::size_t(k)], under_mm); s < best)
      best = s, joint_ = -1, edge_ = k;
}

/// Whether a cell covers a node: all of it is nearer to the camera by more than `by_mm`.
bool Picker::is_covered(int node, double by_mm) const {
  const Eigen::Vector2d at = pixel_of(node);
  const int cell = cell_at(at.x(), at.y());
  if (cell < 0) return false;
  const record::Layout& layout = *viewer_.shell->layout;
  const auto& joints = layout.cells[std::size_t(cell)].joints;
  if (std::ranges::find(joints, node) != joints.end()) return false;
  const Eigen::Vector3d forward = render::camera_axes(viewer_.camera).forward;
  double depth = -1e300;
  for (const int joint : joints)
    depth = std::max(depth, forward.dot(viewer_.shell->frame.nodes.col(joint)));
  return depth + by_mm < forward.dot(viewer_.shell->frame.nodes.col(node));
}

void Picker::hover(double x, double y) {
  if (pressed_) return;
  find(x, y);
  viewer_.joint_under = joint_;
  viewer_.edge_under = edge_;
}

void Picker::leave() {
  if (pressed_) return;
  joint_ = edge_ = viewer_.joint_under = viewer_.edge_under = -1;
}

void Picker::press(Button button, bool shift, double x, double y) {
  if (pressed_) return;
  find(x, y);
  const Over over = joint_ >= 0 ? Over::joint : edge_ >= 0 ? Over::edge_point : Over::nothing;
  gesture_ = gesture_of(button, over, shift);
  if (gesture_ == Gesture::push && viewer_.push_freely) gesture_ = Gesture::pull_freely;
  pressed_ = true;
  moved_ = false;
  begin_x_ = last_x_ = x;
  begin_y_ = last_y_ = y;
  if (joint_ >= 0) {
    pushed_from_ = viewer_.shell->frame.nodes.col(joint_);
    press_offset_ = Eigen::Vector2d(x, y) - pixel_of(joint_);
    along_ = viewer_.shell->normals.col(joint_);
    // a constrained joint is pushed along the direction of its constraint
    for (const ConstrainedJoint& one : viewer_.shell->constrained)
      if (one.joint == joint_ && !one.along.isZero(0)) along_ = one.along;
  }
  if (edge_ >= 0)
    pushed_from_ =
        viewer_.shell->frame.nodes.col(viewer_.shell->layout->edge_points[std::size_t(edge_)]);
}

/// Ends what is dragged if a shell without it has come meanwhile.
void Picker::check_dragged() {
  const bool any = viewer_.shell->any();
  const int joints = any ? int(viewer_.shell->layout->joints.size()) : 0,
            edge_points = any ? int(viewer_.shell->layout->edge_points.size()) : 0;
  if (joint_ < joints && edge_ < edge_points) return;
  joint_ = edge_ = -1;
  gesture_ = Gesture::pick;
}

void Picker::drag(double x, double y) {
  if (!pressed_) return;
  check_dragged();
  const double dx = x - last_x_, dy = y - last_y_, from_x = x - begin_x_, from_y = y - begin_y_;
  if (!moved_ && std::hypot(from_x, from_y) < click_px) return;
  if (dx == 0 && dy == 0) return;
  moved_ = true;
  last_x_ = x;
  last_y_ = y;
  render::Camera& camera = viewer_.camera;
  switch (gesture_) {
    case Gesture::orbit:
      return orbit(camera, dx, dy);
    case Gesture::pan:
      return pan(camera, viewer_.view, dx, dy);
    case Gesture::push: {
      double depth = dragged_along(camera, viewer_.view, pushed_from_, along_, from_x, from_y);
      // the joint may move sideways, so its current position counts, except if the camera looks
      // along the push
      const Eigen::Vector3d at = viewer_.shell->frame.nodes.col(joint_);
      const double under = pushed_under(camera, viewer_.view, pushed_from_, along_, at,
                                        Eigen::Vector2d(x, y) - press_offset_ - pixel_of(joint_));
      if (under != (at - pushed_from_).dot(along_)) depth = under;
      return viewer_.post(Push{joint_, pushed_from_ + depth * along_, along_}, true);
    }
    case Gesture::pull_freely:
      return viewer_.post(
          Push{joint_,
               pushed_from_ + dragged_in_plane(camera, viewer_.view, pushed_from_, from_x, from_y)},
          true);
    case Gesture::drag_edge:
      return viewer_.post(
          DragEdge{edge_, pushed_from_ +
                              dragged_level(camera, viewer_.view, pushed_from_, from_x, from_y)},
          true);
    case Gesture::let_go_joint:
    case Gesture::zoom:
    case Gesture::pick:
      return;
  }
}

void Picker::release(double x, double y) {
  if (!pressed_) return;
  check_dragged();
  pressed_ = false;
  const bool at_shell = gesture_ == Gesture::push || gesture_ == Gesture::pull_freely ||
                        gesture_ == Gesture::drag_edge;
  if (moved_ && at_shell) viewer_.end_drag();
  if (moved_ || x > viewer_.view.width) return;
  if (gesture_ == Gesture::let_go_joint) return viewer_.send_command(Release{joint_});
  if (viewer_.measuring && joint_ >= 0) return viewer_.measure(joint_);
  viewer_.picked_joint = joint_;
  viewer_.picked_rod = joint_ < 0 && edge_ < 0 ? rod_at(x, y) : PointOnRod{};
  const bool nothing = joint_ < 0 && edge_ < 0 && viewer_.picked_rod.rod < 0;
  viewer_.picked_cell = nothing ? cell_at(x, y) : -1;
}

void Picker::wheel(double steps, double x, double y) {
  zoom(viewer_.camera, viewer_.view, steps, x, y);
}

/// The rod under the mouse and its nearest node; of several near rods that nearest to the camera.
PointOnRod Picker::rod_at(double x, double y) const {
  PointOnRod found;
  if (!viewer_.shell->any()) return found;
  const auto& rods = viewer_.shell->layout->rods;
  const Eigen::Vector3d forward = render::camera_axes(viewer_.camera).forward;
  const double within = rod_px * std::max(1.0, viewer_.view.height / 720);
  const Eigen::Vector2d at(x, y);
  double best = 1e300;
  for (int r = 0; r < int(rods.size()); ++r) {
    const std::vector<int>& nodes = rods[std::size_t(r)];
    for (int k = 0; k + 1 < int(nodes.size()); ++k) {
      const int from = nodes[std::size_t(k)], to = nodes[std::size_t(k) + 1];
      const Eigen::Vector2d p = pixel_of(from), q = pixel_of(to);
      const double fraction = fraction_along(p, q, at), off = (p + fraction * (q - p) - at).norm();
      if (off > within) continue;
      const double depth = forward.dot(viewer_.shell->frame.nodes.col(fraction < 0.5 ? from : to)),
                   score = off + 0.05 * depth / mm_per_pixel(viewer_.camera, viewer_.view);
      if (score >= best) continue;
      best = score;
      found = {r, fraction < 0.5 ? k : k + 1};
    }
  }
  return found;
}

/// The cell whose picture contains the pixel; of several that nearest to the camera.
int Picker::cell_at(double x, double y) const {
  if (!viewer_.shell->any()) return -1;
  const record::Layout& layout = *viewer_.shell->layout;
  const Eigen::Vector3d forward = render::camera_axes(viewer_.camera).forward;
  int best = -1;
  double nearest = 1e300;
  for (int k = 0; k < int(layout.cells.size()); ++k) {
    const auto& joints = layout.cells[std::size_t(k)].joints;
    bool inside = false;
    double depth = 0;
    for (int a = 0, b = 3; a < 4; b = a++) {
      const Eigen::Vector2d p = pixel_of(joints[std::size_t(a)]),
                            q = pixel_of(joints[std::size_t(b)]);
      depth += forward.dot(viewer_.shell->frame.nodes.col(joints[std::size_t(a)]));
      if ((p.y() > y) != (q.y() > y) && x < (q.x() - p.x()) * (y - p.y()) / (q.y() - p.y()) + p.x())
        inside = !inside;
    }
    if (inside && depth < nearest) nearest = depth, best = k;
  }
  return best;
}

}  // namespace gridshell::window
