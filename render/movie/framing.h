// The camera of a movie: its target and size are fixed, so that a complete run is in its panel
// while the camera slowly turns.
#pragma once

#include <Eigen/Core>

#include "render/canvas/canvas.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"

namespace gridshell::render {

/// The camera over a movie.
class Framing {
 public:
  /// At zoom 1 all points (3 x n, mm) are within `panel` (pixels of the style's picture) at every
  /// moment of the turn, as large as possible. A target of the style is in the middle of the panel,
  /// and so is the centre of the zoom.
  Framing(const Eigen::Matrix3Xd& points, const MovieStyle& style, const Box& panel);

  /// the camera at a moment from 0, the first frame, to 1, the last
  Camera camera(double moment) const;
  /// scale in the plane through the target that faces the camera
  double pixels_per_mm() const { return height_ / (2 * half_extent_mm_); }
  /// the box that contains all points during the complete turn, in pixels
  const Box& seen() const { return seen_; }

 private:
  /// The box around all points during the turn, pixels. `nearest` becomes the smallest distance of
  /// a point from the camera over that of the target, if it is smaller.
  Box union_of_views(const Eigen::Matrix3Xd& points, double* nearest = nullptr) const;
  void fit(const Eigen::Matrix3Xd& points, const Box& panel);
  void look_at(const MovieStyle& style, const Box& panel);

  double azimuth_deg_, elevation_deg_, turn_deg_, field_of_view_deg_;
  int width_, height_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double half_extent_mm_ = 1;
  double right_mm_ = 0, up_mm_ = 0;  ///< from middle_ to the target, along the camera's axes
  Box seen_;
};

}  // namespace gridshell::render
