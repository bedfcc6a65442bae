// Charts of methods: error over processor time and over unknowns, time over the number of rods.
#pragma once

#include <string>
#include <vector>

#include "engine/record/study_tables.h"
#include "render/canvas/canvas.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// Rows whose method begins with "auto " are marks with their tolerances, not a curve.
inline constexpr const char* auto_prefix = "auto ";

/// Largest joint error over the length scale against processor time, log-log, one curve a method
/// with bars from its fastest to its slowest run, the Pareto front beneath, what `auto` picks
/// marked. A method that was stopped is hollow at the time limit, at the error of the `bend`
/// row of its mesh; what failed is in failures_of(). Rows `of_sizes` are those of one method at
/// several sizes, without a front.
Plot accuracy_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title,
                   bool of_sizes = false);

/// The errors over the number of unknowns.
Plot unknowns_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title);

/// Time over rods per direction, log-log; the legend bears the exponents.
Plot scaling_plot(const std::vector<record::ScalingRow>& rows, const std::string& title);

/// "implicit Euler 1 (blow_up), ...": methods with edges per segment that gave nothing to draw.
std::string failures_of(const std::vector<record::AccuracyRow>& rows);

// Maps of where methods work: cells coloured by how a run ended.

/// Colour of an outcome; the silent ones are the warm, dark ones, and their cells are crossed.
Colour outcome_colour(record::RunOutcome outcome);

/// "right", "planar saddle", ... as the legend says it.
std::string outcome_label(record::RunOutcome outcome);

/// Height (points) that draw_outcome_maps takes at this width.
double outcome_maps_height(const std::vector<record::StabilityRow>& rows, double width);

/// One row of panels a map, one panel a method: x along the columns, y along the rows, a legend
/// below; a dashed line where a "step over" its limit passes 1. Panels are as wide as their
/// columns; what does not fit continues in the next row.
void draw_outcome_maps(Canvas& canvas, const Box& box,
                       const std::vector<record::StabilityRow>& rows, const std::string& title);

/// `<stem>.png` and `<stem>.svg`.
Result<void> write_outcome_maps(const std::filesystem::path& stem,
                                const std::vector<record::StabilityRow>& rows,
                                const std::string& title, double width_mm = 178);

}  // namespace gridshell::render
