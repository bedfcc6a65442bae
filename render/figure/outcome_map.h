// Maps of where methods hold: cells coloured by what a run came to.
#pragma once

#include <string>
#include <vector>

#include "engine/record/charts.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// Colour of an outcome; the silent ones are the warm, dark ones, and their cells are crossed.
Colour outcome_colour(record::RunOutcome outcome);

/// "right", "planar saddle", ... as the legend says it.
std::string outcome_label(record::RunOutcome outcome);

/// Height (points) that draw_outcome_maps takes at this width.
double outcome_maps_height(const std::vector<record::StabilityRow>& rows, double width);

/// One row of panels a map, one panel a method: x along the columns, y along the rows, a legend
/// below; a dashed line where a "step over" its limit passes 1. Panels are as wide as their
/// columns; what does not fit goes on in the next row.
void draw_outcome_maps(Canvas& canvas, const Box& box,
                       const std::vector<record::StabilityRow>& rows, const std::string& title);

/// `<stem>.png` and `<stem>.svg`.
Result<void> write_outcome_maps(const std::filesystem::path& stem,
                                const std::vector<record::StabilityRow>& rows,
                                const std::string& title, double width_mm = 178);

}  // namespace gridshell::render
