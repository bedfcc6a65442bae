#include "engine/geometry/symmetry.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

double mirror_defect(const Eigen::Matrix3Xd& joints, const Eigen::Vector2d& normal) {
  double worst = 0;
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    Eigen::Vector3d image = joints.col(k);
    image.head<2>() -= 2 * image.head<2>().dot(normal) * normal;
    const double nearest = (joints.colwise() - image).colwise().squaredNorm().minCoeff();
    if (!(nearest <= worst)) worst = nearest;
  }
  return std::sqrt(worst);
}

}  // namespace gridshell
