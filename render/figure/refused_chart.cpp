#include "render/figure/refused_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridshell::render {
namespace {

/// A square about all lines, so that lengths are alike on both axes.
void frame_about(const std::vector<Eigen::Matrix3Xd>& lines, Plot& plot) {
  constexpr double wider = 1.08;
  Eigen::Vector2d low = lines.front().col(0).head<2>(), high = low;
  for (const auto& line : lines) {
    low = low.cwiseMin(line.topRows<2>().rowwise().minCoeff());
    high = high.cwiseMax(line.topRows<2>().rowwise().maxCoeff());
  }
  const Eigen::Vector2d middle = (low + high) / 2;
  const double half = wider * (high - low).maxCoeff() / 2;
  plot.x.low = middle.x() - half, plot.x.high = middle.x() + half;
  plot.y.low = middle.y() - half, plot.y.high = middle.y() + half;
}

}  // namespace

Plot refused_plot(const std::vector<Eigen::Matrix3Xd>& lines, const Eigen::Matrix3Xd& narrow,
                  const Eigen::Vector3d& end, const std::string& title) {
  Series net{"the net as far as it comes, from above"}, close{"rods within 17° of parallel"},
      place{fmt::format("it ends at *z* = {}{:.1f} mm", end.z() < 0 ? "−" : "", std::abs(end.z()))};
  for (const auto& line : lines) {
    for (const auto& p : line.colwise()) {
      net.x.push_back(p.x());
      net.y.push_back(p.y());
    }
    net.x.push_back(std::numeric_limits<double>::quiet_NaN());
    net.y.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  net.colour = {0.45f, 0.5f, 0.55f, 1};
  net.line_width = 0.5;
  for (const auto& p : narrow.colwise()) {
    close.x.push_back(p.x());
    close.y.push_back(p.y());
  }
  close.colour = {0.93f, 0.6f, 0.2f, 1};
  close.line_width = 0;
  close.marker = Marker::circle;
  close.marker_size = 1.8;
  place.x = {end.x()};
  place.y = {end.y()};
  place.colour = {0.75f, 0.1f, 0.15f, 1};
  place.line_width = 0;
  place.marker = Marker::cross;
  place.marker_size = 8;
  Plot plot;
  plot.title = title;
  plot.x.label = "*x* (mm)";
  plot.y.label = "*y* (mm)";
  plot.legend = LegendPlace::above;
  plot.series = {net};
  if (!close.x.empty()) plot.series.push_back(close);
  plot.series.push_back(place);
  if (!lines.empty()) frame_about(lines, plot);
  return plot;
}

}  // namespace gridshell::render
