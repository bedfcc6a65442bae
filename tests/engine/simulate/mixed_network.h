// A network of mixed laws and supports, and the same one moved or listed differently.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/preset/preset.h"

namespace gridshell {

/// A shallow vault of three rods per direction, with mixed laws and supports, slightly compressed
/// by its supports.
inline preset::NetworkData mixed_network() {
  preset::NetworkData file;
  for (const double u : {-2.0, -1.0, 0.1, 1.0, 2.2})
    for (const double v : {-2.0, -1.1, 0.0, 1.0, 2.0})
      file.points.push_back({20 * u, 24 * v, 12 - 0.8 * u * u - 0.9 * v * v});
  for (const int k : {1, 2, 3}) {
    file.rods.push_back({5 * k, 5 * k + 1, 5 * k + 2, 5 * k + 3, 5 * k + 4});
    file.rods.push_back({k, 5 + k, 10 + k, 15 + k, 20 + k});
  }
  for (const int point : {5, 9, 10, 14, 15, 19, 1, 21, 2, 22, 3, 23}) {
    const auto& from = file.points[std::size_t(point)];
    file.supports.push_back({double(point), 0.99 * from[0], 0.99 * from[1], from[2]});
  }
  file.end_constraints = {{0, 0, 2}, {0, 1, 1}, {1, 1, 1}, {2, 0, 2},
                          {3, 0, 0}, {5, 0, 2}, {5, 1, 2}};
  file.springs = {{1, 2, 2, 2}, {14, 3, 3, 3}};
  file.joint_laws = {{6, 3, -1}, {12, -1, -1, 0.4}, {18, 0, 5}, {8, 0, -1, -0.3}, {7, 0, 0, 0.5}};
  return file;
}

/// All of its positions moved: rotated, mirrored or stretched by a matrix, then shifted.
inline preset::NetworkData moved(preset::NetworkData file, const Eigen::Matrix3d& by,
                                 const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const auto move = [&](std::vector<double>& row, std::size_t first) {
    Eigen::Map<Eigen::Vector3d> at(row.data() + first);
    at = by * Eigen::Vector3d(at) + shift;
  };
  for (auto& point : file.points) move(point, 0);
  for (auto& row : file.supports)
    if (row.size() == 4) move(row, 1);
  return file;
}

inline Eigen::Matrix3d turn_about(double radian, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(radian, axis.normalized()).toRotationMatrix();
}

/// The mixed network turned, shifted, mirrored, and its points, rods and their ends in another
/// order.
inline std::vector<preset::NetworkData> same_otherwise(const preset::NetworkData& file,
                                                       double radian) {
  preset::NetworkData other = file;
  std::ranges::reverse(other.points);
  std::ranges::reverse(other.rods);
  for (auto& rod : other.rods) {
    for (int& point : rod) point = 24 - point;
    std::ranges::reverse(rod);
  }
  for (auto* rows : {&other.joint_laws, &other.supports, &other.springs})
    for (auto& row : *rows) row[0] = 24 - row[0];
  // the rod that was listed later lies above
  for (auto& row : other.joint_laws)
    if (row.size() > 3) row[3] *= -1;
  for (auto& row : other.end_constraints) row = {5 - row[0], 1 - row[1], row[2]};
  return {moved(file, turn_about(radian, {1, 2, -0.5})),
          moved(file, Eigen::Matrix3d::Identity(), {13, -400, 77}),
          moved(file, Eigen::Vector3d(-1, 1, 1).asDiagonal().toDenseMatrix()), other};
}

}  // namespace gridshell
