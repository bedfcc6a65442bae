#include "render/movie/framing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell::render {

Framing::Framing(const Eigen::Matrix3Xd& points, const MovieStyle& style, const Box& panel)
    : azimuth_deg_(style.azimuth_deg),
      elevation_deg_(style.elevation_deg),
      turn_deg_(style.turn_deg),
      field_of_view_deg_(style.orthographic ? 0 : Camera{}.field_of_view_deg),
      width_(style.width()),
      height_(style.height()) {
  if (points.cols() == 0 || panel.empty()) return;
  fit(points, panel);
  look_at(style, panel);
  seen_ = union_of_views(points);
}

void Framing::fit(const Eigen::Matrix3Xd& points, const Box& panel) {
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  middle_ = (low + high) / 2;
  half_extent_mm_ = std::max(1e-6, (high - low).norm());
  constexpr double exact = 1e-8;  // of the size
  // size and shift depend on each other by perspective: near points move more than the target. So
  // the size takes half of its correction, and the shift that of the nearest point.
  for (int round = 0; round < 40; ++round) {
    double nearest = 1;
    const Box seen = union_of_views(points, &nearest);
    const double fit = std::max(seen.width / panel.width, seen.height / panel.height);
    const double mm = nearest / pixels_per_mm();
    right_mm_ += (seen.middle().x - panel.middle().x) * mm;
    up_mm_ -= (seen.middle().y - panel.middle().y) * mm;
    half_extent_mm_ *= std::sqrt(fit);
    const double off =
        std::hypot(seen.middle().x - panel.middle().x, seen.middle().y - panel.middle().y);
    if (std::abs(fit - 1) < exact && off < exact * height_) break;
  }
}

// applies target and zoom of the style about the middle of the panel
void Framing::look_at(const MovieStyle& style, const Box& panel) {
  const double x = panel.middle().x - width_ / 2.0, y = panel.middle().y - height_ / 2.0;
  right_mm_ += x / pixels_per_mm();
  up_mm_ -= y / pixels_per_mm();
  if (!style.target_mm.empty()) {
    middle_ = Eigen::Vector3d::Map(style.target_mm.data());
    right_mm_ = up_mm_ = 0;
  }
  half_extent_mm_ /= style.zoom;
  right_mm_ -= x / pixels_per_mm();
  up_mm_ += y / pixels_per_mm();
}

Camera Framing::camera(double moment) const {
  Camera camera;
  camera.azimuth_deg = azimuth_deg_ + turn_deg_ * moment;
  camera.elevation_deg = elevation_deg_;
  camera.half_extent_mm = half_extent_mm_;
  camera.field_of_view_deg = field_of_view_deg_;
  const CameraAxes axes = camera_axes(camera);
  camera.target = middle_ + right_mm_ * axes.right + up_mm_ * axes.up;
  return camera;
}

Box Framing::union_of_views(const Eigen::Matrix3Xd& points, double* nearest) const {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::Array2d low(infinity, infinity), high = -low;
  const int moments = 1 + std::min(24, int(std::ceil(std::abs(turn_deg_) / 6)));
  for (int m = 0; m < moments; ++m) {
    const Camera now = camera(moments > 1 ? double(m) / (moments - 1) : 0);
    const Eigen::Matrix4Xd clip =
        view_projection(now, double(width_) / height_, now.target, now.half_extent_mm) *
        points.colwise().homogeneous();
    const Eigen::Array2Xd ndc = clip.topRows<2>().array().rowwise() / clip.row(3).array();
    if (nearest && field_of_view_deg_ > 0)
      *nearest = std::min(*nearest, clip.row(3).minCoeff() / camera_distance(now));
    low = low.min(ndc.rowwise().minCoeff());
    high = high.max(ndc.rowwise().maxCoeff());
  }
  // y is up in normalised device coordinates and down in pixels
  return {(0.5 + 0.5 * low.x()) * width_, (0.5 - 0.5 * high.y()) * height_,
          std::max(1e-9, 0.5 * (high.x() - low.x()) * width_),
          std::max(1e-9, 0.5 * (high.y() - low.y()) * height_)};
}

}  // namespace gridshell::render
