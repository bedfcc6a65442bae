// Building blocks of a preset, joined.
#pragma once

#include "engine/core/result.h"
#include "engine/experiment/net_design.h"
#include "engine/footprint/blocks.h"
#include "engine/footprint/flat_frame.h"
#include "engine/preset/preset.h"
#include "engine/record/snapshot.h"

namespace gridshell::experiment {

/// The assemblage of a preset's blocks; its scale is half the diagonal of the box around its
/// footprint. Errors (bad_input): those of the blocks' nets and of Assemblage::make.
Result<NetDesign> block_design(const preset::Preset& preset);

/// Adds the blocks on their own nets and the rods across their seams to a layout. Errors
/// (bad_input): those of the nets.
Result<void> record_blocks(const Assemblage& blocks, const FlatFrame& flat, record::Layout& layout);

}  // namespace gridshell::experiment
