#include "render/movie/sweep_chart.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "engine/core/text.h"
#include "engine/preset/field_table.h"
#include "engine/record/frame_values.h"
#include "render/canvas/canvas.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

using record::SweepTable;

/// A value of a key as short text: 1.0 as 1, a string without its quotes.
std::string short_text(const std::string& value) {
  if (value.size() > 1 && value.front() == '"') return value.substr(1, value.size() - 2);
  if (value.ends_with(".0")) return value.substr(0, value.size() - 2);
  return value;
}

const std::string& text_of(const SweepTable& table, const SweepTable::Row& row, std::size_t k,
                           std::string& seed) {
  if (!table.axes.empty()) return row.keys.values[k];
  return seed = std::to_string(row.keys.seed);
}

constexpr Colour grey_ink{0.45f, 0.45f, 0.48f, 1};

/// One run in the picture.
struct SweepMark {
  double x = 0, y = 0;
  std::size_t index = 0;  // index of its key on the scale
  std::string limit;
  bool stable = true;
};

/// The runs of one case in the picture.
struct Curve {
  std::vector<SweepMark> spots;
  std::vector<double> lost;  // x of runs without a state
};

Curve curve_of(const SweepTable& table, const SweepScale& scale, const SweepView& view,
               const std::string& one) {
  Curve curve;
  for (const auto& row : table.rows) {
    if (row.keys.case_name != one) continue;
    const std::size_t index = index_on_scale(table, scale, row, 0);
    const double key = scale.numbers[index];
    const double x = view.x.empty() ? key : number_of(row, view.x);
    const double y = number_of(row, view.figure);
    if (std::isfinite(x) && std::isfinite(y))
      curve.spots.push_back({x, y, index, limit_of(row), !is_unstable(row)});
    else if (std::isfinite(x) && row.result.outcome != record::PointOutcome::done)
      curve.lost.push_back(x);
  }
  return curve;
}

bool spans_decades(const std::vector<double>& values) {
  if (values.empty()) return false;
  const auto [low, high] = std::ranges::minmax(values);
  return low > 0 && high > 20 * low;
}

/// The mean over the seeds, from left to right.
Series mean_of(const Curve& curve) {
  std::vector<std::size_t> order(curve.spots.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return curve.spots[k].index; });
  Series mean;
  for (std::size_t k = 0; k < order.size();) {
    double x = 0, y = 0;
    std::size_t n = 0;
    for (const auto index = curve.spots[order[k]].index;
         k < order.size() && curve.spots[order[k]].index == index; ++k, ++n) {
      x += curve.spots[order[k]].x;
      y += curve.spots[order[k]].y;
    }
    mean.add(x / double(n), y / double(n));
  }
  // the figure along x may decrease with the key
  if (!mean.x.empty() && mean.x.front() > mean.x.back()) {
    std::ranges::reverse(mean.x);
    std::ranges::reverse(mean.y);
  }
  return mean;
}

template <class Predicate>
Series marks_of(const Curve& curve, Series style, const Predicate& requested) {
  style.x.clear();
  style.y.clear();
  style.name.clear();
  style.line_width = 0;
  for (const SweepMark& spot : curve.spots)
    if (requested(spot)) style.add(spot.x, spot.y);
  return style;
}

void add_curve(const Curve& curve, const std::string& name, std::size_t index, bool seeds,
               Plot& plot) {
  Series line = mean_of(curve);
  if (line.x.empty()) return;
  line.name = name;
  line.colour = series_colour(index);
  line.marker = series_marker(index);
  const Series style = line;
  if (seeds) line.marker = Marker::none;
  plot.series.push_back(std::move(line));
  if (seeds) plot.series.push_back(marks_of(curve, style, [](const SweepMark&) { return true; }));
  Series hollow = marks_of(curve, style, [](const SweepMark& spot) { return !spot.limit.empty(); });
  hollow.hollow = true;
  hollow.marker_size += 0.5;
  Series crossed = marks_of(curve, style, [](const SweepMark& spot) { return !spot.stable; });
  crossed.marker = Marker::cross;
  crossed.marker_size += 3;
  plot.add(std::move(hollow));
  plot.add(std::move(crossed));
}

/// Adds rows of the legend that explain the marks.
void add_mark_legend(const std::vector<Curve>& curves, Plot& plot) {
  std::vector<SweepMark> spots;
  for (const Curve& curve : curves)
    spots.insert(spots.end(), curve.spots.begin(), curve.spots.end());
  const auto row = [&](const std::string& name, Marker marker, bool hollow) {
    plot.series.push_back(mark_series(name, grey_ink, marker, 4.5, hollow));
  };
  std::string which;
  for (const auto& limit : distinct(spots, &SweepMark::limit))
    if (!limit.empty()) which += (which.empty() ? "" : ", ") + limit;
  if (!which.empty()) row("ended early: " + plain(which), Marker::circle, true);
  if (std::ranges::any_of(spots, std::logical_not(), &SweepMark::stable))
    row("unstable", Marker::cross, false);
}

void add_failed(const std::vector<Curve>& curves, Plot& plot) {
  Series lost = mark_series("no state found", grey_ink, Marker::cross);
  double low = std::numeric_limits<double>::infinity();
  for (const Curve& curve : curves) {
    lost.x.insert(lost.x.end(), curve.lost.begin(), curve.lost.end());
    for (const SweepMark& spot : curve.spots) low = std::min(low, spot.y);
  }
  lost.y.assign(lost.x.size(), std::isfinite(low) ? low : 1);
  plot.add(std::move(lost));
}

void set_axes(const std::vector<Curve>& curves, Plot& plot) {
  std::vector<double> x, y;
  for (const Curve& curve : curves) {
    for (const SweepMark& spot : curve.spots) {
      x.push_back(spot.x);
      y.push_back(spot.y);
    }
    x.insert(x.end(), curve.lost.begin(), curve.lost.end());
  }
  plot.x.logarithmic = spans_decades(x);
  plot.y.logarithmic = spans_decades(y);
  plot.x.ticks = 8;
}

/// Adds a line at the onset of a curve's deviation from its value at the right, and a row of the
/// legend with its position.
void mark_departure(const Series& curve, Colour colour, double fraction, Plot& plot) {
  const auto at = deviation_onset(curve.x, curve.y, fraction);
  if (!at) return;
  const Stroke stroke{colour, 0.8, {3, 2}};
  plot.references.push_back({.horizontal = false, .at = *at, .label = "", .stroke = stroke});
  plot.series.push_back(
      line_series(fmt::format("differs by {:g} % at {}", 100 * fraction, scientific(*at, 2)),
                  colour, stroke.width, stroke.dash));
}

/// The factor from a column to the unit of its label: deviations are fractions in the table.
double shown_factor(const std::string& figure) {
  return figure.find("deviation") == figure.npos ? 1 : 100;
}

}  // namespace

std::string label_of(const std::string& name) {
  static const std::map<std::string, std::string> known{
      {"max_deviation", "largest deviation from the net, Δ/*ρ* (%)"},
      {"mean_deviation", "mean deviation from the net, Δ/*ρ* (%)"},
      {"median_deviation", "median deviation from the net, Δ/*ρ* (%)"},
      {"deviation_p90", "90 % quantile of the deviation from the net, Δ/*ρ* (%)"},
      {"largest_strain", "largest axial strain, by size"},
      {"stiffness_ratio", "*EA* *d*^{2}/*EI*"},
      {"total_K", "total *K*_{□} (rad)"},
      {"energy_bend_mJ", "bending energy (mJ)"},
      {"energy_stretch_mJ", "stretching energy (mJ)"},
      {"energy_twist_mJ", "torsional energy (mJ)"},
      {"energy_joint_mJ", "energy in joint springs (mJ)"},
      {"energy_shear_mJ", "energy of joint shear (mJ)"},
      {"energy_load_mJ", "energy of loads and ground (mJ)"},
      {"energy_support_mJ", "energy in springs of supports (mJ)"},
      {"energy_contact_mJ", "energy of contact (mJ)"},
      {"actuation.ratio", "*R*_{a}/*R*_{o}"},
      {"footprint.longest_leg", "longest leg *L̄*_{d}, in *d*"},
      {"footprint.rods", "rods per direction *n*"},
      {"rod.young_GPa", "Young's modulus *E* (GPa)"},
      {"actuation.radius_mm", "*R*_{a} (mm)"},
      {"footprint.radius_mm", "*R*_{o} (mm)"},
      {"footprint.spacing_mm", "spacing *d* (mm)"},
      {"rod.diameter_mm", "rod diameter *D* (mm)"},
      {"net.cut_height", "height of the cut *z*^{∗}/*ρ*"}};
  if (const auto at = known.find(name); at != known.end()) return at->second;
  const auto dot = name.find('.');
  const std::string key = dot == std::string::npos ? name : name.substr(dot + 1);
  std::string unit = preset::unit_of(key);
  const std::string word = preset::without_unit(key, unit);
  // powers are marked up: "kg/m^{3}"
  if (const auto power = unit.find('^'); power != std::string::npos)
    unit = unit.substr(0, power) + "^{" + unit.substr(power + 1) + "}";
  return plain(spaced(word)) + (unit.empty() ? "" : " (" + unit + ")");
}

SweepScale scale_of(const SweepTable& table, std::size_t k) {
  SweepScale scale;
  scale.label = table.axes.empty() ? "seed" : label_of(table.axes[k]);
  std::string seed;
  for (const auto& row : table.rows) {
    const std::string& text = text_of(table, row, k, seed);
    if (std::ranges::find(scale.texts, text) != scale.texts.end()) continue;
    scale.texts.push_back(text);
    const auto number = parse_number<double>(text);
    scale.is_number = scale.is_number && number;
    scale.numbers.push_back(number.value_or(0));
  }
  if (scale.is_number) return scale;
  scale.label += ": ";
  for (std::size_t n = 0; n < scale.texts.size(); ++n) {
    scale.numbers[n] = double(n + 1);
    scale.label +=
        (n == 0 ? "" : ", ") + std::to_string(n + 1) + " " + plain(short_text(scale.texts[n]));
  }
  return scale;
}

std::size_t index_on_scale(const SweepTable& table, const SweepScale& scale,
                           const SweepTable::Row& row, std::size_t k) {
  std::string seed;
  const auto at = std::ranges::find(scale.texts, text_of(table, row, k, seed));
  return std::size_t(at - scale.texts.begin());
}

double number_of(const SweepTable::Row& row, const std::string& figure) {
  const auto* found = row.result.figure(figure);
  const double number =
      found ? record::number_of(*found) : std::numeric_limits<double>::quiet_NaN();
  // its sign (tension or compression) differs from edge to edge
  return figure == "largest_strain" ? std::abs(number) : shown_factor(figure) * number;
}

std::string limit_of(const SweepTable::Row& row) {
  const auto* found = row.result.figure("limit");
  const auto* word = found ? std::get_if<std::string>(found) : nullptr;
  return !word || *word == "none" ? "" : *word;
}

bool is_unstable(const SweepTable::Row& row) {
  const auto* stable = row.result.figure("stable");
  return stable && record::number_of(*stable) == 0;
}

std::vector<std::string> cases_of(const SweepTable& table) {
  std::vector<std::string> cases;
  for (const auto& row : table.rows)
    if (std::ranges::find(cases, row.keys.case_name) == cases.end())
      cases.push_back(row.keys.case_name);
  return cases;
}

std::optional<double> deviation_onset(const std::vector<double>& x, const std::vector<double>& y,
                                      double fraction) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
    if (std::isfinite(x[k]) && std::isfinite(y[k])) points.emplace_back(x[k], y[k]);
  std::ranges::sort(points, std::greater<>());
  if (points.size() < 2 || !(fraction > 0)) return std::nullopt;
  const bool log = points.back().first > 0;
  const double last = points.front().second, allowed = fraction * std::abs(last);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double off = std::abs(points[k].second - last);
    if (!(off > allowed)) continue;
    const double before = std::abs(points[k - 1].second - last);
    const double part = (allowed - before) / (off - before);
    const auto [from, to] = std::pair(points[k - 1].first, points[k].first);
    return log ? from * std::pow(to / from, part) : from + part * (to - from);
  }
  return std::nullopt;
}

Plot law_plot(const std::vector<record::PowerLaw>& laws, const SweepView& view) {
  Plot plot;
  plot.title = plain(view.title);
  plot.y.label = label_of(view.figure);
  const bool one_key =
      std::ranges::all_of(laws, [](const auto& law) { return law.keys.size() == 1; });
  plot.x.label = label_of(laws.front().keys.front().key);
  plot.x.logarithmic = plot.y.logarithmic = true;
  const double factor = shown_factor(view.figure);
  const auto shown = [&](std::vector<double> values) {
    for (double& value : values) value *= factor;
    return values;
  };
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const record::PowerLaw& one = laws[k];
    const std::string name = plain(one.keys.front().case_name);
    Series marks =
        mark_series(name.empty() ? "computed" : name, series_colour(k), series_marker(k));
    marks.x = one.first_key;
    marks.y = shown(one.found);
    const auto [low, high] = std::ranges::minmax(marks.x);
    plot.add(std::move(marks));
    for (const record::LawRow& key : one.keys) {
      std::string power = record::with_error(key.exponent, key.error, "");
      if (power.starts_with('-')) power.replace(0, 1, "−");
      // a law of one key is a line, one of several keys a cross at each point; every key has a row
      // of the legend
      const bool first = &key == &one.keys.front();
      Series row = line_series(fmt::format("fitted power {} of {}", power, label_of(key.key)),
                               series_colour(k), one_key ? 1 : 0);
      if (!one_key && first) row.marker = Marker::cross;
      row.x = one_key ? std::vector{low, high} : one.first_key;
      row.y = shown(one_key ? std::vector{one.factor * std::pow(low, key.exponent),
                                          one.factor * std::pow(high, key.exponent)}
                            : one.law);
      plot.add(std::move(row));
    }
  }
  return plot;
}

Plot sweep_plot(const SweepTable& table, const SweepView& view) {
  const SweepScale scale = scale_of(table, 0);
  const auto cases = cases_of(table);
  Plot plot;
  plot.title = plain(view.title);
  plot.x.label = view.x.empty() ? scale.label : label_of(view.x);
  plot.y.label = label_of(view.figure);
  std::vector<Curve> curves;
  for (const auto& one : cases) curves.push_back(curve_of(table, scale, view, one));
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string name = cases.size() > 1 ? plain(cases[k]) : "";
    add_curve(curves[k], name, k, table.has_seeds && !table.axes.empty(), plot);
  }
  set_axes(curves, plot);
  // curves over several decades have no limit value
  for (std::size_t k = 0; k < cases.size() && !plot.y.logarithmic; ++k)
    mark_departure(mean_of(curves[k]), series_colour(k), view.departure, plot);
  add_mark_legend(curves, plot);
  add_failed(curves, plot);
  if (plot.series.empty())
    plot.series.push_back(mark_series("no run has a value", grey_ink, Marker::none));
  return plot;
}

}  // namespace gridshell::render
