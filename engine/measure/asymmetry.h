// How far a shape is from the symmetry that another one has: the amplitude of a bifurcation
// diagram.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace gridshell {

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
