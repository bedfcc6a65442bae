// Mirror planes of a shape.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/footprint/mesh.h"

namespace gridshell {

/// Largest distance between the mirror image of a joint in the vertical plane through the z-axis
/// with the horizontal unit `normal` and the joint nearest to it: 0 where the plane is one of the
/// shape's. `joints`: 3 x n, mm.
double mirror_defect(const Eigen::Matrix3Xd& joints, const Eigen::Vector2d& normal);

// The symmetries that a shell's footprint and boundary have in common, as maps of its mesh onto
// itself: those of the square, up and down among them.

/// Nodes that the boundary fixes: joints, edge points, ghosts.
std::vector<int> held_nodes(const RodMesh& mesh);

/// The sixteen maps of space that leave the square lattice about the z-axis what it is: signed
/// permutations of x and y, then the same with z turned over. The identity is the first.
const std::vector<Eigen::Matrix3d>& square_symmetries();

/// Which of some points each of them goes to under a map of the plane; nothing where one is
/// further than `within_mm` from all. For a few hundred points: each looks at all.
std::optional<std::vector<int>> images_of(const Eigen::Matrix2Xd& points,
                                          const Eigen::Matrix2d& map, double within_mm);

/// A map of a mesh onto itself: p goes to M (p - c) + c, node k to the position of node image[k].
struct MeshSymmetry {
  int index = 0;  ///< of square_symmetries()
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<int> image;

  bool turns_over() const { return map(2, 2) < 0; }

  /// The image of a shape: 3 x n, all nodes of the mesh or, as joints come first, its joints alone.
  Eigen::Matrix3Xd of(const Eigen::Matrix3Xd& x) const;
};

/// Those of the sixteen that map the flat mesh onto itself and the ends of its rods, where `ends`
/// (3 x nodes or more columns, mm; what is free is ignored) fixes them, onto one another. The
/// identity is the first.
std::vector<MeshSymmetry> symmetries_of(const RodMesh& mesh, const Eigen::Matrix3Xd& ends);

/// The part of a shape that all of these leave as it is: the mean of its images under a group.
Eigen::Matrix3Xd symmetric_part(const Eigen::Matrix3Xd& x, const std::vector<MeshSymmetry>& group);

/// Largest distance, mm, between a joint of `x` and the one of `y` where `symmetry` puts y.
double distance_under(const MeshSymmetry& symmetry, const Eigen::Matrix3Xd& x,
                      const Eigen::Matrix3Xd& y);

}  // namespace gridshell
