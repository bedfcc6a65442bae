#include "render/movie/validation_charts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "render/canvas/legend.h"

namespace gridshell::render {
namespace {

using record::AccuracyRow;
using record::RunOutcome;

constexpr Colour front_grey{0.72f, 0.74f, 0.78f, 1};

bool is_auto(const std::string& method) { return method.starts_with(auto_prefix); }

/// The tolerance in the name of a method: "10^{−3}" from "auto 1e-03".
std::string power_of(const std::string& method) {
  const double tolerance = std::stod(method.substr(std::string(auto_prefix).size()));
  return fmt::format("10^{{−{}}}", -std::lround(std::log10(tolerance)));
}

bool is_curve(const std::string& method) { return !is_auto(method); }

Series style_of(std::size_t index, const std::string& name) {
  Series series = line_series(name, series_colour(index));
  series.marker = series_marker(index);
  series.marker_size = 4.2;
  // there are more methods than colours: later ones are dashed
  if (index >= 7) series.dash = {4, 2};
  return series;
}

/// The error of a mesh itself: that of the method `bend` on it; NaN: not known.
double mesh_error(const std::vector<AccuracyRow>& rows, int edges) {
  for (const AccuracyRow& row : rows)
    if (row.method == "bend" && row.edges_per_segment == edges) return row.error;
  return record::unknown;
}

bool drawn(const AccuracyRow& row) {
  return row.outcome == RunOutcome::right && row.error > 0 && row.cpu_s > 0;
}

Plot empty_plot(const std::string& title, const std::string& x, const std::string& y) {
  Plot plot;
  plot.title = title;
  plot.x = {.label = x, .logarithmic = true, .ticks = 9};
  plot.y = {.label = y, .logarithmic = true, .ticks = 9};
  plot.font_size = 8;
  return plot;
}

Series front_of(const std::vector<AccuracyRow>& rows) {
  std::vector<AccuracyRow> methods;
  for (const AccuracyRow& row : rows)
    if (!is_auto(row.method)) methods.push_back(row);
  Series front = line_series("Pareto front", front_grey, 5);
  for (std::size_t k : record::pareto_front(methods)) front.add(methods[k].cpu_s, methods[k].error);
  return front;
}

/// Adds a curve per method, of the rows that are drawn.
void add_methods(const std::vector<AccuracyRow>& rows, const std::vector<std::string>& names,
                 bool over_time, Plot& plot) {
  for (std::size_t m = 0; m < names.size(); ++m) {
    Series series = style_of(m, names[m]);
    for (const AccuracyRow& row : rows) {
      if (row.method != names[m] || !drawn(row)) continue;
      series.add(over_time ? row.cpu_s : row.dof, row.error);
      if (over_time) series.x_span.push_back({row.cpu_min_s, row.cpu_max_s});
    }
    plot.add(std::move(series));
  }
}

/// Adds hollow marks for methods that were stopped, and a line at the time limit.
void add_stopped(const std::vector<AccuracyRow>& rows, const std::vector<std::string>& names,
                 Plot& plot) {
  double limit = 0;
  for (std::size_t m = 0; m < names.size(); ++m)
    for (const AccuracyRow& row : rows) {
      if (row.method != names[m] || row.outcome != RunOutcome::too_slow) continue;
      Series stopped = mark_series("", series_colour(m), series_marker(m), 5.5, true);
      stopped.add(row.cpu_s, mesh_error(rows, row.edges_per_segment));
      if (!(stopped.y[0] > 0)) continue;
      limit = std::max(limit, row.cpu_s);
      plot.series.push_back(std::move(stopped));
    }
  if (limit > 0) plot.references.push_back({.horizontal = false, .at = limit, .label = "too slow"});
}

/// Adds the marks of `auto`, one for all tolerances that give the same meshes.
void add_auto(const std::vector<AccuracyRow>& rows, Plot& plot) {
  Series marks = mark_series("auto, by tolerance", ink, Marker::circle, 9, true);
  std::vector<Note> notes;
  for (const AccuracyRow& row : rows) {
    if (!is_auto(row.method) || !drawn(row)) continue;
    const std::string label = power_of(row.method);
    const bool again = !marks.y.empty() && std::abs(std::log(row.error / marks.y.back())) < 0.01;
    if (again) {
      notes.back().text += ", " + label;
      continue;
    }
    marks.add(row.cpu_s, row.error);
    notes.push_back({.x = row.cpu_s / 1.25,
                     .y = row.error,
                     .text = label,
                     .align_x = AlignX::right,
                     .align_y = AlignY::middle});
  }
  if (marks.x.empty()) return;
  // below the curves, so that these are visible inside the rings
  plot.series.insert(plot.series.begin() + 1, marks);
  plot.notes.insert(plot.notes.end(), notes.begin(), notes.end());
}

}  // namespace

constexpr const char* error_label = "largest joint error over *R*_{o} or *ρ*";

Plot accuracy_plot(const std::vector<AccuracyRow>& rows, const std::string& title, bool of_sizes) {
  Plot plot =
      empty_plot(title, "processor time from the certified start to the end (s)", error_label);
  if (!of_sizes) plot.series.push_back(front_of(rows));
  const auto names = distinct(rows, &AccuracyRow::method, is_curve);
  add_methods(rows, names, true, plot);
  add_stopped(rows, names, plot);
  add_auto(rows, plot);
  return plot;
}

Plot unknowns_plot(const std::vector<AccuracyRow>& rows, const std::string& title) {
  Plot plot = empty_plot(title, "unknowns", error_label);
  add_methods(rows, distinct(rows, &AccuracyRow::method, is_curve), false, plot);
  return plot;
}

Plot scaling_plot(const std::vector<record::ScalingRow>& rows, const std::string& title) {
  Plot plot = empty_plot(title, "rods per direction, *n*", "processor time (s)");
  plot.x.ticks = 12;
  const auto names = distinct(rows, &record::ScalingRow::method);
  for (std::size_t m = 0; m < names.size(); ++m) {
    Series series = style_of(m, is_auto(names[m]) ? "auto, " + power_of(names[m]) : names[m]);
    for (const auto& row : rows)
      if (row.method == names[m] && row.outcome == RunOutcome::right)
        series.add(row.rods, row.cpu_s);
    const double power = record::exponent(series.x, series.y);
    if (std::isfinite(power)) series.name += fmt::format(", *n*^{{{:.1f}}}", power);
    plot.add(std::move(series));
  }
  return plot;
}

std::string failures_of(const std::vector<AccuracyRow>& rows) {
  std::string text;
  for (const AccuracyRow& row : rows) {
    if (row.outcome == RunOutcome::right || row.outcome == RunOutcome::too_slow) continue;
    // a refused row of the net model on a shell without a net is not a failure
    if (row.edges_per_segment == 0 && row.outcome == RunOutcome::refused) continue;
    text += fmt::format("{}{} at {} ({})", text.empty() ? "" : "; ", row.method,
                        row.edges_per_segment, word_of(row.outcome));
  }
  return text;
}

}  // namespace gridshell::render
