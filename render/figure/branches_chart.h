// A bifurcation diagram as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/record/branches.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// What stands on the two axes of one panel.
enum class BranchAxis { height, amplitude };

/// Height or amplitude over the boundary's radius, or over progress where there is none: stable
/// parts full, others dashed; bifurcations, limit points and ends are marked. Without names of
/// curves: the legend is the figure's.
Plot branches_plot(const std::vector<record::BranchPoint>& points, BranchAxis axis);

/// Both panels beside one another, `<stem>.png`, `.svg` and `.pdf`; where what happens lies within
/// a sixth of the path, two more below show that part alone.
Result<void> write_branches(const std::filesystem::path& stem,
                            const std::vector<record::BranchPoint>& points,
                            const std::string& title);

}  // namespace gridshell::render
