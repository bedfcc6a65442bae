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

/// A viable ansatz [Baek 2018]: a net C, the original boundary b with C(b) = a, and the position of
/// the flat footprint in the plane of a, rotated as the net is.
struct NetDesign {
  std::shared_ptr<const ChebyshevNet> net;
  std::unique_ptr<Domain> domain;
  FlatFrame flat;
  double scale_mm = 0;                          ///< rho
  std::shared_ptr<const Assemblage> blocks;     ///< where the net is one of blocks
  std::shared_ptr<const MeshNetReport> report;  ///< where it is on a mesh
};

/// `spacing_mm`: d, finer than which nets on any surface are found. Errors (bad_input): what the
/// net or its boundary cannot be, with where it folds or ends.
Result<NetDesign> net_design(const preset::Net& net, double spacing_mm);

// Building blocks of a preset, joined.

/// The assemblage of a preset's blocks; its scale is half the diagonal of the box around its
/// footprint. Errors (bad_input): those of the blocks' nets and of Assemblage::make.
Result<NetDesign> block_design(const preset::Preset& preset);

// What there is of the net of a preset that is refused.

/// Where the net of a preset, on any surface, ends before its boundary. Nothing: it does not, or
/// something else is wrong.
std::optional<PartialNet> refused_net(const preset::Preset& preset);

}  // namespace gridshell
