#include "engine/geometry/surface.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace gridshell {

Eigen::Vector3d Surface::gradient(const Eigen::Vector3d& p) const {
  Eigen::Vector3d slope;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d ahead = p, behind = p;
    ahead[k] += h_, behind[k] -= h_;
    slope[k] = (F_(ahead) - F_(behind)) / (ahead[k] - behind[k]);
  }
  return slope;
}

Result<Eigen::Vector3d> Surface::nearest(const Eigen::Vector3d& p) const {
  constexpr int most_iterations = 50;
  constexpr double near_mm = 1e-11;
  Eigen::Vector3d x = p;
  for (int k = 0; k < most_iterations; ++k) {
    const double value = F_(x);
    const Eigen::Vector3d slope = gradient(x);
    if (!std::isfinite(value) || !slope.allFinite())
      return fail(Fault::bad_input, fmt::format("the surface's function has no value at ({:.6g}, "
                                                "{:.6g}, {:.6g}) mm",
                                                x.x(), x.y(), x.z()));
    if (slope.squaredNorm() == 0)
      return fail(Fault::bad_input, fmt::format("the surface's function has no slope at ({:.6g}, "
                                                "{:.6g}, {:.6g}) mm",
                                                x.x(), x.y(), x.z()));
    const Eigen::Vector3d step = -value / slope.squaredNorm() * slope;
    x += step;
    if (step.norm() <= near_mm + 1e-15 * x.norm()) return x;
  }
  return fail(Fault::bad_input,
              fmt::format("no point of the surface is found near ({:.6g}, {:.6g}, {:.6g}) mm",
                          p.x(), p.y(), p.z()));
}

Surface::Curvature Surface::curvature(const Eigen::Vector3d& p) const {
  constexpr double alike = 1e-4, as_large = 1 - 1e-6;  // of the larger curvature
  const Eigen::Vector3d slope = gradient(p), normal = slope.normalized();
  // differences of differences need more room than those
  const double h = 20 * h_;
  Eigen::Matrix3d second;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    second.col(k) = (gradient(p + step) - gradient(p - step)) / (2 * h);
  }
  second = (0.5 * (second + second.transpose())).eval();
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  const Eigen::Matrix2d form = -plane.transpose() * second * plane / slope.norm();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> own(form);
  const int larger =
      std::abs(own.eigenvalues()[1]) >= as_large * std::abs(own.eigenvalues()[0]) ? 1 : 0;
  Curvature found;
  found.first = own.eigenvalues()[larger];
  found.second = own.eigenvalues()[1 - larger];
  found.axes.col(0) = plane * own.eigenvectors().col(larger);
  found.axes.col(1) = plane * own.eigenvectors().col(1 - larger);
  found.axes.col(2) = normal;
  found.umbilic = std::abs(found.first - found.second) <= alike * std::abs(found.first);
  return found;
}

}  // namespace gridshell
