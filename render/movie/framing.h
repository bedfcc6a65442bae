// A camera that keeps a whole run in its view: one target, one size, fixed over the movie, while it
// slowly turns.
#pragma once

#include "engine/record/snapshot.h"
#include "render/draw/drawing.h"
#include "render/movie/style.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// Points that bound all frames and both boundaries: the farthest along some hundred directions,
/// and the boundaries themselves. 3 x n, mm.
Eigen::Matrix3Xd extreme_points(const record::Trajectory& run);

/// The camera over a movie.
class Framing {
 public:
  /// At zoom 1 all points lie within `view` (pixels of a width x height picture) at every moment of
  /// the turn, as large as possible.
  Framing(const Eigen::Matrix3Xd& points, const MovieStyle& style, const Box& view);

  /// `moment` from 0, the first frame, to 1, the last
  Camera camera(double moment) const;
  /// in the plane through the target that faces the camera
  double pixels_per_mm() const { return height_ / (2 * half_extent_mm_); }
  /// what all points cover over the whole turn, in pixels
  const Box& seen() const { return seen_; }

 private:
  Box union_of_views(const Eigen::Matrix3Xd& points) const;

  double azimuth_deg_, elevation_deg_, turn_deg_;
  int width_, height_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double half_extent_mm_ = 1;
  double right_mm_ = 0, up_mm_ = 0;  ///< from the middle to the target, as the camera sees it
  Box seen_;
};

}  // namespace gridshell::render
