#include "render/movie/state_charts.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

constexpr double half_bar = 0.22;  // over the distance between states
constexpr int pieces = 40;

/// Adds half a cosine wave from one height to another.
void add_flank(Series& curve, double from_x, double from, double to_x, double to) {
  for (int k = 0; k <= pieces; ++k) {
    const double s = double(k) / pieces;
    curve.add(from_x + s * (to_x - from_x), from + (to - from) * 0.5 * (1 - std::cos(M_PI * s)));
  }
}

using record::PhaseDiagram;
using record::PhasePoint;
using record::StateClass;
using record::StateCount;

constexpr double high = 0.84;  // height of the picture over its width
constexpr Colour grey_ink{0.42f, 0.42f, 0.45f, 1};

/// The size of a class's marker and its position next to the point, in steps between points.
struct ClassMark {
  StateClass kind;
  const char* name;
  double size, right, up;
};
constexpr std::array<ClassMark, 4> marks{{
    {StateClass::i, "*i*", 5, -0.2, 0.17},
    {StateClass::ii, "*ii*", 4.6, 0.2, 0.17},
    {StateClass::iii, "*iii*", 5.6, -0.2, -0.17},
    {StateClass::iv, "*iv*", 5.2, 0.2, -0.17},
}};
constexpr double others_right = 0.3;  // position of the number of other states, in steps
constexpr double most_numbered = 12;  // with more columns there is no room for these numbers

/// The smallest distance between different values.
double step_of(std::vector<double> values) {
  std::ranges::sort(values);
  double step = 0;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double gap = values[k] - values[k - 1]; gap > 0 && (step == 0 || gap < step))
      step = gap;
  return step > 0 ? step : 1;
}

/// The combined result of two searches of one footprint.
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
    columns_ = double(std::set(legs.begin(), legs.end()).size());
    plot_.title = plain(title);
    plot_.x = {.label = "longest leg, *L̄*_{d} = *L*/*d*"};
    plot_.y = {.label = "rods per direction, *n*"};
    plot_.legend = LegendPosition::above;
    if (legs.empty()) return;
    const auto [short_leg, long_leg] = std::ranges::minmax(legs);
    const auto [few, many] = std::ranges::minmax(rods);
    plot_.x.low = std::max(0.0, short_leg - 0.6 * leg_step_);
    plot_.x.high = long_leg + 0.75 * leg_step_;
    plot_.y.low = few - 0.7 * rod_step_;
    plot_.y.high = many + 0.7 * rod_step_;
    // as many ticks as rows of data, and some more, since steps are rounded up
    plot_.y.ticks = int(std::min(12.0, (many - few) / rod_step_ + 3));
  }

  Plot take() && {
    add_footprints();
    for (const double leg : {1.0, 0.0, -1.0}) add_line(leg);
    for (const ClassMark& mark : marks) {
      add_class(mark, false);
      add_class(mark, true);
    }
    add_key("found from symmetric starts only", Marker::circle, true);
    add_others();
    add_nothing();
    return std::move(plot_);
  }

 private:
  /// Adds the line of L_d over n for one shortest leg.
  void add_line(double leg) {
    constexpr int pieces = 120;
    Series line =
        line_series(fmt::format("*l̄*_{{d}} = {}{:g}", leg < 0 ? "−" : "", std::abs(leg)), grey_ink);
    line.dash = leg == 1   ? std::vector<double>{}
                : leg == 0 ? std::vector<double>{5, 2.5}
                           : std::vector<double>{1.5, 2};
    for (int k = 0; k <= pieces; ++k) {
      const double n = *plot_.y.low + (*plot_.y.high - *plot_.y.low) * k / pieces;
      const double at = record::longest_leg_at(leg, n);
      const bool inside = leg + 0.5 * (n - 1) >= 0 && at >= *plot_.x.low && at <= *plot_.x.high;
      line.add(inside ? at : std::nan(""), n);
    }
    plot_.series.push_back(std::move(line));
  }

  void add_class(const ClassMark& mark, bool by_trials) {
    const ClassLook look = look_of(mark.kind);
    Series series =
        mark_series(by_trials ? fmt::format("state {}", mark.name) : "", look.colour, look.marker,
                    mark.size * std::min(1.0, std::sqrt(most_numbered / columns_)), !by_trials);
    for (const PhasePoint& point : points_) {
      const StateCount& count = point.of(mark.kind);
      if (count.states == 0 || (count.met > 0) != by_trials) continue;
      series.add(point.longest_leg + mark.right * leg_step_, point.rods + mark.up * rod_step_);
    }
    plot_.series.push_back(std::move(series));
  }

  /// Adds a dot at each footprint, around which its marks are arranged.
  void add_footprints() {
    Series dots = mark_series("", grey_ink, Marker::circle, 1.6);
    for (const PhasePoint& point : points_) dots.add(point.longest_leg, point.rods);
    plot_.series.push_back(std::move(dots));
  }

  /// Adds a row of the legend that explains a marker.
  void add_key(const std::string& text, Marker marker, bool hollow) {
    plot_.series.push_back(mark_series(text, grey_ink, marker, 5, hollow));
  }

  /// Adds the numbers of states that are in none of the paper's classes, if there is room for them.
  void add_others() {
    Series only = mark_series("other states only", grey_ink, Marker::diamond, 4, true);
    for (const PhasePoint& point : points_)
      if (point.of(StateClass::other).states > 0 &&
          std::ranges::none_of(
              marks, [&](const ClassMark& mark) { return point.of(mark.kind).states > 0; }))
        only.add(point.longest_leg, point.rods);
    plot_.add(std::move(only));
    if (columns_ > most_numbered) return;
    add_key("+*n*: *n* other states", Marker::none, false);
    for (const PhasePoint& point : points_)
      if (const int others = point.of(StateClass::other).states; others > 0)
        plot_.notes.push_back({point.longest_leg + others_right * leg_step_, double(point.rods),
                               fmt::format("+{}", others), AlignX::left, AlignY::middle, grey_ink});
  }

  void add_nothing() {
    Series series = mark_series("none found", grey_ink, Marker::cross);
    for (const PhasePoint& point : points_)
      if (!point.found) series.add(point.longest_leg, point.rods);
    plot_.add(std::move(series));
  }

  PhaseDiagram points_;
  double leg_step_ = 1, rod_step_ = 1, columns_ = 1;
  Plot plot_;
};

constexpr Colour ring_ink{0.55f, 0.55f, 0.58f, 1};
constexpr double room = 1.12;  // length of mirrors over the diameter of the boundary

/// Directions of the mirrors of a symmetry group, degrees.
std::vector<double> mirrors_of(const std::string& group) {
  if (group == "C4v") return {0, 45, 90, 135};
  if (group == "C2v_axes") return {0, 90};
  if (group == "C2v_diagonals") return {45, 135};
  return {};
}

double radius_of(const record::Layout& layout) {
  return layout.actuated_boundary.topRows<2>().colwise().norm().maxCoeff();
}

}  // namespace

ClassLook look_of(StateClass kind) {
  constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::diamond, Marker::triangle};
  if (kind == StateClass::other) return {grey_ink, Marker::circle};
  return {series_colour(std::size_t(kind)), markers[std::size_t(kind)]};
}

Plot barrier_plot(const record::StateTables& states) {
  Plot plot;
  plot.title = fmt::format("Barriers between states (heights found on {} edges per segment)",
                           states.search.judged_edges_per_segment);
  plot.y = {.label = "elastic energy; heights of barriers (mJ)"};
  plot.legend = LegendPosition::none;
  // energies of states are those of all tables. Passes were computed on another mesh: only their
  // heights above the states are used, which hardly depend on the mesh, as the energies do
  std::map<int, double> energy;
  const auto level_of = [&](const record::StateName& state) {
    return states.rows.at(std::size_t(int(state)) - 1).energy_mJ();
  };
  const auto pass_of = [&](const record::Barrier& one) {
    return 0.5 * (level_of(one.from) + one.barrier_mJ + level_of(one.to) + one.back_mJ);
  };
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const record::Barrier& one : states.barriers)
    if (one.to != 0 && one.from != one.to) {
      energy[one.from] = level_of(one.from);
      energy[one.to] = level_of(one.to);
      lowest = std::min({lowest, energy[one.from], energy[one.to]});
      highest = std::max(highest, pass_of(one));
    }
  const double off = 0.015 * (highest - lowest);  // distance of names from bars and passes
  std::map<int, double> column;
  for (const auto& [state, level] : energy) column.emplace(state, double(column.size() + 1));
  std::size_t colour = 0;
  for (const record::Barrier& one : states.barriers) {
    if (one.to == 0 || one.from == one.to) continue;
    Series curve = line_series("", series_colour(colour++));
    const double a = column.at(one.from), b = column.at(one.to), middle = 0.5 * (a + b);
    const double from = a + std::copysign(half_bar, b - a), to = b - std::copysign(half_bar, b - a);
    const double pass = pass_of(one);
    add_flank(curve, from, energy.at(one.from), middle, pass);
    add_flank(curve, middle, pass, to, energy.at(one.to));
    plot.series.push_back(std::move(curve));
    plot.notes.push_back({middle, pass + off, scientific(std::max(one.barrier_mJ, one.back_mJ), 3),
                          AlignX::centre, AlignY::bottom, plot.series.back().colour});
  }
  for (const auto& [state, level] : energy) {
    Series bar = line_series("", ink, 2.2);
    for (const double half : {-half_bar, half_bar}) bar.add(column.at(state) + half, level);
    plot.series.push_back(std::move(bar));
    plot.notes.push_back({column.at(state), level - off,
                          fmt::format("*{}*", states.rows.at(std::size_t(state) - 1).name()),
                          AlignX::centre, AlignY::top});
  }
  plot.x = {.label = "states in the order of their number, class.number", .ticks = 0};
  plot.x.low = 0.5;
  plot.x.high = double(column.size()) + 0.5;
  if (lowest <= highest) {
    // room for the texts above passes and below states
    plot.y.low = lowest - 0.16 * (highest - lowest);
    plot.y.high = highest + 0.2 * (highest - lowest);
  }
  return plot;
}

Plot phase_plot(const PhaseDiagram& diagram, const std::string& title) {
  return PhasePlot(diagram, title).take();
}

Result<void> write_phase_chart(const std::filesystem::path& stem, const PhaseDiagram& diagram,
                               const std::string& title, const Print& print) {
  return write_plot(stem, phase_plot(diagram, title), print, high);
}

std::vector<int> inflections_of(const record::StateRow& row) {
  std::vector<int> counts;
  std::istringstream words(row.inflections);
  for (std::string word; words >> word;)
    if (word != "|") counts.push_back(std::atoi(word.c_str()));
  return counts;
}

double state_map_scale(const Box& box, const record::Layout& layout) {
  return 0.5 * std::min(box.width, box.height) / (room * radius_of(layout));
}

void draw_state_map(Canvas& canvas, const Box& box, double units_per_mm,
                    const record::Layout& layout, const record::Frame& frame,
                    const record::StateRow& row) {
  const PlanView plan{box.middle(), {0, 0}, units_per_mm};
  const double outer = room * radius_of(layout);
  for (const double degrees : mirrors_of(row.group)) {
    const double angle = degrees * M_PI / 180;
    const Eigen::Vector3d end(outer * std::cos(angle), outer * std::sin(angle), 0);
    canvas.line(plan(-end), plan(end), {mirror_ink, 0.8, {4, 2, 1, 2}});
  }
  canvas.polyline(plan.line(layout.actuated_boundary), {ring_ink, 0.8}, true);
  const std::vector<int> inflections = inflections_of(row);
  for (std::size_t r = 0; r < layout.rods.size(); ++r) {
    const bool higher = r < inflections.size() && inflections[r] > 0;
    canvas.polyline(plan.line(frame.nodes(Eigen::all, layout.rods[r])),
                    {higher ? higher_order_ink : first_order_ink, 0.6});
  }
  if (row.group == "C4") {
    const double half = 2.6;
    const Point m = box.middle();
    canvas.rectangle({m.x - half, m.y - half, 2 * half, 2 * half}, mirror_ink);
  }
}

}  // namespace gridshell::render
