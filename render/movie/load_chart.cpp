// What a shell carries: the load factor over a joint's way, a curve a case.
#include <algorithm>
#include <cmath>

#include "render/movie/state_charts.h"

namespace gridshell::render {
namespace {

using record::BranchEvent;
using record::LoadPoint;

/// A case's path in pieces that are stable or not throughout; the first bears its name.
void add_path(const std::vector<LoadPoint>& points, const std::string& name, Colour colour,
              Plot& plot) {
  const LoadPoint* before = nullptr;
  bool named = false, stable = true;
  Series piece;
  for (const LoadPoint& point : points) {
    if (point.load_case != name) continue;
    const bool holds = point.negative_pivots == 0;
    if (!before || holds != stable) {
      plot.add(std::move(piece));
      piece = line_series(named ? "" : name, colour, 1.2);
      if (!holds) piece.dash = {3.2, 2.2};
      if (before) piece.add(before->way_mm, before->factor);
      named = true;
    }
    piece.add(point.way_mm, point.factor);
    before = &point;
    stable = holds;
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

/// Where each case's rods come to their strength: the factor with its error, the way as the path on
/// the finest mesh passes there.
Series strength_marks(const std::vector<LoadPoint>& points,
                      const std::vector<record::LoadRow>& cases) {
  Series marks = mark_series("at its strength", ink, Marker::triangle, 4);
  for (const record::LoadRow& row : cases) {
    const auto beyond = std::ranges::find_if(points, [&](const LoadPoint& point) {
      return point.load_case == row.load_case && point.utilisation >= 1;
    });
    if (!std::isfinite(row.strength_factor) || beyond == points.end()) continue;
    double way = beyond->way_mm;
    if (beyond != points.begin() && beyond[-1].load_case == row.load_case)
      way -= (beyond->utilisation - 1) / (beyond->utilisation - beyond[-1].utilisation) *
             (way - beyond[-1].way_mm);
    marks.add(way, row.strength_factor);
    marks.y_error.push_back(row.strength_error);
  }
  return marks;
}

}  // namespace

Plot load_plot(const std::vector<LoadPoint>& points, const std::vector<record::LoadRow>& cases,
               const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x.label = "way of the joint that goes furthest (mm)";
  plot.y.label = "load factor";
  std::size_t next = 0;
  for (const auto& name : distinct(points, &LoadPoint::load_case))
    add_path(points, name, series_colour(next++), plot);
  plot.add(marks_of(points, BranchEvent::turn, "limit point", Marker::square));
  plot.add(marks_of(points, BranchEvent::bifurcation, "bifurcation", Marker::circle));
  plot.add(strength_marks(points, cases));
  return plot;
}

}  // namespace gridshell::render
