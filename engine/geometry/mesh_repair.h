// Repair of triangle meshes from files.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace gridshell {

/// A repaired mesh, and one sentence on each kind of repair.
struct MendedMesh {
  Eigen::Matrix3Xd vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::string> done;
};

/// Repairs triangles of a file and returns the largest sheet (by area), as TriangleMesh needs it:
/// - vertices nearer to each other than 1e-5 of the mesh's size are merged;
/// - triangles without area and repeated triangles are left out; if such a triangle has a corner on
///   the edge of a neighbour, the neighbour is divided there;
/// - if more than two triangles have a common edge, the two that continue straightest remain
///   connected; two triangles that are folded onto one another by more than 150 degrees are
///   separated, and so are parts that touch in one vertex; separated vertices are moved inwards by
///   a thousandth of the size of their triangles;
/// - of a closed mesh the part that faces up is taken;
/// - vertices at which noise folds the sheet or lets it cross itself are moved to the mean of their
///   neighbours, if that takes at most 3 % of the mesh's size.
MendedMesh mended(const Eigen::Matrix3Xd& vertices, std::vector<std::array<int, 3>> triangles);

}  // namespace gridshell
