// Shells under point loads, beside one another [Baek 2018, Fig. 4C-D].
#pragma once

#include <filesystem>

#include "render/figure/net_figure.h"
#include "render/figure/net_plots.h"

namespace gridshell::render {

/// The shells at their last frame, seen from the style's camera, rods coloured by |u|/delta_0 under
/// one colour bar. Progress and errors as write_stills.
Result<PanelFigure> draw_pushes(const std::vector<NetRun>& runs, const MovieStyle& style,
                                Renderer& renderer, Watch& watch);

/// Force against depth over all frames, N and mm: how each shell resists. Where one snapped, the
/// states before and after are joined by a dashed line.
Plot force_plot(const std::vector<NamedRun>& runs);

/// K of the cells in bins of x/L at the last frame over the grey ones of the first, a plot a run on
/// one scale, `title` (plain text; may be empty) above. Writes `<stem>.png` and `<stem>.svg`.
Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const std::string& title, const Print& print = {});

}  // namespace gridshell::render
