#include "render/movie/top_view.h"

#include <algorithm>
#include <cmath>

#include "render/movie/boundary.h"
#include "render/movie/load_marks.h"

namespace gridshell::render {
namespace {

constexpr Colour rod_ink{0.16f, 0.17f, 0.2f, 1}, joint_ink{0.75f, 0.12f, 0.1f, 1},
    load_ink{0.05f, 0.05f, 0.06f, 1};

struct ToBox {
  Box box;
  TopExtent extent;
  double scale() const { return std::min(box.width, box.height) / (2 * extent.half_mm); }
  // y grows upwards seen from above
  Point operator()(const Eigen::Vector3d& p) const {
    return {box.middle().x + scale() * (p.x() - extent.x_mm),
            box.middle().y - scale() * (p.y() - extent.y_mm)};
  }
};

std::vector<Point> closed_line(const Eigen::Matrix3Xd& points, const ToBox& place) {
  std::vector<Point> line;
  for (long k = 0; k < points.cols(); ++k) line.push_back(place(points.col(k)));
  return line;
}

}  // namespace

void draw_top_view(Canvas& canvas, const Box& box, const record::Layout& layout,
                   const record::Frame& frame, const TopExtent& extent,
                   const std::vector<Colour>& cell_colours) {
  const double hair = std::max(0.6, box.width / 260), radius = std::max(0.7, box.width / 130);
  const ToBox place{box.inset(radius + hair), extent};
  if (shows_original(frame))
    canvas.polyline(closed_line(layout.original_boundary, place), {{0.6f, 0.6f, 0.62f, 1}, hair},
                    true);
  canvas.polyline(closed_line(boundary_at(layout, frame.actuation), place),
                  {{0.25f, 0.27f, 0.3f, 1}, 1.5 * hair}, true);
  for (std::size_t c = 0; c < std::min(cell_colours.size(), layout.cells.size()); ++c) {
    std::vector<Point> corners;
    for (int joint : layout.cells[c].joints)
      corners.push_back(place(frame.nodes.col(layout.joints[std::size_t(joint)].node)));
    canvas.polygon(corners, cell_colours[c]);
  }
  for (const std::vector<int>& rod : layout.rods) {
    // nodes closer than a pixel and a half add nothing but time
    std::vector<Point> line;
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const Point p = place(frame.nodes.col(rod[k]));
      const bool end = k == 0 || k + 1 == rod.size();
      if (end || std::hypot(p.x - line.back().x, p.y - line.back().y) > 1.5) line.push_back(p);
    }
    canvas.polyline(line, {rod_ink, hair});
  }
  for (const record::Joint& joint : layout.joints)
    canvas.circle(place(frame.nodes.col(joint.node)), radius, joint_ink);
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    if (!acts(load, layout, frame)) continue;
    const record::Joint& joint = layout.joints.at(std::size_t(load.joint));
    canvas.circle(place(frame.nodes.col(joint.node)), 2.6 * radius, {0, 0, 0, 0},
                  {load_ink, 1.2 * radius});
  }
}

}  // namespace gridshell::render
