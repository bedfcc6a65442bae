// The net that a preset asks for: the surface, the part of it that is wanted, and how it lies.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/blocks.h"
#include "engine/footprint/domain.h"
#include "engine/footprint/flat_frame.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/preset/preset.h"

namespace gridshell {

/// A viable ansatz [Baek 2018]: a net C, the original boundary b with C(b) = a, and the flat
/// footprint's place in the plane of a, turned as the net is.
struct NetDesign {
  std::shared_ptr<const ChebyshevNet> net;
  std::unique_ptr<Domain> domain;
  FlatFrame flat;
  double scale_mm = 0;                       ///< rho
  std::shared_ptr<const Assemblage> blocks;  ///< where the net is one of blocks
};

/// `spacing_mm`: d, finer than which nets on any surface are found. Errors (bad_input): what the
/// net or its boundary cannot be, with where it folds or ends.
Result<NetDesign> net_design(const preset::Net& net, double spacing_mm);

}  // namespace gridshell
