#include "render/draw/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gridshell::render {
namespace {

constexpr double radian = std::numbers::pi / 180;

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  const double azimuth = camera.azimuth_deg * radian, elevation = camera.elevation_deg * radian;
  CameraAxes axes;
  axes.forward = -Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  // straight from above or below there is no vertical left to stand on
  const bool straight = std::abs(axes.forward.z()) > 1 - 1e-9;
  const Eigen::Vector3d top = straight ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  axes.right = axes.forward.cross(top).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

double camera_distance(const Camera& camera) {
  if (camera.field_of_view_deg <= 0) return 10 * camera.half_extent_mm;
  return camera.half_extent_mm / std::tan(0.5 * camera.field_of_view_deg * radian);
}

Eigen::Matrix4d view_projection(const Camera& camera, double aspect, const Eigen::Vector3d& centre,
                                double radius) {
  const CameraAxes axes = camera_axes(camera);
  const double distance = camera_distance(camera);
  const Eigen::Vector3d eye = camera.target - distance * axes.forward;
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = axes.right.transpose();
  view.block<1, 3>(1, 0) = axes.up.transpose();
  view.block<1, 3>(2, 0) = -axes.forward.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;

  const bool orthographic = camera.field_of_view_deg <= 0;
  const double middle = axes.forward.dot(centre - eye);
  double near = middle - radius, far = middle + radius;
  if (!orthographic) {
    near = std::max(near, 0.01 * distance);
    far = std::max(far, 1.01 * near);
  }
  const double scale = orthographic ? 1 / camera.half_extent_mm : distance / camera.half_extent_mm;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = scale / aspect;
  projection(1, 1) = scale;
  if (orthographic) {
    projection(2, 2) = -2 / (far - near);
    projection(2, 3) = -(far + near) / (far - near);
    projection(3, 3) = 1;
  } else {
    projection(2, 2) = -(far + near) / (far - near);
    projection(2, 3) = -2 * far * near / (far - near);
    projection(3, 2) = -1;
  }
  return projection * view;
}

Eigen::Vector2d to_pixel(const Camera& camera, int width, int height,
                         const Eigen::Vector3d& point) {
  const Eigen::Matrix4d m =
      view_projection(camera, double(width) / height, camera.target, camera.half_extent_mm);
  const Eigen::Vector4d clip = m * point.homogeneous();
  return {(0.5 + 0.5 * clip.x() / clip.w()) * width, (0.5 - 0.5 * clip.y() / clip.w()) * height};
}

}  // namespace gridshell::render
