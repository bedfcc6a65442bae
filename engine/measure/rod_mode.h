// By which mode rods buckled.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/mesh.h"

namespace gridshell {

/// Inflections of every rod of a mesh whose nodes lie at `x` (3 x nodes, mm): how often its
/// curvature vector comes back on the other side, that is, with a negative product with the one
/// before. Curvatures below a twentieth of the rod's largest are not looked at. 0: buckled by the
/// first mode.
std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x);

}  // namespace gridshell
