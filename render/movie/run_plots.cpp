#include "render/movie/run_plots.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/canvas/colour_map.h"
#include "render/movie/run_figures.h"

namespace gridshell::render {
namespace {

constexpr Colour rod_ink{0.45f, 0.46f, 0.5f, 1};

Eigen::Matrix3Xd joints_of(const record::Trajectory& run) {
  Eigen::Matrix3Xd joints(3, run.layout.joints.size());
  for (std::size_t k = 0; k < run.layout.joints.size(); ++k)
    joints.col(long(k)) = run.frames.back().nodes.col(run.layout.joints[k].node);
  return joints;
}

bool all_caps(const std::vector<NamedRun>& runs) {
  return std::ranges::all_of(runs, [](const NamedRun& one) { return on_sphere(one.run->layout); });
}

double plane_of(const NamedRun& one) { return one.run->layout.actuated_boundary.row(2).mean(); }

bool planes_differ(const std::vector<NamedRun>& runs) {
  return std::ranges::none_of(runs, [&](const NamedRun& one) {
    return std::ranges::count_if(runs, [&](const NamedRun& other) {
             return std::abs(plane_of(one) - plane_of(other)) < 1e-6;
           }) > 1;
  });
}

/// Writes the names of the runs in their colours, one after another.
void draw_names(Canvas& canvas, Point at, const std::vector<NamedRun>& runs) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const TextStyle style{
        .size = 8, .colour = readable(series_colour(k)), .align_y = AlignY::middle};
    at.x = canvas.text(runs[k].name, at, style).right() + 8;
  }
}

/// Draws the boundaries in a box and returns their scale (units per millimetre), at most `most`.
double draw_boundaries(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs,
                       double most) {
  Eigen::Matrix2Xd all;
  for (const NamedRun& one : runs) {
    const auto flat = one.run->layout.original_boundary.topRows<2>();
    all.conservativeResize(2, all.cols() + flat.cols());
    all.rightCols(flat.cols()) = flat;
  }
  PlanView plan(box, all);
  plan.scale = std::min(plan.scale, most);
  if (runs.size() == 1) {
    const record::Layout& layout = runs.front().run->layout;
    for (const auto& rod : layout.rods)
      canvas.line(plan(layout.flat_nodes.col(rod.front())), plan(layout.flat_nodes.col(rod.back())),
                  {rod_ink, 0.7});
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    canvas.polyline(plan.line(runs[k].run->layout.original_boundary),
                    {runs.size() == 1 ? ink : series_colour(k), 1.4}, true);
  // a single run also has its actuated boundary
  if (runs.size() == 1)
    canvas.polyline(plan.line(runs[0].run->layout.actuated_boundary), {net_ink, 1.1, {4, 2}}, true);
  const Point left{box.x, box.bottom() + 9};
  const Box length = draw_spacing(canvas, left, runs.front().run->layout, plan.scale);
  if (runs.size() == 1) {
    const Point at{length.right() + 10, left.y};
    const std::string text = "solid: original, dashed: actuated boundary";
    canvas.text(
        text, at,
        canvas.fitted(text, canvas.width() - at.x - 4, {.size = 8, .align_y = AlignY::middle}));
  }
  // caps have their names at the planes that cut them, if these differ
  if (runs.size() > 1 && !(all_caps(runs) && planes_differ(runs)))
    draw_names(canvas, {length.right() + 14, left.y}, runs);
  return plan.scale;
}

/// Scale (units per millimetre) at which a sphere of radius rho with the names of planes fills a
/// box.
double scale_of_planes(const Box& box, double rho) {
  return std::min(box.width / 2.95, box.height / 1.35) / rho;
}

/// Draws a sphere from the side and the planes z = z* of its caps.
void draw_planes(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs, double scale) {
  const double rho = runs.front().run->layout.length_scale_mm;
  const Point centre{box.x + 1.15 * scale * rho, box.middle().y + 0.5 * scale * rho};
  std::vector<Point> arc;
  for (int k = 0; k <= 90; ++k) {
    const double angle = std::numbers::pi * k / 90;
    arc.push_back(
        {centre.x + scale * rho * std::cos(angle), centre.y - scale * rho * std::sin(angle)});
  }
  canvas.polyline(arc, {{0.55f, 0.56f, 0.6f, 1}, 1});
  constexpr double size = 7;
  double free = INFINITY;  // the lowest y of the next name, above those before
  std::vector<double> shown;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double z = plane_of(runs[k]);
    const double half = 1.1 * scale * rho, y = centre.y - scale * z;
    const Colour colour = runs.size() == 1 ? ink : series_colour(k);
    // rounded to a hundredth; + 0.0 makes -0 positive
    const double fraction = std::round(100 * z / rho) / 100 + 0.0;
    const bool again = std::ranges::find(shown, fraction) != shown.end();
    shown.push_back(fraction);
    // a second line in one plane is dashed, so that both are visible
    const std::vector<double> dash = again ? std::vector<double>{4, 4} : std::vector<double>{};
    canvas.line({centre.x - half, y}, {centre.x + half, y}, {colour, 1.4, dash});
    if (again) continue;
    // the name of a single plane is below it
    if (runs.size() == 1) {
      canvas.text(fmt::format("*z*^{{*}}/*ρ* = {:g}", fraction), {centre.x, y + 3},
                  {.size = 8, .align_x = AlignX::centre, .align_y = AlignY::top});
      continue;
    }
    const Point name{centre.x + half + 8, std::min(y, free)};
    canvas.line({centre.x + half, y}, {name.x - 1.5, name.y}, {colour, 0.6});
    canvas.text(fmt::format("{:g}", fraction), name,
                {.size = size, .colour = readable(colour), .align_y = AlignY::middle});
    free = name.y - 1.25 * size;
  }
  if (runs.size() > 1)
    canvas.text("*z*^{*}/*ρ*", {centre.x + 1.1 * scale * rho + 8, free - 0.2 * size},
                {.size = size, .align_y = AlignY::middle});
}

double latitude_deg(double sine) {
  return std::asin(std::clamp(sine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Adds joints by latitude and distance from the centre.
void add_by_latitude(const Eigen::Matrix3Xd& joints, double rho, Series& series) {
  for (const auto& joint : joints.colwise())
    series.add(latitude_deg(joint.z() / joint.norm()), joint.norm() / rho);
}

/// Adds points in plan.
void add_points(const Eigen::Matrix3Xd& points, Series& series) {
  for (const auto& p : points.colwise()) series.add(p.x(), p.y());
}

void add_lines(const std::vector<Eigen::Matrix3Xd>& lines, Series& series) {
  for (const auto& line : lines) {
    add_points(line, series);
    series.part();
  }
}

/// A plan whose axes are a square around all lines, so that both have one scale.
Plot plan_about(const std::vector<Eigen::Matrix3Xd>& lines, const std::string& title) {
  constexpr double wider = 1.08;
  Plot plot;
  plot.title = title;
  plot.x.label = "*x* (mm)";
  plot.y.label = "*y* (mm)";
  plot.legend = LegendPosition::above;
  if (lines.empty()) return plot;
  Eigen::Vector2d low = lines.front().col(0).head<2>(), high = low;
  for (const auto& line : lines) {
    low = low.cwiseMin(line.topRows<2>().rowwise().minCoeff());
    high = high.cwiseMax(line.topRows<2>().rowwise().maxCoeff());
  }
  const Eigen::Vector2d middle = (low + high) / 2;
  const double half = wider * (high - low).maxCoeff() / 2;
  plot.x.low = middle.x() - half, plot.x.high = middle.x() + half;
  plot.y.low = middle.y() - half, plot.y.high = middle.y() + half;
  return plot;
}

}  // namespace

void draw_figure_title(Canvas& canvas, const std::string& title) {
  constexpr double margin = 9;
  const TextStyle style{.size = 8.5, .bold = true, .align_y = AlignY::middle};
  canvas.text(plain(title), {margin, 0.6 * figure_title_room},
              canvas.fitted(plain(title), canvas.width() - 2 * margin, style));
}

Box draw_spacing(Canvas& canvas, Point left, const record::Layout& layout, double scale) {
  // one spacing may be as short as a letter
  const int spacings = scale * layout.spacing_mm < 8 ? 5 : 1;
  const double end = left.x + scale * spacings * layout.spacing_mm;
  canvas.line(left, {end, left.y}, {ink, 1});
  for (const double x : {left.x, end}) canvas.line({x, left.y - 2.2}, {x, left.y + 2.2}, {ink, 1});
  return canvas.text(
      fmt::format("{}*d* = {:g} mm", spacings > 1 ? "5 *d*; " : "", layout.spacing_mm),
      {end + 4, left.y}, {.size = 8, .align_y = AlignY::middle});
}

Plot curvature_plot(const std::vector<NamedRun>& runs) {
  Plot plot;
  plot.x.label = "*x*/*L*";
  plot.x.low = -1.08;
  plot.x.high = 1.08;
  plot.y.label = "integrated *K*_{□} (rad)";
  if (runs.size() == 1) plot.legend = LegendPosition::none;
  plot.references.push_back({.at = 0, .label = ""});
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const record::Trajectory& run = *runs[r].run;
    // the middle of an assemblage of blocks may differ from the origin
    const auto ends = run.layout.actuated_boundary.row(0);
    const double middle = 0.5 * (ends.minCoeff() + ends.maxCoeff()), L = ends.maxCoeff() - middle;
    const Eigen::Matrix3Xd joints = joints_of(run);
    // marks of several runs are hollow; from the fifth on, shapes are repeated filled
    Series series = mark_series(runs[r].name, series_colour(r), series_marker(r), 3.2,
                                runs.size() > 1 && r < 4);
    for (std::size_t k = 0; k < run.layout.cells.size(); ++k) {
      double x = 0;
      for (int joint : run.layout.cells[k].joints) x += joints(0, joint) / 4;
      series.add((x - middle) / L, run.frames.back().cell_K[long(k)]);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot quantile_plot(const std::vector<NamedRun>& runs) {
  Plot plot;
  plot.x.label = "fraction of joints (%)";
  plot.x.low = 0;
  plot.x.high = 100;
  const DeviationUnit unit = deviation_unit(runs.front().run->layout);
  plot.y.label = "deviation from the net, " + unit.label;
  plot.y.low = 0;
  if (runs.size() == 1) plot.legend = LegendPosition::none;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const record::Trajectory& run = *runs[r].run;
    Eigen::VectorXd sorted = last_deviation(run).head(long(run.layout.joints.size()));
    std::ranges::sort(sorted);
    Series series = line_series(runs[r].name, series_colour(r), 1.2);
    for (long k = 0; k < sorted.size(); ++k)
      series.add(sorted.size() > 1 ? 100.0 * double(k) / double(sorted.size() - 1) : 100,
                 unit.factor * sorted[k]);
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot latitude_plot(const NamedRun& named) {
  const record::Trajectory& run = *named.run;
  const double rho = run.layout.length_scale_mm;
  Plot plot;
  plot.x.label = "latitude (°)";
  plot.y.label = "radial position, *r*/*ρ*";
  Series net = line_series("Chebyshev net", net_ink, 1.3);
  net.add(latitude_deg(run.layout.actuated_boundary.row(2).mean() / rho), 1);
  net.add(90, 1);
  plot.x.low = net.x.front();
  plot.x.high = 92;  // so that the marker of a joint at the pole is complete
  plot.add(std::move(net));
  // larger markers below, so that a computed joint is visible inside the scanned one
  Series measured =
      mark_series("joints, scanned", {0.80f, 0.16f, 0.12f, 1}, Marker::circle, 4.2, true);
  add_by_latitude(named.scanned, rho, measured);
  plot.add(std::move(measured));
  Series shell = mark_series("joints, computed", ink, Marker::circle, 2.6);
  add_by_latitude(joints_of(run), rho, shell);
  plot.add(std::move(shell));
  return plot;
}

void draw_footprints(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs) {
  const bool caps = all_caps(runs);
  const double half = caps ? box.width / 2 : box.width;
  // the boundaries need more room below, for the spacing
  const Box right{box.x + half, box.y, half, box.height - 8};
  const double most =
      caps ? scale_of_planes(right, runs.front().run->layout.length_scale_mm) : INFINITY;
  // boundaries and planes have one scale
  const double scale =
      draw_boundaries(canvas, {box.x, box.y, half - 8, box.height - 20}, runs, most);
  if (caps) draw_planes(canvas, right, runs, scale);
}

Result<void> write_footprints(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                              const std::string& title, const Print& print) {
  // the size of text does not depend on the printed width
  const double usual = all_caps(runs) ? 470 : 250, width = print.width_pt(usual),
               height = 250 * width / usual;
  return write_figure(
      stem, width, height + figure_title_room, "Original boundaries",
      [&](Canvas& canvas) {
        draw_figure_title(canvas, title);
        draw_footprints(canvas, Box{0, figure_title_room, width, height}.inset(9), runs);
      },
      print);
}

Plot refused_plot(const std::vector<Eigen::Matrix3Xd>& lines, const Eigen::Matrix3Xd& narrow,
                  const Eigen::Vector3d& end, const std::string& title) {
  Series net = line_series("the net up to where it ends", {0.45f, 0.5f, 0.55f, 1}, 0.5);
  add_lines(lines, net);
  Series close =
      mark_series("rods within 17° of parallel", {0.93f, 0.6f, 0.2f, 1}, Marker::circle, 1.8);
  add_points(narrow, close);
  Series end_mark = mark_series(
      fmt::format("end of the net, *z* = {}{:.1f} mm", end.z() < 0 ? "−" : "", std::abs(end.z())),
      {0.75f, 0.1f, 0.15f, 1}, Marker::cross, 8);
  end_mark.add(end.x(), end.y());
  Plot plot = plan_about(lines, title);
  plot.series = {net};
  plot.add(std::move(close));
  plot.add(std::move(end_mark));
  return plot;
}

Plot net_plan(const std::vector<PlanPart>& parts, const std::string& title) {
  using Kind = PlanPart::Kind;
  constexpr std::array<Colour, 4> left_out{{{0.93f, 0.6f, 0.2f, 1},
                                            {0.75f, 0.2f, 0.25f, 1},
                                            {0.55f, 0.35f, 0.65f, 1},
                                            {0.6f, 0.6f, 0.6f, 1}}};
  std::size_t reasons = 0;
  std::vector<Eigen::Matrix3Xd> all;
  for (const PlanPart& part : parts) all.insert(all.end(), part.lines.begin(), part.lines.end());
  Plot plot = plan_about(all, title);
  for (const PlanPart& part : parts) {
    Series series;
    switch (part.kind) {
      case Kind::rods:
        series = line_series(part.name, {0.2f, 0.35f, 0.55f, 1}, 0.5);
        break;
      case Kind::rim:
        series = line_series(part.name, ink, 0.9);
        break;
      case Kind::hole:
        series = line_series(part.name, ink, 0.9, {2, 1});
        break;
      case Kind::crease:
        series = line_series(part.name, {0.75f, 0.1f, 0.15f, 1}, 1.1);
        break;
      case Kind::left_out:
        series = mark_series(part.name, left_out[std::min(reasons++, left_out.size() - 1)],
                             Marker::square, 2);
        break;
      case Kind::apex:
        series = mark_series(part.name, {0.75f, 0.1f, 0.15f, 1}, Marker::cross, 6);
        break;
    }
    add_lines(part.lines, series);
    add_points(part.points, series);
    plot.add(std::move(series));
  }
  return plot;
}

}  // namespace gridshell::render
