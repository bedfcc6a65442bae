#include "app/window/shell_drawing.h"

#include <fmt/format.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/dense.h"
#include "render/canvas/text.h"
#include "render/gl/laths.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/framing.h"
#include "render/movie/run_summary.h"

namespace gridshell::window {
namespace {

struct ColourText {
  const char* label;
  const char* meaning;
};
/// The texts, in the order of ColourBy.
constexpr ColourText colour_texts[] = {
    {"nothing", "rods and joints alone"},
    {"K□ (rad)", "integrated Gauss curvature of each cell"},
    {"|u| (mm)", "how far each point moved since the shell was formed"},
    {"ΔK□ (rad)", "its change since the shell was formed"},
    {"Δ/ρ (%)", "distance of a cell's joints from the net, over ρ"},
    {"bending (mJ/m)", "bending energy a length of rod"},
    {"axial force (N)", "of the rods; below 0 they are compressed"},
    {"σ (MPa)", "largest stress of a fibre, by axial force and bending"},
    {"σ / strength", "that over the rods' strength"},
    {"joint angle (°)", "between the rods at joints with laws or springs"},
};
static_assert(std::size(colour_texts) == words_of<ColourBy>().size());

/// Displacements of the nodes from positions `then`, mm. If those are of another mesh, they are
/// known at joints and edge points, which come first on every mesh and of which a scan has the
/// joints alone; they are interpolated between these, and constant past the first and last of a
/// rod.
Eigen::VectorXd displacement(const ShellView& shell, const Eigen::Matrix3Xd& then) {
  const Eigen::Matrix3Xd& now = shell.frame.nodes;
  if (now.cols() == then.cols()) return (now - then).colwise().norm().transpose();
  // linearly along each rod
  const record::Layout& layout = *shell.layout;
  const auto count =
      std::min(Eigen::Index(layout.joints.size() + layout.edge_points.size()), then.cols());
  const auto known = [&](int node) { return node < count; };
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(now.cols());
  for (const std::vector<int>& rod : layout.rods) {
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < rod.size(); ++k) {
      if (!known(rod[k])) continue;
      moved[rod[k]] = (now.col(rod[k]) - then.col(rod[k])).norm();
      at.push_back(k);
    }
    for (std::size_t k = 0, n = 0; k < rod.size() && !at.empty(); ++k) {
      while (n + 1 < at.size() && at[n + 1] <= k) ++n;
      const double from = double(at[n]), to = double(at[std::min(n + 1, at.size() - 1)]);
      const double part = to > from ? std::clamp((double(k) - from) / (to - from), 0.0, 1.0) : 0;
      moved[rod[k]] = (1 - part) * moved[rod[at[n]]] + part * moved[rod[std::size_t(to)]];
    }
  }
  return moved;
}

/// Length of a rod between two of its nodes, mm; nothing if it does not have both.
std::optional<double> along_rod(const ShellView& shell, const std::vector<int>& rod, int from,
                                int to) {
  auto first = std::ranges::find(rod, from), last = std::ranges::find(rod, to);
  if (first == rod.end() || last == rod.end()) return {};
  if (last < first) std::swap(first, last);
  double length = 0;
  for (; first != last; ++first)
    length += (shell.frame.nodes.col(first[1]) - shell.frame.nodes.col(first[0])).norm();
  return length;
}

using render::Colour;

/// Colours for a light and for a dark background.
struct Palette {
  Colour paper, ground, rod, ring, joint, arrow;
};
constexpr Palette light{{1, 1, 1, 1},
                        {0.93f, 0.93f, 0.94f, 1},
                        {0.16f, 0.17f, 0.20f, 1},
                        {0.3f, 0.33f, 0.38f, 1},
                        {0.45f, 0.47f, 0.51f, 1},
                        {0.05f, 0.05f, 0.06f, 1}};
constexpr Palette dark{{0.105f, 0.11f, 0.125f, 1}, {0.16f, 0.165f, 0.185f, 1},
                       {0.80f, 0.82f, 0.86f, 1},   {0.55f, 0.58f, 0.64f, 1},
                       {0.62f, 0.65f, 0.70f, 1},   {0.95f, 0.95f, 0.95f, 1}};
constexpr Colour ghost_grey{0.62f, 0.66f, 0.74f, 1}, constraint_yellow{0.98f, 0.76f, 0.10f, 1},
    other_green{0.05f, 0.58f, 0.42f, 1};

const Palette& palette_of(const Show& show) { return show.dark ? dark : light; }

void put_colours(const ShellView& shell, const Show& show, render::Drawing& drawing) {
  const bool cells = render::of_cells(show.colour_by);
  for (const double value : values_of(shell, show)) {
    auto& colours = cells ? drawing.cell_colours : drawing.node_colours;
    colours.push_back(show.scale(value));
  }
  if (drawing.node_colours.empty()) return;
  // thicker rods show their colours better
  drawing.rod_diameter_mm *= 1.8;
}

/// Draws the forces at constrained joints as arrows; the largest has 0.35 times the length scale.
void put_forces(const ShellView& shell, const Show& show, double thin_mm,
                render::Drawing& drawing) {
  double most = 0;
  for (const ConstrainedJoint& one : shell.constrained) most = std::max(most, one.force_N.norm());
  for (const ConstrainedJoint& one : shell.constrained) {
    const Eigen::Vector3d at = node_position(shell, show, one.joint);
    drawing.marks.push_back({at, std::max(5.0, 6 * thin_mm), constraint_yellow});
    const double length = 0.35 * shell.layout->length_scale_mm * one.force_N.norm() / most;
    if (!(length > 3 * thin_mm)) continue;
    const Eigen::Vector3d arrow = length * one.force_N.normalized();
    drawing.arrows.push_back(
        {at - arrow, at, std::max(1.4, 1.6 * thin_mm), palette_of(show).arrow});
  }
}

constexpr double degrees_a_pixel = 0.4, zoom_a_step = 0.88;
constexpr double least_extent_mm = 0.1, most_extent_mm = 1e5;
constexpr double steep_px = 0.15;  // a unit vector with a shorter picture is seen along itself

/// The picture of a unit displacement at `position`, pixels to the right and down per millimetre.
Eigen::Vector2d seen_px(const render::Camera& camera, const PictureSize& size,
                        const Eigen::Vector3d& position, const Eigen::Vector3d& unit) {
  const int w = int(size.width), h = int(size.height);
  return render::to_pixel(camera, w, h, position + 0.5 * unit) -
         render::to_pixel(camera, w, h, position - 0.5 * unit);
}

}  // namespace

bool same_joints(const std::vector<record::Joint>& a, const std::vector<record::Joint>& b) {
  return std::ranges::equal(a, b, [](const record::Joint& one, const record::Joint& other) {
    return one.i == other.i && one.j == other.j;
  });
}

std::string label_of(const ShellView& shell, const Show& show) {
  const ColourBy by = show.colour_by;
  if (by == ColourBy::displacement && show.other) return "from " + show.other->name + " (mm)";
  const bool surface = shell.design && shell.design->inverse.target == preset::Target::surface;
  if (by == ColourBy::deviation && surface) return "Δ/ρ from the surface (%)";
  return colour_texts[std::size_t(by)].label;
}
render::ColourBar bar_of(const ShellView& shell, const Show& show) {
  render::ColourBar bar = render::named_bar(show.colour_by, show.scale);
  const std::string label = label_of(shell, show);
  if (label != colour_texts[std::size_t(show.colour_by)].label)
    bar.label = render::plain(label), bar.words = "";  // another label explains itself
  else if (show.colour_by == ColourBy::displacement)
    bar.label = "|*u*| (mm)", bar.words = "displacement";
  bar.ends = true;
  const Eigen::VectorXd values = values_of(shell, show);
  const double slack = 1e-9 * (show.scale.high - show.scale.low);
  bar.below_scale = values.size() > 0 && values.minCoeff() < show.scale.low - slack;
  bar.above_scale = values.size() > 0 && values.maxCoeff() > show.scale.high + slack;
  return bar;
}
const char* meaning_of(ColourBy by) { return colour_texts[std::size_t(by)].meaning; }

Eigen::VectorXd values_of(const ShellView& shell, const Show& show) {
  if (!shell.any()) return {};
  if (show.colour_by == ColourBy::deviation) return 100 * shell.deviation;
  if (show.colour_by != ColourBy::displacement)
    return render::coloured_values(show.colour_by, *shell.layout, shell.frame, {*shell.first});
  if (!show.other) return displacement(shell, shell.first->nodes);
  if (!same_joints(shell.layout->joints, show.other->seen->layout->joints)) return {};
  return displacement(shell, show.other->seen->frame.nodes);
}

render::ColourScale scale_of(const ShellView& shell, const Show& show) {
  const Eigen::VectorXd values = values_of(shell, show);
  render::Interval all;
  for (const double value : values) all.take(value);
  return render::colour_scale(show.colour_by, {values.begin(), values.end()}, all);
}

render::ColourScale next_scale(const render::ColourScale& before, const render::ColourScale& now,
                               RangeOf of) {
  render::ColourScale next = now;
  switch (of) {
    case RangeOf::state:
      break;
    case RangeOf::run:
      next.low = std::min(before.low, now.low);
      next.high = std::max(before.high, now.high);
      break;
    case RangeOf::hand:
      next.low = before.low;
      next.high = before.high;
      break;
  }
  return next;
}

std::string text_of_measure(const ShellView& shell, const std::vector<int>& joints) {
  const auto between = [&](std::size_t from, std::size_t to) -> Eigen::Vector3d {
    return shell.frame.nodes.col(joints[to]) - shell.frame.nodes.col(joints[from]);
  };
  if (joints.size() < 2) return "";
  if (joints.size() > 2)
    return fmt::format("{:.2f}°",
                       180 / std::numbers::pi * angle_between(between(1, 0), between(1, 2)));
  std::string text = fmt::format("{:.2f} mm", between(0, 1).norm());
  for (const std::vector<int>& rod : shell.layout->rods)
    if (const auto along = along_rod(shell, rod, joints[0], joints[1]))
      text += fmt::format(", {:.2f} mm along the rod", *along);
  return text;
}

Eigen::Vector3d node_position(const ShellView& shell, const Show& show, int node) {
  Eigen::Vector3d position = shell.frame.nodes.col(node);
  if (show.mode_mm != 0 && node < shell.soft_mode.cols())
    position += show.mode_mm * shell.soft_mode.col(node);
  return position;
}

render::Drawing drawing_of(const ShellView& shell, const Show& show, double thin_mm) {
  const record::Layout& layout = *shell.layout;
  const Palette& palette = palette_of(show);
  render::Drawing drawing;
  drawing.layout = &layout;
  drawing.nodes = shell.frame.nodes;
  if (show.mode_mm != 0 && shell.soft_mode.cols() == drawing.nodes.cols())
    drawing.nodes += show.mode_mm * shell.soft_mode;
  drawing.rod_colour = palette.rod;
  drawing.rod_diameter_mm = std::max(layout.rod_diameter_mm, thin_mm);
  drawing.joint_colour = palette.joint;
  drawing.joint_diameter_mm = show.joints ? std::max(3.0, 1.5 * drawing.rod_diameter_mm) : 0;
  render::put_laths(layout.laths_mm, drawing);
  put_colours(shell, show, drawing);
  // not drawn if the supports do not move, or if the line through them is none of the preset
  if (show.rings && shell.preset.style.rings != preset::Visibility::off &&
      layout.original_boundary != layout.actuated_boundary) {
    drawing.rings.push_back({layout.original_boundary, std::max(0.6, thin_mm), ghost_grey, false});
    drawing.rings.push_back({render::boundary_at(layout, shell.frame.actuation),
                             std::max(1.4, 1.6 * thin_mm), palette.ring});
  }
  const auto ghosts = [&](const Eigen::Matrix3Xd& nodes) {
    if (nodes.cols() == drawing.nodes.cols())
      drawing.ghosts.push_back({nodes, layout.rods, 0.6 * drawing.rod_diameter_mm, ghost_grey});
  };
  if (show.net) ghosts(layout.net_nodes);
  if (show.footprint) ghosts(layout.flat_nodes);
  if (show.other && !show.side_by_side)
    drawing.ghosts.push_back({show.other->seen->frame.nodes, show.other->seen->layout->rods,
                              0.7 * drawing.rod_diameter_mm, other_green});
  put_forces(shell, show, thin_mm, drawing);
  if (show.loads) render::put_loads(layout, shell.frame, show.largest_load_N, thin_mm, drawing);
  if (show.braces) render::put_braces(layout, shell.frame, thin_mm, drawing);
  render::put_contacts(layout, shell.frame, thin_mm, drawing);
  // a shell that starts flat has its ground below the plane of the boundary
  const double lowest_mm = drawing.nodes.row(2).minCoeff();
  drawing.ground_z_mm = (layout.net_nodes.cols() > 0 ? lowest_mm : std::min(0.0, lowest_mm)) - 2.5;
  drawing.ground = show.ground;
  drawing.ground_colour = palette.ground;
  drawing.background = palette.paper;
  drawing.far_fade = 0.25;
  return drawing;
}

std::optional<render::ArrowKey> arrow_key_of(const ShellView& shell, const Show& show) {
  if (!show.loads || shell.frame.loads_N.cols() == 0 || render::loads_all_alike(shell.frame))
    return {};
  return render::arrow_key(*shell.layout, show.largest_load_N);
}

double mm_per_pixel(const render::Camera& camera, const PictureSize& size) {
  return 2 * camera.half_extent_mm / size.height;
}

void orbit(render::Camera& camera, double right_px, double down_px) {
  camera.azimuth_deg = std::remainder(camera.azimuth_deg - degrees_a_pixel * right_px, 360.0);
  camera.elevation_deg = std::clamp(camera.elevation_deg + degrees_a_pixel * down_px, -90.0, 90.0);
}

void pan(render::Camera& camera, const PictureSize& size, double right_px, double down_px) {
  const render::CameraAxes axes = render::camera_axes(camera);
  camera.target += mm_per_pixel(camera, size) * (down_px * axes.up - right_px * axes.right);
}

void zoom(render::Camera& camera, const PictureSize& size, double steps, double x, double y) {
  const render::CameraAxes axes = render::camera_axes(camera);
  const Eigen::Vector3d off = mm_per_pixel(camera, size) * ((x - 0.5 * size.width) * axes.right -
                                                            (y - 0.5 * size.height) * axes.up);
  const double before = camera.half_extent_mm;
  camera.half_extent_mm =
      std::clamp(before * std::pow(zoom_a_step, steps), least_extent_mm, most_extent_mm);
  camera.target += off * (1 - camera.half_extent_mm / before);
}

void look_from(render::Camera& camera, const render::ViewDirection& view) {
  camera.azimuth_deg = view.azimuth_deg;
  camera.elevation_deg = view.elevation_deg;
}

void fit(render::Camera& camera, const PictureSize& size, const Eigen::Matrix3Xd& points) {
  if (points.cols() == 0) return;
  constexpr double margin = 0.03;  // of the height
  render::MovieStyle style;
  style.size = {int(size.width), int(size.height)};
  style.azimuth_deg = camera.azimuth_deg;
  style.elevation_deg = camera.elevation_deg;
  style.turn_deg = 0;
  style.orthographic = camera.field_of_view_deg == 0;
  const render::Box panel = render::Box{0, 0, size.width, size.height}.inset(margin * size.height);
  const render::Camera fitted = render::Framing(points, style, panel).camera(0);
  camera.target = fitted.target;
  camera.half_extent_mm = std::clamp(fitted.half_extent_mm, least_extent_mm, most_extent_mm);
}

Eigen::Vector3d dragged_in_plane(const render::Camera& camera, const PictureSize& size,
                                 const Eigen::Vector3d& position, double right_px, double down_px) {
  const render::CameraAxes axes = render::camera_axes(camera);
  const double mm_right = 1 / seen_px(camera, size, position, axes.right).norm();
  const double mm_up = 1 / seen_px(camera, size, position, axes.up).norm();
  return mm_right * right_px * axes.right - mm_up * down_px * axes.up;
}

double dragged_along(const render::Camera& camera, const PictureSize& size,
                     const Eigen::Vector3d& position, const Eigen::Vector3d& axis, double right_px,
                     double down_px) {
  const Eigen::Vector2d px = seen_px(camera, size, position, axis);
  const double scale = 1 / mm_per_pixel(camera, size);
  // if the camera looks along the axis, the mouse moves the point by going up and down
  if (px.norm() < steep_px * scale) return -down_px / scale;
  return px.dot(Eigen::Vector2d(right_px, down_px)) / px.squaredNorm();
}

double pushed_under(const render::Camera& camera, const PictureSize& size,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& at, const Eigen::Vector2d& off_px) {
  const Eigen::Vector2d px = seen_px(camera, size, at, axis);
  const double depth = (at - from).dot(axis);
  // if the camera looks along the axis, the picture does not show the depth
  if (px.norm() < steep_px / mm_per_pixel(camera, size)) return depth;
  return depth + px.dot(off_px) / px.squaredNorm();
}

Eigen::Vector3d dragged_level(const render::Camera& camera, const PictureSize& size,
                              const Eigen::Vector3d& position, double right_px, double down_px) {
  Eigen::Matrix2d px;
  px << seen_px(camera, size, position, Eigen::Vector3d::UnitX()),
      seen_px(camera, size, position, Eigen::Vector3d::UnitY());
  const double scale = 1 / mm_per_pixel(camera, size);
  if (std::abs(px.determinant()) < steep_px * scale * scale) {
    Eigen::Vector3d right = render::camera_axes(camera).right;
    right.z() = 0;
    return right.normalized() * right_px / scale;
  }
  const Eigen::Vector2d mm = px.inverse() * Eigen::Vector2d(right_px, down_px);
  return {mm.x(), mm.y(), 0};
}

}  // namespace gridshell::window
