#include "render/figure/accuracy_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell::render {
namespace {

using record::AccuracyRow;
using record::RunOutcome;

constexpr Colour ink{0.1f, 0.1f, 0.12f, 1}, front_grey{0.72f, 0.74f, 0.78f, 1};
constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};

bool is_auto(const std::string& method) { return method.starts_with(auto_prefix); }

/// "10^{−3}" of "auto 1e-03"
std::string power_of(const std::string& method) {
  const double tolerance = std::stod(method.substr(std::string(auto_prefix).size()));
  return fmt::format("10^{{−{}}}", -std::lround(std::log10(tolerance)));
}

/// In the order in which they first come, `auto` left out.
template <class Row>
std::vector<std::string> methods_of(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (!is_auto(row.method) && std::find(names.begin(), names.end(), row.method) == names.end())
      names.push_back(row.method);
  return names;
}

Series style_of(std::size_t index, const std::string& name) {
  Series series;
  series.name = name;
  series.colour = series_colour(index);
  series.marker = markers[index % std::size(markers)];
  series.marker_size = 4.2;
  // more methods than colours: the second round is dashed
  if (index >= 7) series.dash = {4, 2};
  return series;
}

/// The error that a method's mesh would leave.
double mesh_error(const std::vector<AccuracyRow>& rows, int edges) {
  for (const AccuracyRow& row : rows)
    if (row.method == "bend" && row.edges_per_segment == edges) return row.error;
  return record::unknown;
}

bool drawn(const AccuracyRow& row) {
  return row.outcome == RunOutcome::right && row.error > 0 && row.cpu_s > 0;
}

Plot empty_plot(const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x.logarithmic = plot.y.logarithmic = true;
  plot.x.ticks = plot.y.ticks = 9;
  plot.font_size = 8;
  plot.legend = LegendPlace::none;
  return plot;
}

Series front_of(const std::vector<AccuracyRow>& rows) {
  std::vector<AccuracyRow> methods;
  for (const AccuracyRow& row : rows)
    if (!is_auto(row.method)) methods.push_back(row);
  Series front;
  front.name = "Pareto front";
  front.colour = front_grey;
  front.line_width = 5;
  for (std::size_t k : record::pareto_front(methods)) {
    front.x.push_back(methods[k].cpu_s);
    front.y.push_back(methods[k].error);
  }
  return front;
}

/// Methods that were stopped: hollow, at the limit.
void add_stopped(const std::vector<AccuracyRow>& rows, const std::vector<std::string>& names,
                 Plot& plot) {
  double limit = 0;
  for (std::size_t m = 0; m < names.size(); ++m)
    for (const AccuracyRow& row : rows) {
      if (row.method != names[m] || row.outcome != RunOutcome::too_slow) continue;
      Series stopped = style_of(m, "");
      stopped.hollow = true;
      stopped.line_width = 0;
      stopped.marker_size = 5.5;
      stopped.x = {row.cpu_s};
      stopped.y = {mesh_error(rows, row.edges_per_segment)};
      if (!(stopped.y[0] > 0)) continue;
      limit = std::max(limit, row.cpu_s);
      plot.series.push_back(std::move(stopped));
    }
  if (limit > 0) plot.references.push_back({.horizontal = false, .at = limit, .label = "too slow"});
}

/// `auto` in one mark for all tolerances that come to the same meshes.
void add_auto(const std::vector<AccuracyRow>& rows, Plot& plot) {
  Series marks;
  marks.name = "auto, by tolerance";
  marks.colour = ink;
  marks.marker = Marker::circle;
  marks.hollow = true;
  marks.line_width = 0;
  marks.marker_size = 9;
  std::vector<Note> notes;
  for (const AccuracyRow& row : rows) {
    if (!is_auto(row.method) || !drawn(row)) continue;
    const std::string label = power_of(row.method);
    const bool again = !marks.y.empty() && std::abs(std::log(row.error / marks.y.back())) < 0.01;
    if (again) {
      notes.back().text += ", " + label;
      continue;
    }
    marks.x.push_back(row.cpu_s);
    marks.y.push_back(row.error);
    notes.push_back({.x = row.cpu_s / 1.25,
                     .y = row.error,
                     .text = label,
                     .align_x = AlignX::right,
                     .align_y = AlignY::middle});
  }
  if (marks.x.empty()) return;
  // beneath the curves, which stay whole inside the rings
  plot.series.insert(plot.series.begin() + 1, marks);
  plot.notes.insert(plot.notes.end(), notes.begin(), notes.end());
}

}  // namespace

Plot accuracy_plot(const std::vector<AccuracyRow>& rows, const std::string& title) {
  Plot plot = empty_plot(title);
  plot.x.label = "processor time from the certified start to the end (s)";
  plot.y.label = "largest joint error over *R*_{o} or *ρ*";
  plot.legend = LegendPlace::automatic;
  plot.series.push_back(front_of(rows));
  const auto names = methods_of(rows);
  for (std::size_t m = 0; m < names.size(); ++m) {
    Series series = style_of(m, names[m]);
    for (const AccuracyRow& row : rows) {
      if (row.method != names[m] || !drawn(row)) continue;
      series.x.push_back(row.cpu_s);
      series.y.push_back(row.error);
      series.x_span.push_back({row.cpu_min_s, row.cpu_max_s});
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  add_stopped(rows, names, plot);
  add_auto(rows, plot);
  return plot;
}

Plot unknowns_plot(const std::vector<AccuracyRow>& rows, const std::string& title) {
  Plot plot = empty_plot(title);
  plot.x.label = "unknowns";
  plot.y.label = "largest joint error over *R*_{o} or *ρ*";
  plot.legend = LegendPlace::automatic;
  const auto names = methods_of(rows);
  for (std::size_t m = 0; m < names.size(); ++m) {
    Series series = style_of(m, names[m]);
    for (const AccuracyRow& row : rows)
      if (row.method == names[m] && drawn(row)) {
        series.x.push_back(row.dof);
        series.y.push_back(row.error);
      }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot scaling_plot(const std::vector<record::ScalingRow>& rows, const std::string& title) {
  Plot plot = empty_plot(title);
  plot.x.label = "rods a direction, *n*";
  plot.y.label = "processor time (s)";
  plot.x.ticks = 12;
  plot.legend = LegendPlace::automatic;
  std::vector<std::string> names;
  for (const auto& row : rows)
    if (std::find(names.begin(), names.end(), row.method) == names.end())
      names.push_back(row.method);
  for (std::size_t m = 0; m < names.size(); ++m) {
    Series series = style_of(m, is_auto(names[m]) ? "auto, " + power_of(names[m]) : names[m]);
    for (const auto& row : rows)
      if (row.method == names[m] && row.outcome == RunOutcome::right) {
        series.x.push_back(row.rods);
        series.y.push_back(row.cpu_s);
      }
    const double power = record::exponent(series.x, series.y);
    if (std::isfinite(power)) series.name += fmt::format(", *n*^{{{:.1f}}}", power);
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

std::string failures_of(const std::vector<AccuracyRow>& rows) {
  std::string text;
  for (const AccuracyRow& row : rows) {
    if (row.outcome == RunOutcome::right || row.outcome == RunOutcome::too_slow) continue;
    // a net rung where there is no net is no failure
    if (row.edges_per_segment == 0 && row.outcome == RunOutcome::refused) continue;
    text += fmt::format("{}{} at {} ({})", text.empty() ? "" : "; ", row.method,
                        row.edges_per_segment, word_of(row.outcome));
  }
  return text;
}

}  // namespace gridshell::render
