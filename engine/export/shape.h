// One frame of a run as other programs see it: rods as lines or tubes, cells as quadrilaterals.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/record/snapshot.h"

namespace gridshell::exports {

/// What is written; what it refers to must outlive it.
struct Shape {
  const record::Layout& layout;
  const record::Frame& frame;
  const record::Frame& start;  ///< what displacements are from: the first frame of the run
  std::string title;
};

/// A rod's nodes from end to end, 3 x n, mm.
Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod);

/// The force that holds each node of the frame, N: 0 where nothing does, NaN where the run did not
/// record it.
Eigen::Matrix3Xd reactions_N(const record::Layout& layout, const record::Frame& frame);

/// Four corners of a cell, joints in order, 3 x 4, mm.
Eigen::Matrix<double, 3, 4> cell_corners(const record::Layout& layout, const record::Frame& frame,
                                         std::size_t cell);

/// A rod as a tube: `sides` vertices around each point, ends closed.
struct Tube {
  Eigen::Matrix3Xd vertices, normals;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise from outside
};

/// The directions around it are carried along without twist. The same number of points gives the
/// same triangles.
Tube tube_around(const Eigen::Matrix3Xd& points, double radius_mm, int sides);

}  // namespace gridshell::exports
