// The net of a preset: the surface, the part of it that is used, and the position of the net on it.
#pragma once

#include <memory>
#include <optional>

#include "engine/core/result.h"
#include "engine/footprint/assemblage.h"
#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/surface_net.h"
#include "engine/preset/preset.h"
#include "engine/scene/mesh_net.h"

namespace gridshell {

/// The design by a Chebyshev net [Baek 2018]: a net C, the original boundary b, which C maps to the
/// actuated boundary a, and the position of the flat footprint in the plane of a, rotated as the
/// net is.
struct NetDesign {
  std::shared_ptr<const ChebyshevNet> net;
  std::unique_ptr<Domain> domain;
  FlatFrame flat;
  double scale_mm = 0;                          ///< rho
  std::shared_ptr<const Assemblage> blocks;     ///< building blocks of the net, if any
  std::shared_ptr<const MeshNetReport> report;  ///< report of a net on a mesh
};

/// The net of a preset's [net]. `spacing_mm`: d; nets on any surface are computed on a finer grid.
/// Errors (bad_input): those of the net or its boundary, with the position at which the net folds
/// or ends.
Result<NetDesign> net_design(const preset::Net& net, double spacing_mm);

// Building blocks of a preset, joined.

/// The assemblage of a preset's blocks; its scale is half the diagonal of the box around its
/// footprint. Errors (bad_input): those of the blocks' nets and of Assemblage::make.
Result<NetDesign> block_design(const preset::Preset& preset);

// The computed part of a net that is refused.

/// The part of the net of a preset, on any surface, that ends before its boundary. Empty if it
/// reaches the boundary, or if there is another error.
std::optional<PartialNet> refused_net(const preset::Preset& preset);

}  // namespace gridshell
