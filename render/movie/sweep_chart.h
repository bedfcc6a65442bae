// What of a sweep's table a picture needs: numbers on its axes, names with units.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/sweep_results.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// The name of a key or a figure as a picture says it, with its unit: "height (mm)".
std::string label_of(const std::string& name);

/// One axis of a sweep: its values in their order, as text and as numbers (their indices from 1
/// where they are no numbers).
struct SweepScale {
  std::string label;
  std::vector<std::string> texts;
  std::vector<double> numbers;
  bool is_number = true;
};

/// The scale of axis `k` of a table; of its seeds where it has no axis.
SweepScale scale_of(const record::SweepTable& table, std::size_t k);

/// A row's position on that scale.
std::size_t place_of(const record::SweepTable& table, const SweepScale& scale,
                     const record::SweepTable::Row& row, std::size_t k);

/// A row's figure as a number, NaN where it has none; of largest_strain its size.
double number_of(const record::SweepTable::Row& row, const std::string& figure);

/// The limit that a row's run met: "locking"; empty: none.
std::string limit_of(const record::SweepTable::Row& row);

/// The cases in their order; one without a name where there are none.
std::vector<std::string> cases_of(const record::SweepTable& table);

// A sweep as pictures: a figure of the runs over the key that was swept, or over two of them.

/// What is drawn.
struct SweepView {
  std::string figure = {};  ///< "max_deviation"
  std::string x = {};       ///< a figure instead of the key; empty: the key
  double departure = 0;    ///< fraction by which a curve has left its value at the right where that
                           ///< is marked; 0: nowhere
  std::string title = {};  ///< plain
};

/// Where y, from the largest x to the smaller ones, first differs from its value there by more than
/// `fraction` of it: linear between points, in log x where all x are positive. Points that are not
/// finite are passed over. Empty where it never does.
std::optional<double> deviation_onset(const std::vector<double>& x, const std::vector<double>& y,
                                      double fraction);

/// The figure over the one key, a curve a case (the mean over the seeds, each run a mark). Runs
/// that met a limit are hollow, those that are not stable crossed; where there is no state a grey
/// cross is on the lower edge. Axes are logarithmic where the numbers are positive and span
/// more than a factor of 20.
Plot sweep_plot(const record::SweepTable& table, const SweepView& view);

/// The figure over what its power law says, a mark a point, the law itself as a line.
Plot law_plot(const std::vector<record::PowerLaw>& laws, const SweepView& view);

/// The figure over two keys as a map, `<stem>.png`, `.svg`, `.pdf`: a panel a case, each cell the
/// mean over the seeds; crossed where there is no state, dotted where a limit was met.
Result<void> write_sweep_map(const std::filesystem::path& stem, const record::SweepTable& table,
                             const SweepView& view);

}  // namespace gridshell::render
