#include <cmath>
#include <functional>
#include <limits>

#include "render/canvas/plot.h"
#include "render/canvas/plot_frame.h"
#include "tests/render/canvas/ink.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Series line(const std::string& name, double slope, Marker marker = Marker::circle) {
  Series s{name};
  s.marker = marker;
  for (int k = 0; k < 10; ++k) {
    s.add(94.5 + 3.5 * k, slope * std::sqrt(10.0 - k) - 2);
    s.y_error.push_back(1.5);
  }
  return s;
}

Plot energies() {
  Plot plot;
  plot.title = "Energies";
  plot.x = {"boundary radius *R*_{a} (mm)"};
  plot.y = {"bend energy *E*_{b} (mJ)"};
  plot.series = {line("4 edges", 12), line("8 edges", 9, Marker::square)};
  plot.references = {{true, 30, "30 mJ"}, {false, 115.9, "B2"}};
  plot.bands = {{"planar", {120, 126}, {unknown, unknown}, {unknown, unknown}}};
  plot.notes = {{94.5, 3, "run out?", AlignX::right}};
  return plot;
}

Plot errors() {
  Plot plot;
  plot.x = {"CPU time (s)", true};
  plot.y = {"error / *R*_{o}", true};
  for (int m = 0; m < 3; ++m) {
    Series s{"method " + std::to_string(m)};
    for (int k = 0; k < 5; ++k) {
      s.add(std::pow(10, -2.0 + m + 0.4 * k), 0.05 * std::pow(0.25, k));
      s.y_error.push_back(k == 4 ? 1 : 0.3 * s.y.back());  // reaches below zero
    }
    plot.series.push_back(s);
  }
  return plot;
}

Plot bars() {
  Plot plot;
  plot.x = {"*x* / *L*"};
  plot.y = {"*K*_{□} (rad)"};
  Series s{"mean"};
  s.kind = SeriesKind::bars;
  s.bar_width = 0.36;
  s.x = {-0.8, -0.4, 0, 0.4, 0.8};
  s.y = {-0.05, 0.01, 0.03, 0.01, -0.05};
  s.y_error = {0.01, 0.01, 0.01, 0.01, 0.01};
  plot.series = {s};
  return plot;
}

using Look = std::function<void(const Canvas&)>;

Image drawn(
    const Plot& plot, double width, double height,
    const Look& look = [](const Canvas& canvas) { test::check_apart(canvas); }) {
  return *draw_picture(width, height, 2, white, [&](Canvas& canvas) {
    draw_plot(canvas, Box{0, 0, width, height}.inset(2), plot);
    look(canvas);
  });
}

void laid_out(const Plot& plot, const std::function<void(Canvas&, const PlotFrame&)>& look) {
  (void)draw_picture(300, 200, 1, white, [&](Canvas& canvas) {
    look(canvas, lay_out_plot(canvas, {0, 0, 300, 200}, plot));
  });
}

}  // namespace

TEST_CASE("nothing of a plot is cut off and no two texts overlap") {
  for (const Plot& plot : {energies(), errors(), bars()})
    for (const auto& [width, height] : {std::pair{250, 176}, {500, 300}, {180, 150}}) {
      INFO(plot.y.label << " at " << width << " x " << height);
      CHECK(test::rim_is_white(drawn(plot, width, height)));
    }
}

TEST_CASE("labels, ticks, legend, references and notes are all there") {
  drawn(energies(), 500, 300, [](const Canvas& canvas) {
    for (const std::string text :
         {"Energies", "boundary radius Ra (mm)", "bend energy Eb (mJ)", "100", "110", "120", "10",
          "20", "30", "4 edges", "8 edges", "planar", "30 mJ", "B2", "run out?"}) {
      INFO(text);
      CHECK(test::has(canvas.texts(), text));
    }
  });
}

TEST_CASE("values are where the axis says") {
  const Plot plot = errors();
  laid_out(plot, [&](Canvas&, const PlotFrame& frame) {
    // on a logarithmic axis equal ratios take equal room
    const double x1 = frame.x.coordinate(0.01), x2 = frame.x.coordinate(0.1),
                 x3 = frame.x.coordinate(1);
    CHECK(x2 - x1 == Approx(x3 - x2));
    CHECK(frame.y.coordinate(0.01) > frame.y.coordinate(0.1));
    CHECK(std::isnan(frame.x.coordinate(0)));
    for (const Series& s : plot.series)
      for (std::size_t k = 0; k < s.x.size(); ++k) {
        CHECK(frame.inside.x <= frame.x.coordinate(s.x[k]));
        CHECK(frame.x.coordinate(s.x[k]) <= frame.inside.right());
      }
  });
}

TEST_CASE("a given range is kept") {
  Plot plot = energies();
  plot.x.low = 90;
  plot.x.high = 130;
  laid_out(plot, [&](Canvas&, const PlotFrame& frame) {
    CHECK(frame.x.low == 90);
    CHECK(frame.x.high == 130);
    CHECK(frame.x.coordinate(90) == Approx(frame.inside.x));
    CHECK(frame.x.coordinate(130) == Approx(frame.inside.right()));
  });
}

TEST_CASE("a legend hides no data: it goes to a free corner, else above") {
  Plot plot;
  plot.x = {"x"};
  plot.y = {"y"};
  plot.series = {{"falling"}};
  for (int k = 0; k <= 10; ++k) plot.series[0].add(k, 10 - k);
  laid_out(plot, [&](Canvas& canvas, const PlotFrame& frame) {
    CHECK(Legend(canvas, plot).free_corner(canvas, frame) == LegendPosition::upper_right);
    Plot crossed = plot;
    crossed.series.push_back(plot.series[0]);
    for (double& y : crossed.series[1].y) y = 10 - y;
    CHECK(Legend(canvas, crossed).free_corner(canvas, frame) == LegendPosition::none);
    // a band of errors and horizontal error bars are data
    Plot above = plot;
    above.bands = {{"band", {0, 10}, {8, 8}, {10, 10}}};
    CHECK(Legend(canvas, above).free_corner(canvas, frame) == LegendPosition::lower_left);
    Plot wide = plot;
    wide.series.push_back({"errors"});
    wide.series[1].add(1, 9.5);
    wide.series[1].x_span = {{0, 10}};
    CHECK(Legend(canvas, wide).free_corner(canvas, frame) == LegendPosition::lower_left);
  });
}

TEST_CASE("gaps, empty series and single points are drawn without complaint") {
  Plot plot;
  plot.x = {"x"};
  plot.y = {"y", true};
  plot.series = {{"nothing"}, {"one"}, {"gap"}};
  plot.series[1].x = {1};
  plot.series[1].y = {1};
  plot.series[2].x = {0, 1, 2, 3};
  plot.series[2].y = {1, unknown, -5, 10};
  CHECK(test::rim_is_white(drawn(plot, 250, 180)));
  CHECK(test::rim_is_white(drawn(Plot{}, 250, 180)));
  // far too small: nothing, rather than something wrong
  CHECK(test::ink_box(drawn(energies(), 20, 12, [](const Canvas&) {}), 0).empty());
}

TEST_CASE("a name of the legend is no smaller than a fifth, however narrow the plot") {
  Plot plot = energies();
  (void)draw_picture(400, 300, 1, white, [&](Canvas& canvas) {
    draw_legend(canvas, {0, 0, 8, 100}, plot);
    REQUIRE_FALSE(canvas.text_boxes().empty());
    for (const Box& box : canvas.text_boxes()) {
      CHECK(box.height > 0);
      CHECK(box.height < 0.5 * plot.font_size);
    }
  });
}
