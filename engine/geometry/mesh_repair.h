// One sheet of what a file of triangles contains.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace gridshell {

/// A mesh that was mended, and what was done to it, one sentence each.
struct MendedMesh {
  Eigen::Matrix3Xd vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::string> done;
};

/// Finds, among triangles as programs write them, the largest sheet (by area) that TriangleMesh may
/// take:
/// - vertices nearer than 1e-5 of the mesh's size are one;
/// - triangles without area and those that are there twice are left out, what is next to a corner
///   that such a triangle had on another's edge is divided there;
/// - where more than two triangles share an edge the two that continue straightest stay joined,
/// where
///   two are folded onto one another by more than 150 degrees they are parted, and so are parts
///   that touch in one vertex; vertices parted so draw back by a thousandth of their triangles;
/// - of a closed mesh the part that faces up is taken;
/// - vertices at which noise folds the sheet or lets it cross itself go to the mean of their
/// neighbours, by no more
///   than 3 % of the size, else they stay.
MendedMesh mended(const Eigen::Matrix3Xd& vertices, std::vector<std::array<int, 3>> triangles);

}  // namespace gridshell
