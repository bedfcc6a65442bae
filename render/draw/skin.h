// The cells as sheets spanned between their rods.
#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/record/snapshot.h"
#include "render/draw/mesh.h"

namespace gridshell::render {

/// One Coons patch [Coons 1967] a cell, so that its edges lie on the rods however these bend:
/// S(u, v) = (1-v) c0(u) + v c1(u) + (1-u) d0(v) + u d1(v) - bilinear(corners).
/// The cells go from far to near along `forward` (ties: by index), so that blending them in this
/// order is right and always the same. `colours` are linear, one a cell; cells whose alpha is 0 are
/// left out.
void add_cells(Mesh& mesh, const record::Layout& layout, const Eigen::Matrix3Xd& nodes,
               std::span<const Eigen::Vector4f> colours, const Eigen::Vector3d& forward);

}  // namespace gridshell::render
