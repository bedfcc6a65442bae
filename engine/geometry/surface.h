// Surfaces F(x, y, z) = 0.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "engine/core/result.h"

namespace gridshell {

/// Where a function of space is zero. `length_mm`: how far apart values are taken whose differences
/// are its slopes; small beside the radii of the surface's curvature.
class Surface {
 public:
  using Function = std::function<double(const Eigen::Vector3d&)>;
  Surface(Function F, double length_mm) : F_(std::move(F)), h_(1e-3 * length_mm) {}

  double at(const Eigen::Vector3d& p) const { return F_(p); }
  /// grad F, by central differences: relative error about 1e-8.
  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;
  /// The point of the surface along the slope of F from p, by Newton's method. Errors (bad_input):
  /// none is found near, F has no value or no slope there.
  Result<Eigen::Vector3d> nearest(const Eigen::Vector3d& p) const;

  /// Of the surface at one of its points.
  struct Curvature {
    Eigen::Matrix3d axes;  ///< columns: first and second principal direction, unit normal
    double first,
        second;    ///< principal curvatures, 1/mm, |first| >= |second|, signed by the normal
    bool umbilic;  ///< both alike: the directions mean nothing
  };
  /// Second derivatives by differences of the slopes: relative error about 1e-5.
  Curvature curvature(const Eigen::Vector3d& p) const;

 private:
  Function F_;
  double h_;
};

}  // namespace gridshell
