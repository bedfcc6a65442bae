// Where a Camera puts a point: the matrices of the renderer, and pixels for whoever labels a
// picture.
#pragma once

#include <Eigen/Core>

#include "render/draw/drawing.h"

namespace gridshell::render {

/// The camera's axes in space: unit vectors, forward = right x up turned away from the viewer.
struct CameraAxes {
  Eigen::Vector3d right, up, forward;
};

CameraAxes camera_axes(const Camera& camera);

/// From the camera to its target in mm; any length will do for an orthographic one.
double camera_distance(const Camera& camera);

/// World to clip coordinates of a picture with the given width / height. Near and far planes
/// enclose the sphere (`centre`, `radius`), as far as it lies before the camera.
Eigen::Matrix4d view_projection(const Camera& camera, double aspect, const Eigen::Vector3d& centre,
                                double radius);

/// Where `point` (mm) falls in a picture of width x height pixels: x to the right, y down, from the
/// top left corner. Only for points before the camera.
Eigen::Vector2d to_pixel(const Camera& camera, int width, int height, const Eigen::Vector3d& point);

}  // namespace gridshell::render
