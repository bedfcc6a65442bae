// Charts that compare methods: error over processor time and over unknowns, time over the number of
// rods, and maps of outcomes.
#pragma once

#include <string>
#include <vector>

#include "engine/record/study_tables.h"
#include "render/canvas/canvas.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// Rows whose method begins with this prefix are drawn as marks with their tolerances, not as a
/// curve.
inline constexpr const char* auto_prefix = "auto ";

/// The largest error of a joint over the length scale, over processor time, log-log: one curve per
/// method with bars from its fastest to its slowest run, over the Pareto front, and marks of
/// `auto`. A method that was stopped is hollow at the time limit, at the error of `bend` on its
/// mesh; failed ones are in failures_of(). `of_sizes`: rows are those of one method at several
/// sizes, without a front.
Plot accuracy_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title,
                   bool of_sizes = false);

/// These errors over the number of unknowns.
Plot unknowns_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title);

/// Processor time over rods per direction, log-log, with the exponents in the legend.
Plot scaling_plot(const std::vector<record::ScalingRow>& rows, const std::string& title);

/// Methods that failed, with their edges per segment: "implicit Euler at 1 (blow_up); ...".
std::string failures_of(const std::vector<record::AccuracyRow>& rows);

// Maps of outcomes: cells coloured by the outcome of a run.

/// Colour of an outcome. Silently wrong ones are dark and warm, and their cells have crosses.
Colour outcome_colour(record::RunOutcome outcome);

/// The outcome in the legend: "right", "silent: planar saddle", ...
std::string outcome_label(record::RunOutcome outcome);

/// Height (points) of draw_outcome_maps() at this width.
double outcome_maps_height(const std::vector<record::StabilityRow>& rows, double width);

/// Draws one row of panels per map, one panel per method: x along the columns, y along the rows, a
/// legend below, and a dashed line where x, a "step over" a limit, exceeds 1. Panels are as wide as
/// their columns; those that do not fit continue in the next row.
void draw_outcome_maps(Canvas& canvas, const Box& box,
                       const std::vector<record::StabilityRow>& rows, const std::string& title);

/// Writes the maps as `<stem>.png`, `.svg` and `.pdf`. Errors: Fault::io.
Result<void> write_outcome_maps(const std::filesystem::path& stem,
                                const std::vector<record::StabilityRow>& rows,
                                const std::string& title, double width_mm = 178);

}  // namespace gridshell::render
