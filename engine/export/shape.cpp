#include "engine/export/shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gridshell::exports {

Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod) {
  const std::vector<int>& nodes = layout.rods[rod];
  Eigen::Matrix3Xd points(3, Eigen::Index(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    points.col(Eigen::Index(k)) = frame.nodes.col(nodes[k]);
  return points;
}

Eigen::Matrix3Xd reactions_N(const record::Layout& layout, const record::Frame& frame) {
  if (frame.reactions_N.size() == 0)
    return Eigen::Matrix3Xd::Constant(3, frame.nodes.cols(), record::unknown);
  Eigen::Matrix3Xd on = Eigen::Matrix3Xd::Zero(3, frame.nodes.cols());
  for (std::size_t k = 0; k < layout.supports.size(); ++k)
    on.col(layout.supports[k]) = frame.reactions_N.col(Eigen::Index(k));
  return on;
}

Eigen::Matrix<double, 3, 4> cell_corners(const record::Layout& layout, const record::Frame& frame,
                                         std::size_t cell) {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k)
    corners.col(k) =
        frame.nodes.col(layout.joints[std::size_t(layout.cells[cell].joints[std::size_t(k)])].node);
  return corners;
}

Tube tube_around(const Eigen::Matrix3Xd& points, double radius_mm, int sides) {
  const Eigen::Index n = points.cols();
  Tube tube;
  tube.vertices.resize(3, n * sides + 2);
  tube.normals.resize(3, n * sides + 2);
  Eigen::Vector3d tangent = (points.col(1) - points.col(0)).normalized();
  Eigen::Vector3d side = tangent.unitOrthogonal();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector3d chord =
        points.col(std::min(k + 1, n - 1)) - points.col(std::max<Eigen::Index>(k - 1, 0));
    const Eigen::Vector3d next = chord.normalized();
    side = Eigen::Quaterniond::FromTwoVectors(tangent, next) * side;
    side = (side - side.dot(next) * next).normalized();
    tangent = next;
    const Eigen::Vector3d other = tangent.cross(side);
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * M_PI * s / sides;
      const Eigen::Vector3d normal = std::cos(angle) * side + std::sin(angle) * other;
      tube.normals.col(k * sides + s) = normal;
      tube.vertices.col(k * sides + s) = points.col(k) + radius_mm * normal;
    }
  }
  const int first = int(n) * sides, last = first + 1, ring = (int(n) - 1) * sides;
  tube.vertices.col(first) = points.col(0);
  tube.vertices.col(last) = points.col(n - 1);
  tube.normals.col(first) = (points.col(0) - points.col(1)).normalized();
  tube.normals.col(last) = (points.col(n - 1) - points.col(n - 2)).normalized();
  for (int s = 0; s < sides; ++s) {
    const int t = (s + 1) % sides;
    for (int k = 0; k + 1 < int(n); ++k) {
      const int a = k * sides + s, b = k * sides + t, c = a + sides, d = b + sides;
      tube.triangles.push_back({a, b, d});
      tube.triangles.push_back({a, d, c});
    }
    tube.triangles.push_back({first, t, s});
    tube.triangles.push_back({last, ring + s, ring + t});
  }
  return tube;
}

}  // namespace gridshell::exports
