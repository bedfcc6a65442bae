#include "app/window/plot_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "engine/core/file_io.h"
#include "render/movie/frame_overlay.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr double jump = 0.2;  // progress between two equilibria that no line connects

/// Abscissa of the curves if none was chosen: the depth of the last push, else the motion of the
/// boundary, else, if it does not move, the number of the equilibrium.
int abscissa_of(const ViewerState& viewer, std::span<const PlotPoint> points) {
  if (points.empty() || points.back().joint >= 0) return quantity_called("depth_mm");
  const bool moved = std::ranges::any_of(points, [&](const PlotPoint& point) {
    return std::abs(point.progress - points.front().progress) > 1e-9;
  });
  if (!moved) return quantity_called("equilibrium");
  return quantity_called(
      std::isfinite(viewer.shell->frame.boundary_radius_mm) ? "boundary_radius_mm" : "progress");
}

/// Points since the constraint of the pushed joint was set.
std::span<const PlotPoint> last_points(const ViewerState& viewer) {
  std::span<const PlotPoint> all = viewer.plot_points;
  std::size_t since = all.size();
  while (since > 0 && all[since - 1].joint == all.back().joint) --since;
  return all.subspan(since);
}

/// Adds the marks of the paths to a curve over the position on the path.
void put_marks(const ShellView& shell, const Quantity& over, Curve& curve) {
  const std::string_view name = over.name;
  const int pushed = shell.constrained.empty() ? -1 : shell.constrained.back().joint;
  for (const PathMark& mark : shell.marks) {
    double from = mark.from, to = mark.to;
    if (mark.joint < 0 && name == "boundary_radius_mm")
      from = shell.radius_at(mark.to), to = shell.radius_at(mark.from);
    else if (mark.joint < 0 ? name != "progress" : name != "depth_mm" || mark.joint != pushed)
      continue;
    if (from > to) std::swap(from, to);
    curve.marks.push_back({float(from), float(to), mark.unstable, mark.what});
  }
}

/// Adds the marks of a curve to its plot: bands without a stable state, and lines at events.
void put_marks(const Curve& curve, render::Plot& plot) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  float least = float(unbounded), most = -least;
  for (const float x : curve.x) least = std::fmin(least, x), most = std::fmax(most, x);
  render::Colour red = render::event_ink;
  red.a = 0.2f;
  for (const CurveMark& mark : curve.marks) {
    if (mark.to < least || mark.from > most) continue;
    const double from = double(std::max(mark.from, least)), to = double(std::min(mark.to, most));
    if (mark.unstable)
      plot.bands.push_back({"", {from, to}, {-unbounded, -unbounded}, {unbounded, unbounded}, red});
    else
      plot.references.push_back({.horizontal = false, .at = from, .label = {}});
  }
}

}  // namespace

std::vector<CurvePiece> pieces_of(const Curve& curve, const std::vector<float>& y) {
  std::vector<CurvePiece> pieces;
  const auto known = [&](std::size_t k) {
    return std::isfinite(curve.x[k]) && std::isfinite(y[k]);
  };
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (!known(k)) continue;
    if (k == 0 || !known(k - 1) || std::ranges::binary_search(curve.jumps, k))
      pieces.push_back({k, k, std::ranges::binary_search(curve.coarse, k)});
    ++pieces.back().end;
  }
  return pieces;
}

render::Plot plot_of(const Curve& curve) {
  render::Plot plot;
  plot.x.label = curve.x_label;
  plot.y.label = curve.y_label;
  constexpr double width = 1.2;
  const render::Colour ink = render::series_colour(0), pale = render::ghost_ink;
  const std::string on_coarse = "on the coarse mesh of a drag";
  render::Series line = render::line_series("", ink, width),
                 coarse_line = render::line_series(on_coarse, pale, width),
                 point = render::mark_series("", ink),
                 coarse_point = render::mark_series(on_coarse, pale),
                 unstable = render::mark_series("not stable", render::event_ink);
  for (const CurvePiece& piece : pieces_of(curve, curve.y)) {
    render::Series& series = piece.is_point() ? piece.coarse ? coarse_point : point
                             : piece.coarse   ? coarse_line
                                              : line;
    if (!series.x.empty()) series.part();
    for (std::size_t k = piece.from; k < piece.end; ++k)
      series.add(double(curve.x[k]), double(curve.y[k]));
  }
  for (const std::size_t k : curve.unstable) unstable.add(double(curve.x[k]), double(curve.y[k]));
  if (!coarse_line.x.empty()) coarse_point.name.clear();
  put_marks(curve, plot);
  for (render::Series* series : {&coarse_line, &coarse_point, &line, &point, &unstable})
    plot.add(std::move(*series));
  return plot;
}

std::string table_of(const Curve& curve) {
  std::string table =
      fmt::format("{},{},line,coarse mesh,unstable\n", curve.x_label, curve.y_label);
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const auto line = std::ranges::upper_bound(curve.jumps, k) - curve.jumps.begin() + 1;
    table += fmt::format("{},{},{},{:d},{:d}\n", curve.x[k], curve.y[k], line,
                         std::ranges::binary_search(curve.coarse, k),
                         std::ranges::binary_search(curve.unstable, k));
  }
  return table;
}

Curve curve_of(const ViewerState& viewer, const PlotAxes& axes) {
  const std::span<const PlotPoint> points = last_points(viewer);
  const int x = axes.x >= 0 ? axes.x : abscissa_of(viewer, points);
  const Quantity &over = quantities[std::size_t(x)], &shown = quantities[std::size_t(axes.y)];
  Curve curve{shown.label, over.label, "nothing was done yet", {}, {}};
  curve.whole = x == quantity_called("equilibrium");
  if (&shown == &quantities[std::size_t(quantity_called("force_N"))] &&
      (points.empty() || points.back().joint < 0))
    return curve.without = "no joint is fixed", curve;
  for (std::size_t k = 0; k < points.size(); ++k) {
    // no line between states of their own, where the boundary jumped, or to the coarse mesh of a
    // drag, which has other values
    const auto apart = [&](const PlotPoint& a, const PlotPoint& b) {
      return curve.whole || a.coarse != b.coarse ||
             (b.joint < 0 && std::abs(b.progress - a.progress) > jump);
    };
    if (k > 0 && apart(points[k - 1], points[k])) curve.jumps.push_back(k);
    if (points[k].coarse) curve.coarse.push_back(curve.x.size());
    if (!points[k].stable) curve.unstable.push_back(curve.x.size());
    curve.x.push_back(float(points[k].*over.value));
    curve.y.push_back(float(points[k].*shown.value));
  }
  put_marks(*viewer.shell, over, curve);
  return curve;
}

Curve bins_of(const ShellView& shell) {
  Curve curve{"mean K□ of cells (rad)", "x/L", "no cells", {}, {}, true};
  const auto& bins = shell.frame.K_bins;
  if (!shell.any() || !bins.leftCols(1).array().isFinite().any()) return curve;
  for (Eigen::Index k = 0; k < bins.rows(); ++k) {  // a bin without cells is unknown
    curve.x.push_back(-1 + (2 * float(k) + 1) / float(bins.rows()));
    curve.y.push_back(float(bins(k, 0)));
  }
  return curve;
}

void ViewerState::save_plots() {
  std::vector<Curve> curves;
  for (const PlotAxes& axes : plot_axes)
    if (Curve curve = curve_of(*this, axes); !curve.x.empty()) curves.push_back(std::move(curve));
  if (curves.empty()) return say("no plot shows anything yet", true);
  save_plots(curves);
}

void ViewerState::save_plots(const std::vector<Curve>& curves) {
  std::string saved;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const fs::path stem = path_to_save({".pdf", ".svg", ".png", ".csv"});
    const auto written =
        make_folder(library.save_to)
            .and_then([&] { return render::write_plot(stem, plot_of(curves[k])); })
            .and_then([&] { return write_file(stem.string() + ".csv", table_of(curves[k])); });
    if (!written) return say(written.error().message, true);
    saved += (k == 0 ? "" : ", ") + fs::absolute(stem).string() + ".pdf, .svg, .png and .csv";
  }
  say("saved " + saved);
}

}  // namespace gridshell::window
