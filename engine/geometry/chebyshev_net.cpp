#include "engine/geometry/chebyshev_net.h"

#include <Eigen/Geometry>

namespace gridshell {

Eigen::Vector3d NetPoint::normal() const { return tangent_u.cross(tangent_v).normalized(); }

}  // namespace gridshell
