#include "render/movie/validation_charts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "render/canvas/legend.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

using record::AccuracyRow;
using record::RunOutcome;

constexpr Colour front_grey{0.72f, 0.74f, 0.78f, 1};

bool is_auto(const std::string& method) { return method.starts_with(auto_prefix); }

/// "10^{−3}" of "auto 1e-03"
std::string power_of(const std::string& method) {
  const double tolerance = std::stod(method.substr(std::string(auto_prefix).size()));
  return fmt::format("10^{{−{}}}", -std::lround(std::log10(tolerance)));
}

bool is_curve(const std::string& method) { return !is_auto(method); }

Series style_of(std::size_t index, const std::string& name) {
  Series series = line_series(name, series_colour(index));
  series.marker = series_marker(index);
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

/// A curve a method, of the rows that are drawn.
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

/// Methods that were stopped: hollow, at the limit.
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

/// `auto` in one mark for all tolerances that give the same meshes.
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
  // beneath the curves, which stay whole inside the rings
  plot.series.insert(plot.series.begin() + 1, marks);
  plot.notes.insert(plot.notes.end(), notes.begin(), notes.end());
}

using record::TrustClass;
using record::TrustRow;

constexpr double size = 7.5, bar_height = 13, row_height = 18, label_room = 88, title_room = 22,
                 legend_line = 14, width = 504, margin = 6;

std::string label(TrustClass found) { return spaced(std::string(word_of(found))); }

int count(const std::vector<TrustRow>& rows, const std::string& kind, TrustClass found) {
  return int(std::ranges::count_if(
      rows, [&](const TrustRow& row) { return row.kind == kind && row.found == found; }));
}

/// Colour of a class; what would be silently wrong is warm and dark.
Colour trust_colour(TrustClass found) {
  // from right to too_slow
  constexpr std::array<long, words_of<TrustClass>().size()> colours{
      0x8CC7A1, 0xE08A8D, 0xC0262B, 0xF0E2A8, 0xE9BE7C, 0xC9CDD3,
      0xA3A9B3, 0xB0417C, 0x9A6FB0, 0xE3E5E8, 0xA9C4E6};
  return hex_colour(colours[std::size_t(found)]);
}

void draw_bar(Canvas& canvas, const std::vector<TrustRow>& rows, const std::string& kind,
              const Box& box) {
  int all = 0;
  for (const auto& one : words_of<TrustClass>()) all += count(rows, kind, one.value);
  double x = box.x;
  for (const auto& one : words_of<TrustClass>()) {
    const int n = count(rows, kind, one.value);
    if (n == 0) continue;
    const double part = box.width * n / all;
    canvas.rectangle({x, box.y, part, box.height}, trust_colour(one.value), {white, 0.8});
    if (part > 10)
      canvas.text(fmt::format("{}", n), {x + part / 2, box.y + box.height / 2},
                  {.size = size - 1, .align_x = AlignX::centre, .align_y = AlignY::middle});
    x += part;
  }
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
  Plot plot = empty_plot(title, "rods a direction, *n*", "processor time (s)");
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
    // a row of the model net where there is no net is no failure
    if (row.edges_per_segment == 0 && row.outcome == RunOutcome::refused) continue;
    text += fmt::format("{}{} at {} ({})", text.empty() ? "" : "; ", row.method,
                        row.edges_per_segment, word_of(row.outcome));
  }
  return text;
}

Result<void> write_trust_bars(const std::filesystem::path& stem,
                              const std::vector<TrustRow>& rows) {
  const auto kinds = distinct(rows, &TrustRow::kind);
  const double height =
      title_room + row_height * double(kinds.size()) + 3 * legend_line + 3 * margin;
  const auto title =
      fmt::format("{} random scenes beside finer meshes of another family", rows.size());
  return write_figure(stem, width, height, title, [&](Canvas& canvas) {
    canvas.text(
        title, {width / 2, margin},
        {.size = size + 1.5, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::top});
    double y = title_room;
    for (const std::string& kind : kinds) {
      canvas.text(plain(kind), {margin + label_room - 5, y + bar_height / 2},
                  {.size = size, .align_x = AlignX::right, .align_y = AlignY::middle});
      draw_bar(canvas, rows, kind,
               {margin + label_room, y, width - 2 * margin - label_room, bar_height});
      y += row_height;
    }
    Patches patches{.row_width = width - 2 * margin, .row_height = legend_line, .font_size = size};
    patches.draw = [&](std::size_t k, const Box& box) {
      canvas.rectangle(box, trust_colour(TrustClass(k)));
    };
    for (const auto& one : words_of<TrustClass>()) patches.names.push_back(label(one.value));
    draw_patches(canvas, {margin, y + margin, 16, 9}, patches);
  });
}

Plot trust_plot(const std::vector<TrustRow>& rows) {
  Plot plot;
  plot.title = "Errors of joints beside what was estimated";
  plot.x = {.label = "error estimate over the length scale", .logarithmic = true};
  plot.y = {.label = "error over the length scale", .logarithmic = true};
  double low = 1, high = 1e-9;
  for (const auto& one : words_of<TrustClass>()) {
    Series series = mark_series(label(one.value), trust_colour(one.value));
    for (const TrustRow& row : rows) {
      if (row.found != one.value || !(row.error > 0) || !(row.estimate > 0)) continue;
      series.add(row.estimate, row.error);
      low = std::min(low, row.estimate);
      high = std::max(high, row.estimate);
    }
    plot.add(std::move(series));
  }
  if (low < high) {
    Series twice = line_series("twice the estimate", {0.3f, 0.3f, 0.3f, 1}, 1, {3, 2});
    for (const double end : {low, high}) twice.add(end, 2 * end);
    plot.add(std::move(twice));
  }
  return plot;
}

}  // namespace gridshell::render
