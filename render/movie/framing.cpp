#include "render/movie/framing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/draw/camera.h"
#include "render/movie/boundary.h"

namespace gridshell::render {
namespace {

// evenly spread directions (a Fibonacci lattice on the sphere), one a row
Eigen::MatrixX3d even_directions(int count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  Eigen::MatrixX3d directions(count, 3);
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
    directions.row(k) << r * std::cos(golden * k), r * std::sin(golden * k), z;
  }
  return directions;
}

}  // namespace

Eigen::Matrix3Xd extreme_points(const record::Trajectory& run) {
  const Eigen::MatrixX3d directions = even_directions(128);
  Eigen::VectorXd farthest =
      Eigen::VectorXd::Constant(directions.rows(), -std::numeric_limits<double>::infinity());
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, directions.rows());
  for (const record::Frame& frame : run.frames) {
    // rods are smooth: every few nodes bound them well enough
    const long stride = std::max<long>(1, frame.nodes.cols() / 600);
    for (long n = 0; n < frame.nodes.cols(); n += stride) {
      const Eigen::Vector3d node = frame.nodes.col(n);
      if (!node.allFinite()) continue;
      const Eigen::VectorXd reach = directions * node;
      for (long d = 0; d < reach.size(); ++d)
        if (reach[d] > farthest[d]) farthest[d] = reach[d], points.col(d) = node;
    }
  }
  const record::Layout& layout = run.layout;
  const bool shown = run.frames.empty() || shows_original(run.frames.front());
  const Eigen::Matrix3Xd& original = shown ? layout.original_boundary : layout.actuated_boundary;
  Eigen::Matrix3Xd all(3, points.cols() + original.cols() + layout.actuated_boundary.cols());
  all << points, original, layout.actuated_boundary;
  return all;
}

Framing::Framing(const Eigen::Matrix3Xd& points, const MovieStyle& style, const Box& view)
    : azimuth_deg_(style.azimuth_deg),
      elevation_deg_(style.elevation_deg),
      turn_deg_(style.turn_deg),
      width_(style.width),
      height_(style.height) {
  if (points.cols() == 0 || view.empty()) return;
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  middle_ = (low + high) / 2;
  half_extent_mm_ = std::max(1e-6, (high - low).norm());
  // size and shift act on each other through perspective, weakly: a few rounds settle both
  for (int round = 0; round < 12; ++round) {
    const Box seen = union_of_views(points);
    const double fit = std::max(seen.width / view.width, seen.height / view.height);
    const double mm = 1 / pixels_per_mm();
    right_mm_ += (seen.middle().x - width_ / 2.0) * mm;
    up_mm_ -= (seen.middle().y - height_ / 2.0) * mm;
    // what is in the picture's middle now belongs in the view's
    half_extent_mm_ *= fit;
    right_mm_ -= (view.middle().x - width_ / 2.0) / pixels_per_mm();
    up_mm_ += (view.middle().y - height_ / 2.0) / pixels_per_mm();
  }
  half_extent_mm_ /= style.zoom;
  seen_ = union_of_views(points);
}

Camera Framing::camera(double moment) const {
  Camera camera;
  camera.azimuth_deg = azimuth_deg_ + turn_deg_ * moment;
  camera.elevation_deg = elevation_deg_;
  camera.half_extent_mm = half_extent_mm_;
  const CameraAxes axes = camera_axes(camera);
  camera.target = middle_ + right_mm_ * axes.right + up_mm_ * axes.up;
  return camera;
}

Box Framing::union_of_views(const Eigen::Matrix3Xd& points) const {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::Array2d low(infinity, infinity), high = -low;
  const int moments = 1 + std::min(24, int(std::ceil(std::abs(turn_deg_) / 6)));
  for (int m = 0; m < moments; ++m) {
    const Camera now = camera(moments > 1 ? double(m) / (moments - 1) : 0);
    const Eigen::Matrix4Xd clip =
        view_projection(now, double(width_) / height_, now.target, now.half_extent_mm) *
        points.colwise().homogeneous();
    const Eigen::Array2Xd ndc = clip.topRows<2>().array().rowwise() / clip.row(3).array();
    low = low.min(ndc.rowwise().minCoeff());
    high = high.max(ndc.rowwise().maxCoeff());
  }
  // normalised device coordinates have y up, pixels have it down
  return {(0.5 + 0.5 * low.x()) * width_, (0.5 - 0.5 * high.y()) * height_,
          std::max(1e-9, 0.5 * (high.x() - low.x()) * width_),
          std::max(1e-9, 0.5 * (high.y() - low.y()) * height_)};
}

}  // namespace gridshell::render
