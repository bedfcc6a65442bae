// Curvature of the cells along x, over that of the first frame.
#pragma once

#include "engine/record/snapshot.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// Mean and standard deviation of K in every bin of x/L as points with error bars, over the grey
/// bars of the run's first frame; the total over the number of cells as a line across (dashed that
/// of the first frame). Ranges are fixed over the run. Frames need K_bins.
Plot bins_plot(const record::Trajectory& run, int index, double font_size);

}  // namespace gridshell::render
