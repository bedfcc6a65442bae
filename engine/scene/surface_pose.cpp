#include "engine/scene/surface_pose.h"

#include <cmath>
#include <numbers>

#include "engine/core/try.h"

namespace gridshell {

Eigen::Matrix<double, 3, 2> axes_about(const Eigen::Vector2d& diagonal) {
  const Eigen::Vector2d left(-diagonal.y(), diagonal.x());
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Zero();
  axes.col(0).head<2>() = M_SQRT1_2 * (diagonal - left);
  axes.col(1).head<2>() = M_SQRT1_2 * (diagonal + left);
  return axes;
}

Result<Surface::Function> parsed(const char* key, const std::string& text) {
  const auto expression = Expression::parse(text);
  if (!expression) return invalid("[net] {} = \"{}\": {}", key, text, expression.error().message);
  return [E = *expression](const Eigen::Vector3d& p) { return E.at(p); };
}

Result<Surface::Function> outside_of(const preset::Net& requested) {
  if (!requested.within.empty()) return parsed("within", requested.within);
  if (!requested.cut_mm && requested.file.is_mesh())
    return Surface::Function([](const Eigen::Vector3d&) { return -1.0; });
  return [cut = requested.cut_mm.value_or(0)](const Eigen::Vector3d& p) { return cut - p.z(); };
}

namespace {

/// The apex on the surface. If its z is left out, it is that of the surface.
Result<Eigen::Vector3d> apex_of(const preset::Net& requested, const ShapedSurface& shape,
                                double allowed_mm) {
  const Surface& surface = shape.surface;
  const auto& given = requested.apex_mm;
  Eigen::Vector3d apex(given[0], given[1], given.size() > 2 ? given[2] : 0);
  if (given.size() == 2) {
    const auto height = shape.height(apex.x(), apex.y());
    if (!height)
      return invalid(
          "[net] apex_mm: the surface has no point at "
          "({:.6g}, {:.6g}) mm",
          apex.x(), apex.y());
    apex.z() = *height;
  }
  const auto nearest = surface.nearest(apex);
  if (!nearest)
    return invalid("[net] apex_mm lies far off the surface: {}{}", nearest.error().message,
                   shape.height ? "; without its z it is found" : "");
  const double off = (*nearest - apex).norm();
  // flat triangles deviate from the smooth surface
  if (given.size() == 3 && off > allowed_mm)
    return invalid(
        "[net] apex_mm lies {:.3g} mm off the surface, whose nearest point is "
        "({:.6g}, {:.6g}, {:.6g}) mm",
        off, nearest->x(), nearest->y(), nearest->z());
  return *nearest;
}

/// The directions of the net's axes on the surface at its apex.
Result<NetPose> pose_at(const preset::Net& requested, const Surface& surface,
                        const Eigen::Vector3d& apex) {
  constexpr double steepest = 0.1;
  const Surface::Curvature bent = surface.curvature(apex);
  Eigen::Vector3d up = bent.axes.col(2);
  if (up.z() < 0) up = -up;
  if (!(up.z() > steepest))
    return invalid(
        "[net] apex_mm: got a point where the surface is upright, expected one where it faces up");
  Eigen::Vector3d along = bent.axes.col(0);
  if (requested.axis == preset::NetAxis::x || bent.umbilic)
    along = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  // the direction towards +x of the two opposite ones
  if (along.x() < 0) along = -along;
  const double turned = requested.axis_deg * std::numbers::pi / 180;
  return NetPose{apex, Eigen::AngleAxisd(turned, up) * along, up, {}};
}

FlatFrame flat_frame(const preset::Net& requested, const NetPose& pose,
                     const Eigen::Matrix3Xd& ring) {
  FlatFrame frame;
  frame.origin = pose.apex;
  frame.origin.z() = requested.within.empty() && (requested.cut_mm || !requested.file.is_mesh())
                         ? requested.cut_mm.value_or(0)
                         : ring.row(2).mean();
  const Eigen::Vector2d diagonal =
      (pose.along_u + pose.up.cross(pose.along_u)).head<2>().normalized();
  frame.axes = axes_about(diagonal);
  return frame;
}

}  // namespace

Result<NetPose> given_pose(const preset::Net& requested, const ShapedSurface& shape,
                           const Surface::Function& outside, double allowed_mm) {
  TRY(apex, apex_of(requested, shape, allowed_mm));
  if (!(outside(*apex) < 0))
    return invalid("[net] {}: the apex ({:.4g}, {:.4g}, {:.4g}) mm lies outside",
                   requested.within.empty() ? "cut_mm" : "within", apex->x(), apex->y(), apex->z());
  TRY(pose, pose_at(requested, shape.surface, *apex));
  pose->outside = outside;
  return pose;
}

Result<void> lay_flat(const preset::Net& requested, const NetPose& pose, NetDesign& design) {
  TRY(ring, points_on(*design.net, design.domain->boundary(256)));
  design.flat = flat_frame(requested, pose, *ring);
  const Eigen::Vector2d middle = ring->topRows<2>().rowwise().mean();
  design.scale_mm = (ring->topRows<2>().colwise() - middle).colwise().norm().maxCoeff();
  return {};
}

}  // namespace gridshell
