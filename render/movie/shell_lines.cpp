#include "render/movie/stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "render/canvas/legend.h"
#include "render/gl/laths.h"

namespace gridshell::render {
namespace {

/// A point as the camera sees it: position on the canvas, and depth along the view.
struct Seen {
  Point at;
  double depth = 0;
};

class Eye {
 public:
  Eye(const Camera& camera, const Box& box)
      : forward_(camera_axes(camera).forward),
        matrix_(
            view_projection(camera, box.width / box.height, camera.target, camera.half_extent_mm)),
        box_(box) {}

  Seen operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector4d clip = matrix_ * point.homogeneous();
    return {{box_.x + (0.5 + 0.5 * clip.x() / clip.w()) * box_.width,
             box_.y + (0.5 - 0.5 * clip.y() / clip.w()) * box_.height},
            forward_.dot(point)};
  }

 private:
  Eigen::Vector3d forward_;
  Eigen::Matrix4d matrix_;
  Box box_;
};

/// The corners of a cell as the camera sees them.
std::array<Seen, 4> corners_of(const record::Cell& cell, const Drawing& drawing, const Eye& eye) {
  std::array<Seen, 4> corners;
  for (std::size_t k = 0; k < 4; ++k)
    corners[k] = eye(drawing.nodes.col(drawing.layout->joints[cell.joints[k]].node));
  return corners;
}

/// The cells as seen by the camera, two triangles each, with depths.
class Screen {
 public:
  Screen(const Drawing& drawing, const Eye& eye) {
    for (const record::Cell& cell : drawing.layout->cells) {
      const std::array<Seen, 4> corner = corners_of(cell, drawing, eye);
      triangles_.push_back({corner[0], corner[1], corner[2]});
      triangles_.push_back({corner[0], corner[2], corner[3]});
    }
    for (const Triangle& t : triangles_)
      for (const Seen& corner : t)
        low_ = std::min(low_, corner.at.y), high_ = std::max(high_, corner.at.y);
    for (const Triangle& t : triangles_) {
      const auto [first, last] = std::minmax({t[0].at.y, t[1].at.y, t[2].at.y});
      for (int row = row_of(first); row <= row_of(last); ++row)
        rows_[std::size_t(row)].push_back(&t);
    }
  }

  bool hides(const Seen& p, double slack) const {
    if (!(p.at.y >= low_ && p.at.y <= high_)) return false;
    return std::ranges::any_of(rows_[std::size_t(row_of(p.at.y))], [&](const Triangle* triangle) {
      const Triangle& t = *triangle;
      const double area = cross(t[0].at, t[1].at, t[2].at);
      if (std::abs(area) < 1e-9) return false;
      const double a = cross(p.at, t[1].at, t[2].at) / area,
                   b = cross(t[0].at, p.at, t[2].at) / area, c = 1 - a - b;
      if (std::min({a, b, c}) < -1e-9) return false;
      return a * t[0].depth + b * t[1].depth + c * t[2].depth < p.depth - slack;
    });
  }

 private:
  using Triangle = std::array<Seen, 3>;
  static double cross(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  int row_of(double y) const {
    return std::clamp(int((y - low_) / std::max(1e-9, high_ - low_) * int(rows_.size())), 0,
                      int(rows_.size()) - 1);
  }
  std::vector<Triangle> triangles_;
  double low_ = INFINITY, high_ = -INFINITY;
  std::array<std::vector<const Triangle*>, 128> rows_;  // the triangles in each horizontal strip
};

Colour faded(Colour colour, Colour background, double by) {
  const auto f = float(by);
  return {colour.r + f * (background.r - colour.r), colour.g + f * (background.g - colour.g),
          colour.b + f * (background.b - colour.b), colour.a};
}

/// Draws an arrow along the view, from behind as ⊗ or from its tip as ⊙. Returns false, and draws
/// nothing, if the arrow has another direction.
bool draw_if_along_view(Canvas& canvas, const Arrow& arrow, const Eye& eye, double units_per_mm) {
  const Seen from = eye(arrow.from), to = eye(arrow.to);
  if (std::hypot(to.at.x - from.at.x, to.at.y - from.at.y) >
      0.2 * units_per_mm * (arrow.to - arrow.from).norm())
    return false;
  const bool away = to.depth > from.depth;
  const Point at = away ? from.at : to.at;
  const double radius = std::max(3.2 * units_per_mm * arrow.diameter_mm, 3.0),
               arm = radius * std::numbers::sqrt2 / 2;
  const Stroke line{arrow.colour, 0.28 * radius};
  canvas.circle(at, radius, white, line);
  if (!away) canvas.circle(at, 0.34 * radius, arrow.colour);
  for (const double side : {-arm, arm})
    if (away) canvas.line({at.x - arm, at.y - side}, {at.x + arm, at.y + side}, line);
  return true;
}

class Lines {
 public:
  Lines(Canvas& canvas, const Box& box, const Drawing& drawing, const Camera& camera)
      : canvas_(canvas),
        drawing_(drawing),
        eye_(camera, box),
        forward_(camera_axes(camera).forward.cast<float>()),
        screen_(drawing, eye_),
        units_per_mm_(box.height / (2 * camera.half_extent_mm)),
        slack_(0.25 * drawing.layout->spacing_mm) {
    if (!drawing.laths_mm.empty()) normals_ = shell_normals(drawing);
  }

  /// Fills coloured cells, the farthest first.
  void fill_cells() {
    const std::vector<record::Cell>& cells = drawing_.layout->cells;
    if (drawing_.cell_colours.size() != cells.size()) return;
    struct Filled {
      double depth = 0;  // sum of the corners'
      std::vector<Point> corners = {};
      Colour colour = {};
    };
    std::vector<Filled> order;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      Filled& one = order.emplace_back();
      one.colour = drawing_.cell_colours[c];
      for (const Seen& corner : corners_of(cells[c], drawing_, eye_)) {
        one.corners.push_back(corner.at);
        one.depth += corner.depth;
      }
    }
    std::ranges::stable_sort(order, std::ranges::greater{}, &Filled::depth);
    // an outline of the same colour leaves no seams
    for (const Filled& one : order)
      if (one.colour.a > 0) canvas_.polygon(one.corners, one.colour, {one.colour, 0.3});
  }

  /// Draws the parts that are hidden, or those that are visible.
  void draw(bool hidden) {
    const double fade = hidden ? std::max(0.55, drawing_.far_fade) : 0;
    if (hidden && drawing_.far_fade >= 1) return;
    const auto ink = [&](Colour colour) { return faded(colour, drawing_.background, fade); };
    for (const Ring& ring : drawing_.rings) {
      if (ring.points.cols() == 0) continue;
      Eigen::Matrix3Xd closed(3, ring.points.cols() + 1);
      closed << ring.points, ring.points.col(0);
      polyline(closed, hidden, {ink(ring.colour), width(ring.diameter_mm)}, {});
    }
    for (const GhostRods& ghost : drawing_.ghosts)
      for (const auto& rod : ghost.rods)
        polyline(ghost.nodes(Eigen::all, rod), hidden,
                 {ink(ghost.colour), width(ghost.diameter_mm)}, {});
    for (std::size_t r = 0; r < drawing_.layout->rods.size(); ++r) {
      const auto& rod = drawing_.layout->rods[r];
      const double thick = thickness_of(r);
      Eigen::Matrix3Xd points(3, rod.size());
      std::vector<Colour> colours;
      for (std::size_t k = 0; k < rod.size(); ++k) {
        points.col(long(k)) = drawing_.nodes.col(rod[k]);
        if (!drawing_.node_colours.empty())
          colours.push_back(ink(drawing_.node_colours[std::size_t(rod[k])]));
      }
      polyline(points, hidden, {ink(drawing_.rod_colour), width(thick)}, colours);
    }
    if (drawing_.joint_diameter_mm > 0)
      for (const record::Joint& joint : drawing_.layout->joints) {
        const Seen at = eye_(drawing_.nodes.col(joint.node));
        if (screen_.hides(at, slack_) == hidden)
          canvas_.circle(at.at, 0.5 * width(drawing_.joint_diameter_mm),
                         ink(drawing_.joint_colour));
      }
    if (!hidden) arrows();
  }

 private:
  /// Width of a rod, mm: a lath's mean apparent width along its length, or a round rod's diameter.
  double thickness_of(std::size_t r) const {
    const Eigen::Vector2f size = lath_size(drawing_, r);
    const auto& rod = drawing_.layout->rods[r];
    if (size.minCoeff() <= 0 || rod.size() < 2)
      return record::thickness_of(*drawing_.layout, r) * drawing_.rod_diameter_mm;
    const auto normals = lath_normals(drawing_, r, normals_);
    double sum = 0;
    for (std::size_t k = 0; k + 1 < rod.size(); ++k) {
      const Eigen::Vector3f along = (drawing_.nodes.col(rod[k + 1]) - drawing_.nodes.col(rod[k]))
                                        .cast<float>()
                                        .stableNormalized();
      sum += apparent_width(size, along, normals[k], forward_);
    }
    return sum / double(rod.size() - 1);
  }

  double width(double diameter_mm) const { return units_per_mm_ * diameter_mm; }

  // Draws a line in pieces of one colour that are all hidden or all visible. Colours are rounded to
  // steps too small to see, and each piece begins under the one before, so that there are no seams.
  void polyline(const Eigen::Matrix3Xd& points, bool hidden, const Stroke& stroke,
                const std::vector<Colour>& colours) {
    std::vector<Point> line;
    Point end;
    Colour colour = stroke.colour;
    const auto flush = [&] {
      if (!line.empty()) line.push_back(end);
      canvas_.polyline(line, {colour, stroke.width});
      line.clear();
    };
    // points nearer than the line's width are left out, since they only make files longer; the
    // last one is drawn
    const auto add = [&](Point p) {
      if (std::hypot(end.x - line.back().x, end.y - line.back().y) > 0.8 * stroke.width)
        line.push_back(end);
      end = p;
    };
    for (long k = 0; k + 1 < points.cols(); ++k) {
      const Eigen::Vector3d a = points.col(k), b = points.col(k + 1);
      const bool is_hidden = screen_.hides(eye_(0.5 * (a + b)), slack_);
      const Colour here = colours.empty() ? stroke.colour : stepped(colours[std::size_t(k)]);
      const bool other = here.r != colour.r || here.g != colour.g || here.b != colour.b;
      if (is_hidden != hidden || other) {
        const bool goes_on = is_hidden == hidden && !line.empty();
        const Point before = goes_on ? line.back() : Point{};
        flush();
        colour = here;
        if (is_hidden != hidden) continue;
        if (goes_on) {
          const Point at = eye_(a).at;
          const double length = std::hypot(at.x - before.x, at.y - before.y);
          const double part = std::min(0.5, 0.5 * stroke.width / std::max(length, 1e-9));
          line.push_back({std::lerp(at.x, before.x, part), std::lerp(at.y, before.y, part)});
          end = at;
        }
      }
      if (line.empty()) {
        end = eye_(a).at;
        line.push_back(end);
      }
      add(eye_(b).at);
    }
    flush();
  }

  static Colour stepped(Colour colour) {
    constexpr float steps = 20;
    const auto step = [](float c) { return std::round(steps * c) / steps; };
    return {step(colour.r), step(colour.g), step(colour.b), colour.a};
  }

  void arrows() {
    for (const PointMark& mark : drawing_.marks)
      canvas_.circle(eye_(mark.at).at, 0.5 * width(mark.diameter_mm), mark.colour,
                     {{0, 0, 0, 1}, 0.15 * width(mark.diameter_mm)});
    for (const Arrow& arrow : drawing_.arrows)
      if (!draw_if_along_view(canvas_, arrow, eye_, units_per_mm_))
        draw_arrow(canvas_, eye_(arrow.from).at, eye_(arrow.to).at,
                   {arrow.colour, width(arrow.diameter_mm)});
  }

  Canvas& canvas_;
  const Drawing& drawing_;
  Eye eye_;
  Eigen::Vector3f forward_;
  Screen screen_;
  double units_per_mm_, slack_;
  std::vector<Eigen::Vector3f> normals_;  // of the shell; empty without laths
};

}  // namespace

void draw_shell_lines(Canvas& canvas, const Box& box, const Drawing& drawing,
                      const Camera& camera) {
  Lines lines(canvas, box, drawing, camera);
  lines.draw(true);
  lines.fill_cells();
  lines.draw(false);
}

void mark_arrows_along_view(Image& picture, const Drawing& drawing, const Camera& camera) {
  if (drawing.arrows.empty()) return;
  draw_over(picture, [&](Canvas& canvas) {
    const Eye eye(camera, {0, 0, canvas.width(), canvas.height()});
    for (const Arrow& arrow : drawing.arrows)
      draw_if_along_view(canvas, arrow, eye, canvas.height() / (2 * camera.half_extent_mm));
  });
}

std::function<void(Canvas&, const Box&)> shell_lines(Drawing drawing, const Camera& camera) {
  const auto layout = std::make_shared<const record::Layout>(*drawing.layout);
  drawing.layout = layout.get();
  return [layout, drawing = std::move(drawing), camera](Canvas& canvas, const Box& box) {
    draw_shell_lines(canvas, box, drawing, camera);
  };
}

}  // namespace gridshell::render
