// A sweep as pictures: a figure of the runs over the key that was swept, or over two of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/record/sweep.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// What is drawn.
struct SweepView {
  std::string figure = {};  ///< "max_deviation"
  std::string x = {};       ///< a figure in the place of the key; empty: the key
  double departure = 0;     ///< share by which a curve has left its value at the right where that
                            ///< is marked; 0: nowhere
  std::string title = {};   ///< plain
};

/// Where y, from the largest x to the smaller ones, first differs from its value there by more than
/// `share` of it: linear between points, in log x where all x are positive. Points that are not
/// finite are passed over. Empty where it never does.
std::optional<double> departure_of(const std::vector<double>& x, const std::vector<double>& y,
                                   double share);

/// The figure over the one key, a curve a case (the mean over the seeds, each run a mark). Runs
/// that met a limit are hollow, those that are not stable crossed; where there is no state a grey
/// cross stands on the lower edge. Axes are logarithmic where the numbers are positive and span
/// more than a factor of 20.
Plot sweep_plot(const record::SweepTable& table, const SweepView& view);

/// The figure over two keys as a map, `<stem>.png`, `.svg`, `.pdf`: a panel a case, each cell the
/// mean over the seeds; crossed where there is no state, dotted where a limit was met.
Result<void> write_sweep_map(const std::filesystem::path& stem, const record::SweepTable& table,
                             const SweepView& view);

}  // namespace gridshell::render
