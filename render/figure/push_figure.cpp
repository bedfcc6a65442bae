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
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Series series;
    if (runs.size() > 1) series.name = runs[k].name;
    series.colour = series_colour(k);
    series.marker = markers[k % 4];
    for (const record::Frame& frame : runs[k].run->frames) {
      series.x.push_back(frame.depth_mm);
      series.y.push_back(frame.force_N);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const Print& print) {
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
  const double column = width / double(columns);
  return write_figure(
      stem, width, height * double(rows), "K of the cells in bins of x/L",
      [&](Canvas& canvas) {
        for (std::size_t k = 0; k < plots.size(); ++k) {
          const double x = column * double(k % columns), y = height * double(k / columns);
          draw_plot(canvas, {x + 3, y + 3, column - 6, height - 6}, plots[k]);
        }
      },
      print);
}

}  // namespace gridshell::render
