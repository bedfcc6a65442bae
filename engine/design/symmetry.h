// The symmetries that a shell has and a design keeps.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/scene/scene.h"

namespace gridshell {

/// A motion of space that takes the shell to itself: x goes to turn x + shift, and the end k of a
/// rod (2r the begin, 2r + 1 the end of rod r) to the place of end to[k].
struct ShellSymmetry {
  std::vector<int> to;
  Eigen::Matrix3d turn;
};

/// All of the eight symmetries of the square grid that leave the footprint, the ends' places and
/// the joints as they are (3 x joints, mm) where they were, and up up; the identity is the first.
/// `near_mm`: how near counts as the same.
std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm);

}  // namespace gridshell
