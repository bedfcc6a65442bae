// Curvature of the cells along x, over that of the first frame.
#pragma once

#include <array>
#include <optional>

#include "engine/record/snapshot.h"
#include "render/movie/survey.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// Mean and standard deviation of K in every bin of x/L as points with error bars, over the grey
/// bars of the run's first frame; the mean over all `cells` as a line across (dashed that of the
/// first frame). The range is fixed over the run, or the one given. Frames need K_bins.
Plot bins_plot(const Survey& run, long cells, const record::Frame& frame,
               const std::optional<std::array<double, 2>>& range, double font_size);

}  // namespace gridshell::render
