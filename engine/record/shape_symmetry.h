// Groups of symmetries of the square, up and down among them, by name.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/footprint/symmetry.h"

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

// How far a shape is from the symmetry that another one has: the amplitude of a bifurcation
// diagram.

/// Those of the eight symmetries of the square (rotations and mirrors about the z-axis) that map a
/// flat footprint onto itself and leave a shape of it unchanged.
class SharedSymmetry {
 public:
  /// `flat` and `shape`: the joints, 2 x n and 3 x n, mm, both about their own middle. A symmetry
  /// of the shape moves no joint further than `within_mm`.
  SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape, double within_mm);

  /// How many there are, the identity among them: 1 to 8.
  int order() const { return int(elements_.size()); }

  /// The part of a shape that breaks the symmetry, x - mean of g x over the group: 3 x n, mm.
  Eigen::Matrix3Xd broken(const Eigen::Matrix3Xd& joints) const;

 private:
  struct Element {
    Eigen::Matrix2d turn;
    std::vector<int> image;  // joint k goes to where joint image[k] is
  };
  static Eigen::Matrix3Xd moved(const Element& element, const Eigen::Matrix3Xd& joints);

  std::vector<Element> elements_;
};

/// Root of the mean square over the columns.
double root_mean_square(const Eigen::Matrix3Xd& columns);

}  // namespace gridshell
