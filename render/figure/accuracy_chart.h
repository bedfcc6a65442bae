// Charts of methods: error over processor time and over unknowns, time over the number of rods.
#pragma once

#include <string>
#include <vector>

#include "engine/record/charts.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// Rows whose method begins with "auto " are marks with their tolerances, not a curve.
inline constexpr const char* auto_prefix = "auto ";

/// Largest joint error over the length scale against processor time, log-log, one curve a method
/// with bars from its fastest to its slowest run, the Pareto front beneath, what `auto` picks
/// marked. A method that was stopped stands hollow at the time limit, at the error of the `bend`
/// row of its mesh; what failed is in failures_of().
Plot accuracy_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title);

/// The same errors over the number of unknowns.
Plot unknowns_plot(const std::vector<record::AccuracyRow>& rows, const std::string& title);

/// Time over rods a direction, log-log; the legend bears the exponents.
Plot scaling_plot(const std::vector<record::ScalingRow>& rows, const std::string& title);

/// "implicit Euler 1 (blow_up), ...": methods with edges a segment that gave nothing to draw.
std::string failures_of(const std::vector<record::AccuracyRow>& rows);

}  // namespace gridshell::render
