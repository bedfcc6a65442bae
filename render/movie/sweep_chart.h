// Charts of a sweep: a figure (named number) of its runs over one or two keys, and fitted power
// laws.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/sweep_results.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// The label of a key or a figure with its unit, as text with markup: "height (mm)".
std::string label_of(const std::string& name);

/// One axis of a sweep: its values in the order of the table, as texts and as numbers. Values that
/// are not numbers have the numbers 1, 2, ..., which the label explains.
struct SweepScale {
  std::string label;
  std::vector<std::string> texts;
  std::vector<double> numbers;
  bool is_number = true;
};

/// The scale of axis `k` of a table, or of its seeds if it has no axis.
SweepScale scale_of(const record::SweepTable& table, std::size_t k);

/// Index of a row's value on the scale of axis `k`.
std::size_t index_on_scale(const record::SweepTable& table, const SweepScale& scale,
                           const record::SweepTable::Row& row, std::size_t k);

/// A row's figure as a number, NaN if it has none; the absolute value of largest_strain.
double number_of(const record::SweepTable::Row& row, const std::string& figure);

/// The limit at which a row's run ended: "locking"; empty: none.
std::string limit_of(const record::SweepTable::Row& row);

/// Whether a row's run ended in a state that is not stable.
bool is_unstable(const record::SweepTable::Row& row);

/// The names of the cases in their order; one empty name if there are no cases.
std::vector<std::string> cases_of(const record::SweepTable& table);

/// What a chart shows of a sweep.
struct SweepView {
  std::string figure = {};  ///< "max_deviation"
  std::string x = {};       ///< a figure along x; empty: the key
  /// fraction by which a curve differs from its value at the right where this is marked; 0: no mark
  double departure = 0;
  std::string title = {};  ///< plain text
};

/// The largest x at which y differs from its value at the right end by more than `fraction` of it,
/// interpolated linearly between points, in log x if all x are positive. Points that are not finite
/// are ignored. Empty if y never does.
std::optional<double> deviation_onset(const std::vector<double>& x, const std::vector<double>& y,
                                      double fraction);

/// The figure over one key, a curve per case; with seeds the curve is their mean and each run has a
/// mark. Runs that ended at a limit are hollow, unstable ones crossed; a run without the figure is
/// a grey cross at the lower edge. An axis is logarithmic if its numbers are positive and span more
/// than a factor of 20.
Plot sweep_plot(const record::SweepTable& table, const SweepView& view);

/// The figure over the first key of its power law, with a mark per point. A law of one key is a
/// line; one of several keys is a cross at each point. There is at least one law.
Plot law_plot(const std::vector<record::PowerLaw>& laws, const SweepView& view);

/// Writes the figure over two keys as a map, `<stem>.png`, `.svg` and `.pdf`: a panel per case,
/// each cell the mean over the seeds; crossed if no run has a state, with a diamond if one is
/// unstable, dotted if one ended at a limit. A sentence if no run has the figure. Errors:
/// Fault::io.
Result<void> write_sweep_map(const std::filesystem::path& stem, const record::SweepTable& table,
                             const SweepView& view, const Print& print = {});

}  // namespace gridshell::render
