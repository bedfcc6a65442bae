// Symmetries of shapes and meshes: mirror planes, and maps of a mesh onto itself.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/footprint/mesh.h"

namespace gridshell {

/// Deviation of a shape from mirror symmetry, mm: the largest distance between the mirror image of
/// a joint and the joint nearest to the image. The mirror is the vertical plane through the z-axis
/// with the horizontal unit vector `normal`. `joints`: 3 x n, mm.
double mirror_defect(const Eigen::Matrix3Xd& joints, const Eigen::Vector2d& normal);

// Common symmetries of a shell's footprint and boundary, as maps of its mesh onto itself.
// Considered are those of the square, with maps that invert z.

/// Nodes that the boundary fixes: joints, edge points, ghosts.
std::vector<int> fixed_nodes(const RodMesh& mesh);

/// The sixteen linear maps of space that map the square lattice about the z-axis onto itself:
/// signed permutations of x and y, then the same with z inverted. The identity is the first.
const std::vector<Eigen::Matrix3d>& square_symmetries();

/// For each point the index of the point that is nearest to its image under a linear map; empty if
/// an image is further than `within_mm` from all points. The time grows with the square of the
/// number of points.
std::optional<std::vector<int>> images_of(const Eigen::Matrix2Xd& points,
                                          const Eigen::Matrix2d& map, double within_mm);

/// A map of a mesh onto itself: p is mapped to M (p - c) + c, node k to the position of node
/// image[k].
struct MeshSymmetry {
  int index = 0;  ///< index into square_symmetries()
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<int> image;

  bool turns_over() const { return map(2, 2) < 0; }

  /// The image of a shape: 3 x n, all nodes of the mesh or, as joints come first, its joints alone.
  Eigen::Matrix3Xd of(const Eigen::Matrix3Xd& x) const;
};

/// The symmetries of a mesh with its boundary: those of the sixteen maps that map the flat mesh
/// onto itself and the fixed nodes at their prescribed positions onto one another. `ends` has the
/// prescribed positions, at least 3 x nodes, mm; columns of free nodes are ignored. The identity is
/// the first.
std::vector<MeshSymmetry> symmetries_of(const RodMesh& mesh, const Eigen::Matrix3Xd& ends);

/// The symmetric part of a shape: the mean of its images under a group.
Eigen::Matrix3Xd symmetric_part(const Eigen::Matrix3Xd& x, const std::vector<MeshSymmetry>& group);

/// Largest distance, mm, between the joints of `x` and those of the image of `y` under `symmetry`.
double distance_under(const MeshSymmetry& symmetry, const Eigen::Matrix3Xd& x,
                      const Eigen::Matrix3Xd& y);

}  // namespace gridshell
