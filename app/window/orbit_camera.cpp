#include "app/window/shell_drawing.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace gridshell::window {
namespace {

constexpr double degrees_a_pixel = 0.4, zoom_a_step = 0.88;
constexpr double least_extent_mm = 0.1, most_extent_mm = 1e5;
constexpr double steep_px = 0.15;  // of a pixel that an axis must move by a pixel of drag

/// Where a displacement's picture goes, pixels right and down a millimetre.
Eigen::Vector2d seen_px(const render::Camera& camera, const PictureSize& size,
                        const Eigen::Vector3d& place, const Eigen::Vector3d& unit) {
  const int w = int(size.width), h = int(size.height);
  return render::to_pixel(camera, w, h, place + 0.5 * unit) -
         render::to_pixel(camera, w, h, place - 0.5 * unit);
}

}  // namespace

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
  const render::CameraAxes axes = render::camera_axes(camera);
  Eigen::Matrix3d frame;
  frame << axes.right, axes.up, axes.forward;
  const Eigen::Matrix3Xd seen = frame.transpose() * points;
  const Eigen::Vector3d low = seen.rowwise().minCoeff(), high = seen.rowwise().maxCoeff();
  camera.target = frame * (0.5 * (low + high));
  const double half_width = 0.5 * (high.x() - low.x()), half_height = 0.5 * (high.y() - low.y());
  camera.half_extent_mm =
      std::max({half_height, half_width * size.height / size.width, least_extent_mm});
  // what is nearer looks larger
  for (int k = 0; k < 3; ++k) {
    double most = 0;
    for (const auto& point : points.colwise()) {
      const Eigen::Vector2d at = render::to_pixel(camera, int(size.width), int(size.height), point);
      most = std::max(
          {most, std::abs(2 * at.x() / size.width - 1), std::abs(2 * at.y() / size.height - 1)});
    }
    camera.half_extent_mm =
        std::clamp(1.06 * most * camera.half_extent_mm, least_extent_mm, most_extent_mm);
  }
}

Eigen::Vector3d dragged_in_plane(const render::Camera& camera, const PictureSize& size,
                                 const Eigen::Vector3d& place, double right_px, double down_px) {
  const render::CameraAxes axes = render::camera_axes(camera);
  const double mm_right = 1 / seen_px(camera, size, place, axes.right).norm();
  const double mm_up = 1 / seen_px(camera, size, place, axes.up).norm();
  return mm_right * right_px * axes.right - mm_up * down_px * axes.up;
}

double dragged_along(const render::Camera& camera, const PictureSize& size,
                     const Eigen::Vector3d& place, const Eigen::Vector3d& axis, double right_px,
                     double down_px) {
  const Eigen::Vector2d px = seen_px(camera, size, place, axis);
  const double scale = 1 / mm_per_pixel(camera, size);
  // seen along itself it goes with the mouse up and down
  if (px.norm() < steep_px * scale) return -down_px / scale;
  return px.dot(Eigen::Vector2d(right_px, down_px)) / px.squaredNorm();
}

Eigen::Vector3d dragged_level(const render::Camera& camera, const PictureSize& size,
                              const Eigen::Vector3d& place, double right_px, double down_px) {
  Eigen::Matrix2d px;
  px << seen_px(camera, size, place, Eigen::Vector3d::UnitX()),
      seen_px(camera, size, place, Eigen::Vector3d::UnitY());
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
