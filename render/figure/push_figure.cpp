#include "render/figure/push_figure.h"

#include <algorithm>
#include <cmath>

#include "render/figure/vector_shell.h"
#include "render/movie/bins_plot.h"
#include "render/movie/colour_range.h"
#include "render/movie/stage.h"
#include "render/movie/survey.h"
#include "render/plot/panels.h"

namespace gridshell::render {
namespace {

MovieStyle panel_style(MovieStyle style) {
  style.captions = style.inset = style.bins = style.legends = false;
  style.turn_deg = 0;
  style.colour_by = ColourBy::displacement;
  style.look.floor = false;
  style.look.joint_mm = 0;
  // round shells, three to a row
  style.width = style.height;
  return style;
}

/// From the last state before each snap to the first after it.
Series snaps_of(const Series& pushed, const record::Trajectory& run) {
  Series snaps;
  snaps.colour = pushed.colour;
  snaps.dash = {3, 2};
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    if (!run.frames[k].event.starts_with("snap")) continue;
    // what moved in time in between has no force
    std::size_t before = k - 1;
    while (before > 0 && !std::isfinite(pushed.y[before])) --before;
    for (const std::size_t at : {before, k}) {
      snaps.x.push_back(pushed.x[at]);
      snaps.y.push_back(pushed.y[at]);
    }
    snaps.x.push_back(NAN);
    snaps.y.push_back(NAN);
  }
  return snaps;
}

/// A line that goes from state to state has a gap where one snapped to the next.
void part_at_snaps(Series& pushed, const record::Trajectory& run) {
  for (std::size_t k = run.frames.size(); k-- > 1;)
    if (run.frames[k].event.starts_with("snap") && std::isfinite(pushed.y[k - 1])) {
      pushed.x.insert(pushed.x.begin() + long(k), NAN);
      pushed.y.insert(pushed.y.begin() + long(k), NAN);
    }
}

}  // namespace

Result<PanelFigure> draw_pushes(const std::vector<NetRun>& runs, const MovieStyle& movie_style,
                                Renderer& renderer, Watch& watch) {
  const MovieStyle style = panel_style(movie_style);
  std::vector<Survey> surveys;
  std::vector<const Survey*> all;
  for (const NetRun& one : runs) surveys.push_back(survey_of(*one.run));
  for (const Survey& survey : surveys) all.push_back(&survey);
  const auto bar = colour_bar_of(all, style);
  PanelFigure figure;
  if (style.print.width_mm > 0) figure.print = style.print;
  figure.title = style.title;
  figure.columns = std::min(3, int(runs.size()));
  // one by itself is named by the title
  const bool several = runs.size() > 1 || style.title.empty();
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while drawing a figure");
    if (auto showable = check_showable(*runs[k].run, style); !showable)
      return tl::unexpected(showable.error());
    const Stage stage(runs[k].run->layout, std::move(surveys[k]), style, bar);
    const int last = stage.frames() - 1;
    Drawing drawing = stage.drawing(runs[k].run->frames.back());
    // the colours are the rods': nothing hides them
    drawing.rod_diameter_mm *= 1.5;
    auto picture =
        renderer.draw(drawing, stage.camera(last), draw_quality(style), style.width, style.height);
    if (!picture) return tl::unexpected(picture.error());
    figure.panels.push_back(
        {std::move(*picture),
         several && style.look.letters ? std::string(1, char('a' + k % 26)) : "",
         several ? runs[k].caption : ""});
    if (style.vector)
      figure.panels.back().lines = shell_lines(std::move(drawing), stage.camera(last));
    figure.colour_bar = bar;
    watch.report(double(k + 1) / double(runs.size()));
  }
  return figure;
}

Plot force_plot(const std::vector<NamedRun>& runs) {
  constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  Plot plot;
  plot.x = {.label = "depth *δ* (mm)", .low = 0};
  plot.y = {.label = "force (N)"};
  bool told = false;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Series series;
    if (runs.size() > 1) series.name = runs[k].name;
    series.colour = series_colour(k);
    series.marker = markers[k % 4];
    for (const record::Frame& frame : runs[k].run->frames) {
      series.x.push_back(frame.depth_mm);
      series.y.push_back(frame.force_N);
    }
    Series snaps = snaps_of(series, *runs[k].run);
    part_at_snaps(series, *runs[k].run);
    plot.series.push_back(std::move(series));
    if (snaps.x.empty()) continue;
    if (!told) snaps.name = "snap to another state";
    told = true;
    plot.series.push_back(std::move(snaps));
  }
  return plot;
}

Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const std::string& title, const Print& print) {
  constexpr double font = 7.5, usual = 186, least = 150, height = 190;  // points
  std::vector<Plot> plots;
  double low = 0, high = 0;
  for (const NamedRun& one : runs) {
    const record::Frame& last = one.run->frames.back();
    if (last.K_bins.rows() == 0) return {};
    plots.push_back(
        bins_plot(survey_of(*one.run), long(one.run->layout.cells.size()), last, {}, font));
    plots.back().title = one.name + "\nΣ*K*_{□} = " + fixed(last.total_K, 3) + " rad";
    low = std::min(low, plots.back().y.low.value_or(0));
    high = std::max(high, plots.back().y.high.value_or(0));
  }
  for (Plot& plot : plots) {
    plot.y.low = low;
    plot.y.high = high;
  }
  // as many beside one another as stay readable
  const double width = print.width_pt(usual * double(plots.size()));
  const std::size_t columns = std::clamp<std::size_t>(std::size_t(width / least), 1, plots.size());
  const std::size_t rows = (plots.size() + columns - 1) / columns;
  const double column = width / double(columns), head = title.empty() ? 0 : figure_head;
  return write_figure(
      stem, width, head + height * double(rows), "K of the cells in bins of x/L",
      [&](Canvas& canvas) {
        if (head > 0) draw_figure_head(canvas, title);
        for (std::size_t k = 0; k < plots.size(); ++k) {
          const std::size_t row = k / columns;
          const double x = column * double(k % columns), y = head + height * double(row);
          draw_plot(canvas, {x + 3, y + 3, column - 6, height - 6}, plots[k]);
        }
      },
      print);
}

}  // namespace gridshell::render
