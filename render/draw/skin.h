// The cells as sheets spanned between their rods.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/record/snapshot.h"
#include "render/draw/mesh.h"

namespace gridshell::render {

/// The triangles of one cell.
struct CellPatch {
  int cell = 0;
  std::vector<std::uint32_t> indices;
};

/// One Coons patch [Coons 1967] a cell, so that its edges lie on the rods however these bend:
/// S(u, v) = (1-v) c0(u) + v c1(u) + (1-u) d0(v) + u d1(v) - bilinear(corners).
/// Adds their vertices to the mesh; their triangles are for whoever knows the order. `colours` are
/// linear, one a cell; cells whose alpha is 0 are left out. A patch is as coarse as may be with all
/// points that it leaves out within the tolerance.
std::vector<CellPatch> add_cells(Mesh& mesh, const record::Layout& layout,
                                 const Eigen::Matrix3Xd& nodes,
                                 std::span<const Eigen::Vector4f> colours, float tolerance_mm);

}  // namespace gridshell::render
