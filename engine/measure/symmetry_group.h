// Groups of symmetries of the square, up and down among them, by name.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/footprint/mesh_symmetry.h"

namespace gridshell {

/// Indices of square_symmetries(), ascending.
using SymmetryGroup = std::vector<int>;

/// Schoenflies' name of a group of them, with the place of its mirrors where there are two:
/// "C1", "Cs_axis", "Cs_diagonal" (one vertical mirror), "C2", "C2v_axes", "C2v_diagonals", "C4",
/// "C4v" (full symmetry); with maps that turn z over "Ci", "C2_level_axis", "C2_level_diagonal",
/// "C2h_axis", "C2h_diagonal", "S4", "D2_axes", "D2_diagonals", "D2d_axes", "D2d_diagonals" (its
/// mirrors), "D4", and "flat" for all that hold the level plane itself.
std::string name_of_group(const SymmetryGroup& group);

/// All groups among `symmetries`, each once: the trivial one and those of flat shapes left out, of
/// groups with the same name the first. In the order of their size, the largest first.
std::vector<SymmetryGroup> subgroups(const std::vector<MeshSymmetry>& symmetries);

/// Those of `symmetries` that leave a shape as it is: no joint (3 x n, mm) moves by more than
/// `tolerance_mm`.
SymmetryGroup group_of(const std::vector<MeshSymmetry>& symmetries, const Eigen::Matrix3Xd& joints,
                       double tolerance_mm);

}  // namespace gridshell
