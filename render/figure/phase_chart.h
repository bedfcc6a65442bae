// Which states footprints of so many rods and so long legs can rest in [Baek 2018, Fig. 2B].
#pragma once

#include <filesystem>
#include <string>

#include "engine/record/phase_diagram.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// L_d along x, n upwards. At each point a marker a class of the paper, filled where trials met it
/// and hollow where only symmetric forms led to it, and the number of other states; the lines of
/// the shortest leg l_d = 1, 0, -1. A cross where nothing was found. Of several searches of one
/// footprint what any found.
Plot phase_plot(const record::PhaseDiagram& diagram, const std::string& title);

/// The same as `<stem>.png`, `.svg` and `.pdf`.
Result<void> write_phase_chart(const std::filesystem::path& stem,
                               const record::PhaseDiagram& diagram, const std::string& title,
                               const Print& print);

}  // namespace gridshell::render
