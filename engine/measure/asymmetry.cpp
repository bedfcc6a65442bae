#include "engine/measure/asymmetry.h"

#include <cmath>

#include "engine/footprint/mesh_symmetry.h"

namespace gridshell {
namespace {

/// About its own middle in the plane.
template <class Points>
Points centred(Points points) {
  const Eigen::Vector2d middle = points.template topRows<2>().rowwise().mean();
  points.template topRows<2>().colwise() -= middle;
  return points;
}

}  // namespace

SharedSymmetry::SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape,
                               double within_mm) {
  const Eigen::Matrix2Xd points = centred(flat);
  const Eigen::Matrix3Xd joints = centred(shape);
  const double same = 1e-6 * std::sqrt(points.colwise().squaredNorm().maxCoeff());
  for (const Eigen::Matrix3d& map : square_symmetries()) {
    if (map(2, 2) < 0) continue;  // it turns the shape over
    const Eigen::Matrix2d turn = map.topLeftCorner<2, 2>();
    auto image = images_of(points, turn, same);
    if (!image) continue;
    Element element{turn, std::move(*image)};
    const double off = (moved(element, joints) - joints).colwise().norm().maxCoeff();
    if (off <= within_mm) elements_.push_back(std::move(element));
  }
}

Eigen::Matrix3Xd SharedSymmetry::moved(const Element& element, const Eigen::Matrix3Xd& joints) {
  Eigen::Matrix3Xd there(3, joints.cols());
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    auto to = there.col(element.image[std::size_t(k)]);
    to.head<2>() = element.turn * joints.col(k).head<2>();
    to.z() = joints(2, k);
  }
  return there;
}

Eigen::Matrix3Xd SharedSymmetry::broken(const Eigen::Matrix3Xd& shape) const {
  const Eigen::Matrix3Xd joints = centred(shape);
  Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, joints.cols());
  for (const Element& element : elements_) mean += moved(element, joints);
  return joints - mean / double(order());
}

double root_mean_square(const Eigen::Matrix3Xd& columns) {
  return columns.size() == 0 ? 0 : std::sqrt(columns.squaredNorm() / double(columns.cols()));
}

}  // namespace gridshell
