#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/text.h"
#include "render/movie/run_figures.h"

namespace gridshell::render {
namespace {

/// The depth (mm) of a snap in the text of a frame's event: "snap at depth 66.180 mm".
std::optional<double> depth_of_snap(const record::Frame& frame) {
  const std::string begin = "snap at depth ";
  if (!frame.event.starts_with(begin)) return std::nullopt;
  const std::string number = frame.event.substr(begin.size());
  return parse_number<double>(number.substr(0, number.find(' ')));
}

/// Vertical lines at the depth of each snap, from the force before to the force after it. Both
/// forces are extrapolated from the nearest frames by their stiffness.
Series snaps_of(const Series& pushed, const record::Trajectory& run) {
  Series snaps = line_series("", pushed.colour, pushed.line_width, {3, 2});
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    const record::Frame& after = run.frames.head(k);
    if (!after.event.starts_with("snap")) continue;
    // frames of a motion in time have no force
    std::size_t at = k - 1;
    while (at > 0 && !std::isfinite(pushed.y[at])) --at;
    const record::Frame& before = run.frames.head(at);
    const double depth = depth_of_snap(after).value_or(after.depth_mm);
    const auto force = [&](const record::Frame& frame) {
      const double slope = std::isfinite(frame.stiffness_N_per_mm) ? frame.stiffness_N_per_mm : 0;
      return frame.force_N + slope * (depth - frame.depth_mm);
    };
    snaps.add(before.depth_mm, before.force_N);
    snaps.add(depth, force(before));
    snaps.add(depth, force(after));
    snaps.add(after.depth_mm, after.force_N);
    snaps.part();
  }
  return snaps;
}

/// The pieces of the line between unstable states.
Series unstable_of(const Series& pushed, const record::Trajectory& run) {
  Series pieces = line_series("", pushed.colour, pushed.line_width, {1.2, 1.5});
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    const record::Frame &from = run.frames.head(k - 1), &to = run.frames.head(k);
    if (to.event.starts_with("snap") || std::max(from.negative_pivots, to.negative_pivots) <= 0)
      continue;
    pieces.add(from.depth_mm, from.force_N);
    pieces.add(to.depth_mm, to.force_N);
    pieces.part();
  }
  return pieces;
}

/// Interrupts the line at snaps and at unstable states, which have lines of their own.
void part_at_snaps(Series& pushed, const record::Trajectory& run) {
  for (std::size_t k = run.frames.size(); k-- > 1;)
    if (const record::Frame& from = run.frames.head(k - 1), &to = run.frames.head(k);
        (to.event.starts_with("snap") || std::max(from.negative_pivots, to.negative_pivots) > 0) &&
        std::isfinite(pushed.y[k - 1])) {
      pushed.x.insert(pushed.x.begin() + long(k), NAN);
      pushed.y.insert(pushed.y.begin() + long(k), NAN);
    }
}

/// Whether errors of the forces are larger than the width of the line.
bool errors_seen(const std::vector<NamedRun>& runs) {
  constexpr double line = 0.01;  // width of a line over the length of the axis
  double force = 0, error = 0;
  for (const NamedRun& one : runs)
    for (std::size_t k = 0; k < one.run->frames.size(); ++k) {
      const record::Frame& frame = one.run->frames.head(k);
      force = std::max(force, std::abs(frame.force_N));
      error = std::max(error, frame.push_error_N);
    }
  return error > line * force;
}

/// The force plus and minus its error as bands from snap to snap; none where the error is not
/// known.
std::vector<Band> error_bands(const record::Trajectory& run, Colour colour) {
  std::vector<Band> bands;
  colour.a = 0.25f;
  bool goes_on = false;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const record::Frame& frame = run.frames.head(k);
    const bool known = std::isfinite(frame.force_N) && std::isfinite(frame.push_error_N);
    if (known && (!goes_on || frame.event.starts_with("snap")))
      bands.push_back({.name = "", .colour = colour});
    goes_on = known;
    if (!known) continue;
    bands.back().x.push_back(frame.depth_mm);
    bands.back().low.push_back(frame.force_N - frame.push_error_N);
    bands.back().high.push_back(frame.force_N + frame.push_error_N);
  }
  return bands;
}

/// Whether `other` has the force of most points of a curve at the same depth, within a hundredth.
/// Of a long curve about a thousand points are compared.
bool is_mostly_on(const Series& curve, const Series& other) {
  constexpr double near = 0.01;  // of the largest force
  double largest = 0;
  for (const double force : curve.y) largest = std::fmax(largest, std::abs(force));
  const std::size_t stride = 1 + curve.x.size() / 1000;
  std::size_t on = 0, all = 0;
  for (std::size_t n = 0; n < curve.x.size(); n += stride, ++all) {
    double apart = INFINITY;
    for (std::size_t k = 1; k < other.x.size(); ++k) {
      const double part = (curve.x[n] - other.x[k - 1]) / (other.x[k] - other.x[k - 1]);
      if (part >= 0 && part <= 1)
        apart = std::fmin(
            apart, std::abs(other.y[k - 1] + part * (other.y[k] - other.y[k - 1]) - curve.y[n]));
    }
    on += apart <= near * largest;
  }
  return 2 * on > all;
}

/// A mark at the largest force, if the force then falls.
Series peak_of(const Series& pushed) {
  Series peak = mark_series("", pushed.colour, Marker::circle, 4, true);
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < pushed.y.size(); ++k)
    if (std::isfinite(pushed.y[k])) known.push_back(k);
  const auto at = std::ranges::max_element(known, {}, [&](std::size_t k) { return pushed.y[k]; });
  const bool rises_and_falls = at != known.begin() && at != known.end() && at + 1 != known.end();
  if (rises_and_falls) peak.add(pushed.x[*at], pushed.y[*at]);
  return peak;
}

}  // namespace

Plot force_plot(const std::vector<NamedRun>& runs) {
  constexpr Colour grey{0.4f, 0.4f, 0.4f, 1};
  Plot plot;
  plot.x = {.label = "depth *δ* (mm)", .low = 0};
  plot.y = {.label = "force (N)"};
  // series without points, for the rows of the legend that several runs have in common
  std::vector<Series> keys;
  const auto add = [&](Series pieces, const char* name) {
    if (pieces.x.empty()) return;
    if (std::ranges::find(keys, name, &Series::name) == keys.end()) {
      Series& key = keys.emplace_back(pieces);
      key.name = name;
      key.x.clear(), key.y.clear();
      if (runs.size() > 1) key.colour = grey;
    }
    plot.series.push_back(std::move(pieces));
  };
  const bool banded = errors_seen(runs);
  std::vector<Series> curves;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Series& curve =
        curves.emplace_back(line_series(runs.size() > 1 ? runs[k].name : "", series_colour(k)));
    // with many frames there are no markers, which would cover the line
    constexpr std::size_t most_marked = 24;
    if (runs[k].run->frames.size() <= most_marked) curve.marker = series_marker(k);
    for (std::size_t n = 0; n < runs[k].run->frames.size(); ++n) {
      const record::Frame& frame = runs[k].run->frames.head(n);
      curve.add(frame.depth_mm, frame.force_N);
    }
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Series& series = curves[k];
    // wider by each later one that is on it
    series.line_width +=
        0.8 *
        double(std::count_if(curves.begin() + long(k) + 1, curves.end(),
                             [&](const Series& later) { return is_mostly_on(series, later); }));
    for (Band& band : banded ? error_bands(*runs[k].run, series_colour(k)) : std::vector<Band>()) {
      if (plot.bands.empty()) band.name = "error of the force";
      plot.bands.push_back(std::move(band));
    }
    Series snaps = snaps_of(series, *runs[k].run), unstable = unstable_of(series, *runs[k].run);
    Series peak = peak_of(series);
    part_at_snaps(series, *runs[k].run);
    plot.series.push_back(std::move(series));
    add(std::move(unstable), "unstable");
    add(std::move(snaps), "snap to another state");
    add(std::move(peak), "largest force");
  }
  std::ranges::move(keys, std::back_inserter(plot.series));
  return plot;
}

}  // namespace gridshell::render
