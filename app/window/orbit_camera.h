// What the mouse does to a camera: orbit, pan, zoom to the cursor, the standard views.
#pragma once

#include "render/gl/renderer.h"

namespace gridshell::window {

/// A picture's size in pixels.
struct PictureSize {
  double width = 1, height = 1;
  bool operator==(const PictureSize&) const = default;
};

/// Millimetres a pixel in the plane through the camera's target.
double mm_per_pixel(const render::Camera& camera, const PictureSize& size);

/// Turned by a drag of so many pixels; the elevation stays within straight down and straight up.
void orbit(render::Camera& camera, double right_px, double down_px);
/// The picture moves along with the mouse.
void pan(render::Camera& camera, const PictureSize& size, double right_px, double down_px);
/// `steps` of the wheel closer; what lies under (x, y), pixels from the top left, stays there.
void zoom(render::Camera& camera, const PictureSize& size, double steps, double x, double y);

void look_from(render::Camera& camera, const render::ViewDirection& view);

/// All points (3 x n, mm) within the picture, from where the camera looks.
void fit(render::Camera& camera, const PictureSize& size, const Eigen::Matrix3Xd& points);

/// Millimetres that a point at `place` moves in the plane facing the camera for a drag in pixels.
Eigen::Vector3d dragged_in_plane(const render::Camera& camera, const PictureSize& size,
                                 const Eigen::Vector3d& place, double right_px, double down_px);
/// The same along the unit vector `axis` alone: as far as its picture goes along with the mouse.
double dragged_along(const render::Camera& camera, const PictureSize& size,
                     const Eigen::Vector3d& place, const Eigen::Vector3d& axis, double right_px,
                     double down_px);
/// The same within the horizontal plane through the place; seen from the side, along the picture's
/// right alone.
Eigen::Vector3d dragged_level(const render::Camera& camera, const PictureSize& size,
                              const Eigen::Vector3d& place, double right_px, double down_px);

}  // namespace gridshell::window
