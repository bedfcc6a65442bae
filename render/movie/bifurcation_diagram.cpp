#include "render/movie/state_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <utility>

namespace gridshell::render {
namespace {

using record::BranchEvent;
using record::BranchPoint;

constexpr double width = 504, panel_height = 190, title_room = 20, legend_room = 20, margin = 4,
                 gap = 10;
constexpr double dash_on = 3.2, dash_off = 2.2;

bool has_radius(const std::vector<BranchPoint>& points) {
  return std::ranges::any_of(
      points, [](const BranchPoint& p) { return std::isfinite(p.boundary_radius_mm); });
}

/// The colour of a branch: black for the path itself; both sides of a bifurcation have one colour.
Colour colour_of(int branch) {
  return branch == 0 ? ink : series_colour(std::size_t(branch - 1) / 2);
}

/// The marker of an event.
struct EventMark {
  BranchEvent event;
  const char* name;
  Marker marker;
  bool hollow;
};
constexpr EventMark marks[] = {
    {BranchEvent::bifurcation, "bifurcation", Marker::circle, true},
    {BranchEvent::turn, "limit point", Marker::square, true},
    {BranchEvent::joins, "joins another branch", Marker::diamond, true},
    {BranchEvent::locking, "strain limit reached", Marker::triangle, false},
    {BranchEvent::lost, "followed no further", Marker::cross, false},
};

/// The position of a point in the panel.
class Coordinates {
 public:
  Coordinates(const std::vector<BranchPoint>& points, BranchAxis axis)
      : radius_(has_radius(points)), axis_(axis) {}
  double x(const BranchPoint& p) const { return radius_ ? p.boundary_radius_mm : p.progress; }
  double y(const BranchPoint& p) const {
    return axis_ == BranchAxis::height ? p.height_mm : p.amplitude;
  }

 private:
  bool radius_;
  BranchAxis axis_;
};

/// Whether the path to point `to` from the one before is stable. The stability of a state at an
/// event is not certain, and a branch begins with a state of another one: the other end then
/// decides.
bool stable_between(const std::vector<BranchPoint>& points, std::size_t to) {
  const BranchPoint &a = points[to - 1], &b = points[to];
  const bool begins = to == 1 || points[to - 2].branch != a.branch;
  if (a.event == BranchEvent::none && !(begins && a.branch > 0)) return a.stable();
  if (b.event == BranchEvent::none) return b.stable();
  return a.stable() && b.stable();
}

/// The branches in pieces that are all stable or all unstable.
std::vector<Series> pieces_of(const std::vector<BranchPoint>& points,
                              const Coordinates& coordinates) {
  std::vector<Series> pieces;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const BranchPoint &from = points[k - 1], &to = points[k];
    if (from.branch != to.branch) continue;
    const bool stable = stable_between(points, k);
    const bool begins = k == 1 || points[k - 2].branch != from.branch;
    if (begins || pieces.back().dash.empty() != stable) {
      Series piece = line_series("", colour_of(to.branch), to.branch == 0 ? 1.3 : 1.1);
      if (!stable) piece.dash = {dash_on, dash_off};
      piece.add(coordinates.x(from), coordinates.y(from));
      pieces.push_back(std::move(piece));
    }
    pieces.back().add(coordinates.x(to), coordinates.y(to));
  }
  return pieces;
}

Series marks_of(const std::vector<BranchPoint>& points, const Coordinates& coordinates,
                const EventMark& mark) {
  Series series = mark_series("", ink, mark.marker, 4.2, mark.hollow);
  for (const BranchPoint& p : points)
    if (p.event == mark.event) series.add(coordinates.x(p), coordinates.y(p));
  return series;
}

/// The range of x with all events, if it is a small part of the axis; otherwise empty.
std::optional<std::pair<double, double>> close_up(const std::vector<BranchPoint>& points,
                                                  const Coordinates& coordinates) {
  double low = INFINITY, high = -INFINITY, least = INFINITY, most = -INFINITY;
  for (const BranchPoint& p : points) {
    least = std::min(least, coordinates.x(p));
    most = std::max(most, coordinates.x(p));
    if (p.event != BranchEvent::bifurcation && p.event != BranchEvent::turn &&
        p.event != BranchEvent::joins)
      continue;
    low = std::min(low, coordinates.x(p));
    high = std::max(high, coordinates.x(p));
  }
  if (!(high >= low) || high - low > (most - least) / 6) return std::nullopt;
  const double room = std::max(high - low, 0.01 * (most - least));
  return std::pair(std::max(least, low - room), std::min(most, high + room));
}

/// The part of a series between two x; lines are cut at these x.
Series cut(const Series& whole, double low, double high) {
  Series part = whole;
  part.x.clear();
  part.y.clear();
  const bool line = whole.line_width > 0;
  for (std::size_t k = 0; k < whole.x.size(); ++k) {
    const double x = whole.x[k];
    const bool inside = x >= low && x <= high;
    if (line && k > 0) {
      // the crossing of an end by the line from the point before
      const double x0 = whole.x[k - 1], y0 = whole.y[k - 1];
      for (const double end : x0 < x ? std::array{low, high} : std::array{high, low})
        if ((x0 - end) * (x - end) < 0)
          part.add(end, y0 + (whole.y[k] - y0) * (end - x0) / (x - x0));
    }
    if (inside)
      part.add(x, whole.y[k]);
    else if (line)
      part.part();
  }
  return part;
}

/// The panel with its x axis cut to a range, and its y axis to the values in it.
Plot part_of(Plot plot, const std::pair<double, double>& x) {
  double low = INFINITY, high = -INFINITY;
  for (Series& s : plot.series) {
    s = cut(s, x.first, x.second);
    for (const double y : s.y) {
      // NaN is ignored
      low = std::min(low, std::isnan(y) ? low : y);
      high = std::max(high, std::isnan(y) ? high : y);
    }
  }
  plot.x.low = x.first;
  plot.x.high = x.second;
  // a constant value is not enlarged to its round-off
  const double room = std::max(0.06 * (high - low), 1e-3);
  plot.y.low = low - room;
  plot.y.high = high + room;
  plot.x.ticks = 4;
  return plot;
}

void draw_legend(Canvas& canvas, const std::vector<BranchPoint>& points, Point at) {
  constexpr double size = 8, line = 20;
  const auto entry = [&](const std::string& text, double symbol) {
    const Box box =
        canvas.text(text, {at.x + symbol + 4, at.y}, {.size = size, .align_y = AlignY::middle});
    at.x = box.right() + 14;
  };
  canvas.line(at, {at.x + line, at.y}, {ink, 1.3});
  entry("stable", line);
  if (std::ranges::any_of(points, [](const BranchPoint& p) { return !p.stable(); })) {
    canvas.line(at, {at.x + line, at.y}, {ink, 1.3, {dash_on, dash_off}});
    entry("unstable", line);
  }
  for (const EventMark& mark : marks) {
    if (std::ranges::none_of(points, [&](const BranchPoint& p) { return p.event == mark.event; }))
      continue;
    canvas.marker(mark.marker, {at.x + 3, at.y}, 5, mark.hollow ? white : ink, {ink, 0.9});
    entry(mark.name, 6);
  }
}

using record::LoadPoint;

/// Adds a case's path in pieces that are all stable or all unstable; the first has its name.
void add_path(const std::vector<LoadPoint>& points, const std::string& name, Colour colour,
              Plot& plot) {
  const LoadPoint* before = nullptr;
  bool named = false, stable = true;
  Series piece;
  for (const LoadPoint& point : points) {
    if (point.load_case != name) continue;
    const bool now_stable = point.negative_pivots == 0;
    if (!before || now_stable != stable) {
      plot.add(std::move(piece));
      piece = line_series(named ? "" : plain(name), colour, 1.2);
      if (!now_stable) piece.dash = {3.2, 2.2};
      if (before) piece.add(before->way_mm, before->factor);
      named = true;
    }
    piece.add(point.way_mm, point.factor);
    before = &point;
    stable = now_stable;
  }
  plot.add(std::move(piece));
}

Series marks_of(const std::vector<LoadPoint>& points, BranchEvent event, const char* name,
                Marker marker) {
  Series marks = mark_series(name, ink, marker, 4.2, true);
  for (const LoadPoint& point : points)
    if (point.event == event) marks.add(point.way_mm, point.factor);
  return marks;
}

/// The points at which the rods of each case reach their strength: the factor with its error over
/// the displacement on the path of the finest mesh.
Series strength_marks(const std::vector<LoadPoint>& points,
                      const std::vector<record::LoadRow>& cases) {
  Series marks = mark_series("strength reached", ink, Marker::triangle, 4);
  for (const record::LoadRow& row : cases) {
    const auto reached = std::ranges::find_if(points, [&](const LoadPoint& point) {
      return point.load_case == row.load_case && point.utilisation >= 1;
    });
    if (!std::isfinite(row.strength_factor) || reached == points.end()) continue;
    double displacement = reached->way_mm;
    if (reached != points.begin() && reached[-1].load_case == row.load_case)
      displacement -= (reached->utilisation - 1) /
                      (reached->utilisation - reached[-1].utilisation) *
                      (displacement - reached[-1].way_mm);
    marks.add(displacement, row.strength_factor);
    marks.y_error.push_back(row.strength_error);
  }
  return marks;
}

}  // namespace

Plot branches_plot(const std::vector<BranchPoint>& points, BranchAxis axis) {
  const Coordinates coordinates(points, axis);
  Plot plot;
  plot.x.label = has_radius(points) ? "*R*_{a} (mm); actuation ←" : "progress; actuation →";
  plot.y.label = axis == BranchAxis::height ? "height (mm)" : "asymmetry, r.m.s. over length scale";
  plot.legend = LegendPosition::none;
  plot.font_size = 8;
  plot.series = pieces_of(points, coordinates);
  // the path itself is drawn last
  std::stable_partition(plot.series.begin(), plot.series.end(),
                        [](const Series& s) { return s.line_width < 1.2; });
  for (const EventMark& mark : marks) plot.add(marks_of(points, coordinates, mark));
  // the number of a branch in the table is at its end
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].branch > 0 &&
        (k + 1 == points.size() || points[k + 1].branch != points[k].branch))
      plot.notes.push_back({coordinates.x(points[k]), coordinates.y(points[k]),
                            std::to_string(points[k].branch), AlignX::right, AlignY::bottom,
                            colour_of(points[k].branch)});
  return plot;
}

Result<void> write_branches(const std::filesystem::path& stem,
                            const std::vector<BranchPoint>& points, const std::string& title) {
  std::vector<Plot> panels{branches_plot(points, BranchAxis::height),
                           branches_plot(points, BranchAxis::amplitude)};
  if (const auto part = close_up(points, Coordinates(points, BranchAxis::height)))
    for (std::size_t k = 0; k < 2; ++k) panels.push_back(part_of(panels[k], *part));
  const double rows = double(panels.size() / 2);
  const double height = 2 * margin + title_room + legend_room + rows * (panel_height + gap) - gap;
  return write_figure(stem, width, height, title, [&](Canvas& canvas) {
    canvas.text(plain(title), {margin, margin + title_room / 2},
                {.size = 9, .bold = true, .align_y = AlignY::middle});
    draw_legend(canvas, points, {margin + 2, margin + title_room + legend_room / 2});
    const double panel = (width - 2 * margin - gap) / 2;
    for (std::size_t k = 0; k < panels.size(); ++k)
      draw_plot(canvas,
                {margin + double(k % 2) * (panel + gap),
                 margin + title_room + legend_room + double(k / 2) * (panel_height + gap), panel,
                 panel_height},
                panels[k]);
  });
}

Plot load_plot(const std::vector<LoadPoint>& points, const std::vector<record::LoadRow>& cases,
               const std::string& title) {
  Plot plot;
  plot.title = plain(title);
  plot.x.label = "largest joint displacement (mm)";
  plot.y.label = "load factor";
  // if the factors differ much, those of each case are divided by its critical one, or by the
  // largest on its path
  constexpr double far_apart = 4;
  std::map<std::string, double> scale;
  for (const LoadPoint& point : points)
    scale[point.load_case] = std::max(scale[point.load_case], point.factor);
  bool all_critical = true;
  for (const record::LoadRow& row : cases)
    if (row.critical_factor > 0)
      scale[row.load_case] = row.critical_factor;
    else
      all_critical = false;
  const auto [least, most] = std::ranges::minmax(std::views::values(scale));
  std::vector<LoadPoint> shown = points;
  std::vector<record::LoadRow> rows = cases;
  if (least > 0 && most > far_apart * least) {
    plot.y.label = std::string("load factor over critical factor") +
                   (all_critical ? "" : ", or over the largest on its path");
    for (LoadPoint& point : shown) point.factor /= scale.at(point.load_case);
    for (record::LoadRow& row : rows) {
      row.strength_factor /= scale.at(row.load_case);
      row.strength_error /= scale.at(row.load_case);
    }
  } else {
    plot.references.push_back({.at = 1, .label = ""});
  }
  std::size_t next = 0;
  for (const auto& name : distinct(points, &LoadPoint::load_case))
    add_path(shown, name, series_colour(next++), plot);
  plot.add(marks_of(shown, BranchEvent::turn, "limit point", Marker::square));
  plot.add(marks_of(shown, BranchEvent::bifurcation, "bifurcation", Marker::circle));
  plot.add(strength_marks(shown, rows));
  return plot;
}

}  // namespace gridshell::render
