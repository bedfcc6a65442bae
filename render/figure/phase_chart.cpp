#include "render/figure/phase_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/record/legs.h"

namespace gridshell::render {
namespace {

using record::PhaseDiagram;
using record::PhasePoint;
using record::StateClass;
using record::StateCount;

constexpr double high = 0.84;  // of the picture, over its width
constexpr Colour grey{0.42f, 0.42f, 0.45f, 1};

/// How a class is drawn, and where beside the point, in steps between points.
struct ClassMark {
  StateClass kind;
  const char* name;
  Marker marker;
  double size, right, up;
};
constexpr std::array<ClassMark, 4> marks{{
    {StateClass::i, "*i*", Marker::circle, 5, -0.2, 0.17},
    {StateClass::ii, "*ii*", Marker::square, 4.6, 0.02, 0.17},
    {StateClass::iii, "*iii*", Marker::diamond, 5.6, -0.2, -0.17},
    {StateClass::iv, "*iv*", Marker::triangle, 5.2, 0.02, -0.17},
}};
constexpr double others_right = 0.15;  // of the number beside them

/// The smallest distance between different values.
double step_of(std::vector<double> values) {
  std::ranges::sort(values);
  double step = 0;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double gap = values[k] - values[k - 1]; gap > 0 && (step == 0 || gap < step))
      step = gap;
  return step > 0 ? step : 1;
}

/// What any search of a footprint found.
StateCount any(const StateCount& a, const StateCount& b) {
  return {std::max(a.states, b.states), a.met + b.met, a.met_confined + b.met_confined};
}

PhaseDiagram by_footprint(const PhaseDiagram& diagram) {
  std::map<std::pair<double, int>, PhasePoint> points;
  for (const PhasePoint& point : diagram) {
    auto [at, is_new] = points.try_emplace({point.longest_leg, point.rods}, point);
    if (is_new) continue;
    at->second.found |= point.found;
    for (std::size_t k = 0; k < point.classes.size(); ++k)
      at->second.classes[k] = any(at->second.classes[k], point.classes[k]);
  }
  PhaseDiagram found;
  for (auto& [key, point] : points) found.push_back(point);
  return found;
}

/// The diagram's points on the plot.
class PhasePlot {
 public:
  PhasePlot(const PhaseDiagram& diagram, const std::string& title)
      : points_(by_footprint(diagram)) {
    std::vector<double> legs, rods;
    for (const PhasePoint& point : points_) {
      legs.push_back(point.longest_leg);
      rods.push_back(point.rods);
    }
    leg_step_ = step_of(legs);
    rod_step_ = step_of(rods);
    plot_.title = plain(title);
    plot_.x = {.label = "longest leg, *L̄*_{d} = *L*/*d*"};
    plot_.y = {.label = "rods a direction, *n*"};
    plot_.legend = LegendPlace::above;
    if (legs.empty()) return;
    const auto [short_leg, long_leg] = std::ranges::minmax(legs);
    const auto [few, many] = std::ranges::minmax(rods);
    plot_.x.low = std::max(0.0, short_leg - 0.6 * leg_step_);
    plot_.x.high = long_leg + 0.75 * leg_step_;
    plot_.y.low = few - 0.7 * rod_step_;
    plot_.y.high = many + 0.7 * rod_step_;
    plot_.y.ticks = int(std::min(12.0, (many - few) / rod_step_ + 1));
  }

  Plot take() && {
    add_places();
    for (const double leg : {1.0, 0.0, -1.0}) add_line(leg);
    for (const ClassMark& mark : marks) {
      add_class(mark, false);
      add_class(mark, true);
    }
    add_key("from symmetric forms alone", Marker::circle, true);
    add_key("+*n*: *n* other states", Marker::none, false);
    add_others();
    add_nothing();
    return std::move(plot_);
  }

 private:
  /// L_d over n at one shortest leg.
  void add_line(double leg) {
    constexpr int pieces = 120;
    Series line{.name = leg == 1 ? "*l̄*_{d} = 1, 0, −1 (from right to left)" : ""};
    line.colour = grey;
    line.line_width = 1;
    line.dash = leg == 1   ? std::vector<double>{}
                : leg == 0 ? std::vector<double>{5, 2.5}
                           : std::vector<double>{1.5, 2};
    for (int k = 0; k <= pieces; ++k) {
      const double n = *plot_.y.low + (*plot_.y.high - *plot_.y.low) * k / pieces;
      const double at = record::longest_leg_at(leg, n);
      const bool inside = leg + 0.5 * (n - 1) >= 0 && at >= *plot_.x.low && at <= *plot_.x.high;
      line.x.push_back(inside ? at : std::nan(""));
      line.y.push_back(n);
    }
    plot_.series.push_back(std::move(line));
  }

  void add_class(const ClassMark& mark, bool by_trials) {
    Series series{.name = by_trials ? fmt::format("state {}", mark.name) : ""};
    series.colour = series_colour(std::size_t(mark.kind));
    series.marker = mark.marker;
    series.marker_size = mark.size;
    series.line_width = 0;
    series.hollow = !by_trials;
    for (const PhasePoint& point : points_) {
      const StateCount& count = point.of(mark.kind);
      if (count.states == 0 || (count.met > 0) != by_trials) continue;
      series.x.push_back(point.longest_leg + mark.right * leg_step_);
      series.y.push_back(point.rods + mark.up * rod_step_);
    }
    plot_.series.push_back(std::move(series));
  }

  /// A dot where each footprint belongs that its marks stand around.
  void add_places() {
    Series dots;
    dots.colour = grey;
    dots.marker = Marker::circle;
    dots.marker_size = 1.6;
    dots.line_width = 0;
    for (const PhasePoint& point : points_) {
      dots.x.push_back(point.longest_leg);
      dots.y.push_back(point.rods);
    }
    plot_.series.push_back(std::move(dots));
  }

  /// A row of the legend that says how to read a sign.
  void add_key(const std::string& text, Marker marker, bool hollow) {
    Series series{.name = text};
    series.colour = grey;
    series.marker = marker;
    series.marker_size = 5;
    series.hollow = hollow;
    series.line_width = 0;
    plot_.series.push_back(std::move(series));
  }

  void add_others() {
    for (const PhasePoint& point : points_)
      if (const int others = point.of(StateClass::other).states; others > 0)
        plot_.notes.push_back({point.longest_leg + others_right * leg_step_, double(point.rods),
                               fmt::format("+{}", others), AlignX::left, AlignY::middle, grey});
  }

  void add_nothing() {
    Series series{.name = "none found"};
    series.colour = grey;
    series.marker = Marker::cross;
    series.line_width = 0;
    for (const PhasePoint& point : points_) {
      if (point.found) continue;
      series.x.push_back(point.longest_leg);
      series.y.push_back(point.rods);
    }
    if (!series.x.empty()) plot_.series.push_back(std::move(series));
  }

  PhaseDiagram points_;
  double leg_step_ = 1, rod_step_ = 1;
  Plot plot_;
};

}  // namespace

Plot phase_plot(const PhaseDiagram& diagram, const std::string& title) {
  return PhasePlot(diagram, title).take();
}

Result<void> write_phase_chart(const std::filesystem::path& stem, const PhaseDiagram& diagram,
                               const std::string& title, const Print& print) {
  return write_plot(stem, phase_plot(diagram, title), print, high);
}

}  // namespace gridshell::render
