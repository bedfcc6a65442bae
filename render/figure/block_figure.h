// Building blocks, apart and joined [Baek 2018, Fig. 5].
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/snapshot.h"
#include "render/draw/renderer.h"
#include "render/movie/style.h"
#include "render/plot/legend.h"
#include "render/plot/panels.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// The colour of a block in all pictures.
Colour block_colour(std::size_t index);

/// The blocks of a layout by name.
std::vector<ColourKey> block_keys(const record::Layout& layout);

/// The blocks of a run on their nets, drawn apart in one picture. Errors as write_stills.
Result<PanelFigure> draw_blocks(const record::Trajectory& run, const MovieStyle& style,
                                Renderer& renderer, Watch& watch);

/// What write_block_footprints draws, as large as fits into a box.
void draw_block_footprints(Canvas& canvas, const Box& box, const record::Trajectory& run);

/// The blocks' footprints apart, and below them the joined footprint with its original boundary, to
/// scale. Writes `<stem>.png` and `<stem>.svg`.
Result<void> write_block_footprints(const std::filesystem::path& stem,
                                    const record::Trajectory& run, const std::string& title = "",
                                    const Print& print = {});

/// Gap and kink of every rod across a seam against its place along the seam, one marker a seam.
Plot seam_plot(const record::Trajectory& run);

}  // namespace gridshell::render
