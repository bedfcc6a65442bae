#include "engine/footprint/flat_frame.h"

namespace gridshell {

Eigen::Vector3d FlatFrame::at(const Eigen::Vector2d& uv) const { return origin + axes * uv; }

Eigen::Matrix3Xd FlatFrame::all(const Eigen::Matrix2Xd& uv) const {
  return (axes * uv).colwise() + origin;
}

}  // namespace gridshell
