// Building blocks of a preset, joined.
#pragma once

#include "engine/core/result.h"
#include "engine/footprint/blocks.h"
#include "engine/footprint/flat_frame.h"
#include "engine/preset/preset.h"
#include "engine/scene/net_design.h"

namespace gridshell {

/// The assemblage of a preset's blocks; its scale is half the diagonal of the box around its
/// footprint. Errors (bad_input): those of the blocks' nets and of Assemblage::make.
Result<NetDesign> block_design(const preset::Preset& preset);

}  // namespace gridshell
