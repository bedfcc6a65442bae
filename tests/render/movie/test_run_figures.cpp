// Figures of runs show the numbers they are given.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "render/movie/run_figures.h"
#include "render/movie/run_plots.h"
#include "tests/render/canvas/ink.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

/// One cell of four joints at latitude 45 degrees, its net on the unit sphere times 100; the shell
/// lies 2 % inside.
record::Trajectory one_cell() {
  record::Trajectory run;
  record::Layout& layout = run.layout;
  layout.spacing_mm = 20;
  layout.length_scale_mm = 100;
  layout.net_nodes.resize(3, 4);
  for (int k = 0; k < 4; ++k) {
    const double angle = M_PI / 4 + M_PI / 2 * k;
    layout.net_nodes.col(k) << 100 * M_SQRT1_2 * std::cos(angle), 100 * M_SQRT1_2 * std::sin(angle),
        100 * M_SQRT1_2;
    layout.joints.push_back({k % 2, k / 2, 0, 0, k});
  }
  layout.cells.push_back({0, 0, 0, 0, {0, 1, 2, 3}});
  layout.rods = {{0, 1}, {2, 3}};
  layout.flat_nodes = layout.net_nodes;
  layout.original_boundary = layout.actuated_boundary = layout.net_nodes;
  record::Frame frame;
  frame.nodes = 0.98 * layout.net_nodes;
  frame.cell_K = Eigen::VectorXd::Constant(1, 0.25);
  run.frames = {frame};
  return run;
}

}  // namespace

TEST_CASE("the deviation of a shell two per cent inside its sphere is two per cent") {
  const record::Trajectory run = one_cell();
  CHECK(on_sphere(run.layout));
  for (double one : last_deviation(run)) CHECK(one == Approx(0.02));
}

TEST_CASE("K is plotted at the centroid of the cell over the half-span") {
  record::Trajectory run = one_cell();
  run.frames.edit()[0].nodes.row(0).array() += 5;
  const Plot plot = curvature_plot({{&run, "shell"}});
  REQUIRE(plot.series.size() == 1);
  REQUIRE(plot.series[0].x.size() == 1);
  CHECK(plot.series[0].x[0] == Approx(5 / 50.0));
  CHECK(plot.series[0].y[0] == 0.25);
}

TEST_CASE("r over rho is plotted against latitude, the net at one") {
  const record::Trajectory run = one_cell();
  const Plot plot = latitude_plot({&run, "shell"});
  REQUIRE(plot.series.size() == 2);
  CHECK(plot.series[0].y == std::vector<double>{1, 1});
  for (double latitude : plot.series[1].x) CHECK(latitude == Approx(45));
  for (double r : plot.series[1].y) CHECK(r == Approx(0.98));
  CHECK(plot.x.high > 91);  // a joint at the pole is not cut in half
}

TEST_CASE("scanned joints are one more series of the latitude plot") {
  const record::Trajectory run = one_cell();
  Eigen::Matrix3Xd scan(3, 2);
  scan << 0, 60, 0, 0, 101, 80;
  const Plot plot = latitude_plot({&run, "shell", scan});
  REQUIRE(plot.series.size() == 3);
  CHECK(plot.series[1].x[0] == Approx(90));
  CHECK(plot.series[1].y == std::vector<double>{1.01, 1.0});
}

TEST_CASE("quantiles of the deviation run from the nearest joint to the farthest") {
  record::Trajectory run = one_cell();
  run.frames.edit()[0].nodes.col(2) = 0.95 * run.layout.net_nodes.col(2);
  const Plot plot = quantile_plot({{&run, "shell"}});
  REQUIRE(plot.series.size() == 1);
  const Series& series = plot.series[0];
  CHECK(series.x == std::vector<double>{0, 100.0 / 3, 200.0 / 3, 100});
  CHECK(series.y.front() == Approx(2));
  CHECK(series.y.back() == Approx(5));
  // blocks are measured in millimetres
  run.layout.parts.emplace_back();
  CHECK(quantile_plot({{&run, "shell"}}).series[0].y.back() == Approx(5));
  CHECK(quantile_plot({{&run, "shell"}}).y.label == "deviation from the net, Δ (mm)");
}

TEST_CASE("marks of six shells differ in shape or filling") {
  const record::Trajectory run = one_cell();
  const Plot plot = curvature_plot(std::vector<NamedRun>(6, {&run, "shell"}));
  std::set<std::pair<Marker, bool>> looks;
  for (const Series& series : plot.series) looks.insert({series.marker, series.hollow});
  CHECK(looks.size() == 6);
}

TEST_CASE("a saddle has one colour, whichever blocks are next to it") {
  record::Trajectory two = one_cell(), three = one_cell();
  for (const char* name : {"quarter sphere 1", "saddle"})
    two.layout.parts.emplace_back().name = name;
  for (const char* name : {"quarter sphere 1", "half cylinder", "saddle"})
    three.layout.parts.emplace_back().name = name;
  const BlockKinds of_two({{&two, ""}}), of_three({{&three, ""}});
  CHECK(of_two.colour("saddle") == of_three.colour("saddle"));
  CHECK_FALSE(of_two.colour("saddle") == of_two.colour("quarter sphere 2"));
  two.layout.parts.emplace_back().name = "vault";
  two.layout.parts.emplace_back().name = "dome";
  const auto keys = BlockKinds({{&two, ""}}).keys();
  REQUIRE(keys.size() == 4);
  for (std::size_t k = 0; k < keys.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      CHECK_FALSE(keys[k].colour == keys[other].colour);
}

TEST_CASE("seams with equal gaps and kinks are called equal") {
  record::Trajectory run = one_cell();
  for (const char* seam : {"a.east - b.west", "b.east - c.west"})
    for (const double line : {10.0, 30.0})
      run.layout.seam_rods.push_back({seam, 'u', line, 1, line});
  CHECK(seam_plots(run)[0].series[1].name == "b east – c west (equal)");
  run.layout.seam_rods.back().gap_mm = 2;
  CHECK(seam_plots(run)[0].series[1].name == "b east – c west");
}

TEST_CASE("seams are plotted about their middles, gap and kink") {
  record::Trajectory run = one_cell();
  run.layout.seam_rods = {{"a.east - b.west", 'u', 30, 1.5, 7},
                          {"a.east - b.west", 'v', 10, 1.5, 6},
                          {"a.east - b.west", 'u', 10, 0.5, 3},
                          {"a.east - b.west", 'v', 30, 0.5, 4}};
  const std::vector<Plot> plots = seam_plots(run);
  REQUIRE(plots.size() == 2);
  for (const Plot& plot : plots) REQUIRE(plot.series.size() == 1);
  const Series &gap = plots[0].series[0], &kink = plots[1].series[0];
  // rods of one joint have one position
  const double place = 10 * M_SQRT2;
  CHECK(gap.x[0] == Approx(-place));
  CHECK(gap.x[1] == Approx(-place));
  CHECK(gap.x[2] == Approx(place));
  CHECK(gap.y == std::vector<double>{1.5, 1.5, 0.5, 0.5});
  CHECK(kink.y == std::vector<double>{7, 6, 3, 4});
  // millimetres and degrees have axes of their own
  CHECK(plots[0].y.label == "gap (mm)");
  CHECK(plots[1].y.label == "angle between tangents (°)");
}

namespace {

record::Trajectory pushed() {
  record::Trajectory run = synthetic::dome(3, 2);
  for (int k = 0; k < 3; ++k) {
    record::Frame& frame = run.frames.edit()[std::size_t(k)];
    frame.depth_mm = 2 * k;
    frame.force_N = 0.1 * k * k;
    frame.event.clear();
    frame.K_bins.resize(2, 3);
    frame.K_bins << 0.01 * k, 0.002, 8, 0.02, 0.004, 9;
  }
  return run;
}

}  // namespace

TEST_CASE("the force of a push is plotted over all its frames, N over mm") {
  const record::Trajectory run = pushed();
  const Plot plot = force_plot({{&run, "inward"}});
  REQUIRE(plot.series.size() == 1);
  CHECK(plot.series[0].x == std::vector<double>{0, 2, 4});
  CHECK(plot.series[0].y[2] == Approx(0.4));
  CHECK(plot.x.label.find("mm") != std::string::npos);
  CHECK(plot.y.label.find("N") != std::string::npos);
}

TEST_CASE("a push has a band of its error from snap to snap, where that is known") {
  record::Trajectory run = pushed();
  CHECK(force_plot({{&run, "inward"}}).bands.empty());
  for (record::Frame& frame : run.frames.edit()) frame.push_error_N = 0.01;
  const Plot plot = force_plot({{&run, "a"}, {&run, "b"}});
  REQUIRE(plot.bands.size() == 2);
  CHECK(plot.bands[0].x == std::vector<double>{0, 2, 4});
  CHECK(plot.bands[0].low[1] == Approx(0.09));
  CHECK(plot.bands[0].high[2] == Approx(0.41));
  CHECK_FALSE(plot.bands[0].name.empty());
  CHECK(plot.bands[1].name.empty());
  run.frames.edit()[2].event = "snap at depth 3.1 mm";
  CHECK(force_plot({{&run, "a"}}).bands[0].x == std::vector<double>{0, 2});
}

TEST_CASE("a snap is straight down at the depth where it is, with its name once") {
  record::Trajectory run = pushed();
  run.frames.edit()[1].stiffness_N_per_mm = -0.05;
  record::Frame snapped = run.frames[2];
  snapped.event = "snap at depth 3.100 mm";
  snapped.stiffness_N_per_mm = 0.1;
  run.frames.edit().back() = snapped;
  const Plot plot = force_plot({{&run, "a"}, {&run, "b"}});
  REQUIRE(plot.series.size() == 5);
  const Series &way = plot.series[0], &snap = plot.series[1];
  REQUIRE(way.y.size() == 4);
  CHECK(std::isnan(way.y[2]));
  CHECK(snap.dash.size() == 2);
  REQUIRE(snap.x.size() >= 4);
  CHECK((snap.x[0] == 2 && snap.x[1] == Approx(3.1) && snap.x[2] == Approx(3.1) && snap.x[3] == 4));
  // extrapolated from the forces and stiffnesses on both sides
  CHECK((snap.y[0] == Approx(0.1) && snap.y[1] == Approx(0.1 - 1.1 * 0.05)));
  CHECK((snap.y[2] == Approx(0.4 - 0.9 * 0.1) && snap.y[3] == Approx(0.4)));
  // the row of the legend has the colour of no run
  CHECK((snap.name.empty() && plot.series[3].name.empty()));
  const Series& key = plot.series[4];
  CHECK((key.name == "snap to another state" && key.x.empty() && key.dash == snap.dash));
  CHECK((key.colour.r != snap.colour.r && key.colour.r != plot.series[3].colour.r));
  // both runs are visible where they are equal
  CHECK(way.line_width > plot.series[2].line_width);
  CHECK(snap.line_width > plot.series[3].line_width);
  // and as wide where they are not
  record::Trajectory stiffer = run;
  for (record::Frame& frame : stiffer.frames.edit()) frame.force_N *= 2;
  const Plot differ = force_plot({{&run, "a"}, {&stiffer, "b"}});
  CHECK(differ.series[0].line_width == differ.series[2].line_width);
}

TEST_CASE("the largest force is marked if the force then falls") {
  record::Trajectory run = pushed();
  CHECK(test::series_named(force_plot({{&run, "a"}}), "largest force") == nullptr);
  run.frames.edit()[2].force_N = 0.05;
  const Plot plot = force_plot({{&run, "a"}});
  REQUIRE(plot.series.size() == 3);
  CHECK(plot.series[1].x == std::vector<double>{2});
  CHECK(plot.series[1].y[0] == Approx(0.1));
  CHECK(plot.series[2].name == "largest force");
}

TEST_CASE("the largest force is found after a frame without a force") {
  record::Trajectory run = pushed();
  run.frames.edit()[0].force_N = NAN;
  CHECK(test::series_named(force_plot({{&run, "a"}}), "largest force") == nullptr);
  record::Frame fallen = run.frames.back();
  fallen.depth_mm = 6, fallen.force_N = 0.05;
  run.frames.push_back(fallen);
  const Plot plot = force_plot({{&run, "a"}});
  REQUIRE(test::series_named(plot, "largest force") != nullptr);
  CHECK(plot.series[1].x == std::vector<double>{4});
}

TEST_CASE("the plot of a force reads the scalars of frames alone, and equal long curves are seen") {
  /// A push of which only the scalars can be read.
  struct Heads : record::FrameSource {
    std::vector<record::Frame> frames;
    std::size_t size() const override { return frames.size(); }
    const record::Frame* head(std::size_t k) const override { return &frames[k]; }
    Result<record::Frame> read(std::size_t) const override { return fail(Fault::io, "read"); }
  };
  auto source = std::make_shared<Heads>();
  for (int k = 0; k < 2500; ++k) {
    record::Frame frame;
    frame.depth_mm = k, frame.force_N = std::sin(0.002 * k);
    source->frames.push_back(frame);
  }
  source->frames[2400].event = "snap at depth 2399.5 mm";
  record::Trajectory run;
  run.frames = record::FrameList(source);
  const Plot plot = force_plot({{&run, "a"}, {&run, "b"}});
  CHECK_FALSE(run.frames.fault());
  CHECK(plot.series[0].x[2399] == 2399);
  CHECK(plot.series[0].line_width > test::series_named(plot, "b")->line_width);
}

TEST_CASE("pushed shells have their depth, and the grey shape its name") {
  record::Trajectory run = pushed();
  for (record::Frame& frame : run.frames.edit()) frame.actuation = 1;
  MovieStyle style;
  style.size = {64, 48};
  style.title = "title";
  Watch watch;
  const auto two = value_of(draw_pushes({{&run, "inward"}, {&run, "outward"}}, style, watch));
  CHECK(two.panels[1].caption == "outward\n*δ* = 4.00 mm");
  REQUIRE(two.keys.size() == 1);
  CHECK(two.keys[0].name == "unloaded");
  CHECK(value_of(draw_pushes({{&run, "inward"}}, style, watch)).panels[0].caption ==
        "*δ* = 4.00 mm");
  style.look.ghost = false;
  CHECK(value_of(draw_pushes({{&run, "inward"}}, style, watch)).keys.empty());
}

TEST_CASE("one plot has its legend below its title, several have one above all") {
  const record::Trajectory run = pushed();
  const TemporaryFolder folder;
  for (const std::size_t count : {1, 2}) {
    double title = 0, legend = 0;
    const test::CanvasObserver observer([&](const Canvas& canvas) {
      for (std::size_t k = 0; k < canvas.texts().size(); ++k) {
        if (canvas.texts()[k].starts_with("push")) title = canvas.text_boxes()[k].y;
        if (canvas.texts()[k].starts_with("mean of all")) legend = canvas.text_boxes()[k].y;
      }
    });
    REQUIRE(write_push_bins(folder / "bins", std::vector<NamedRun>(count, {&run, "push"}), ""));
    CHECK((legend > title) == (count == 1));
  }
}

TEST_CASE("states that are not stable are dashed, and the line has a gap there") {
  record::Trajectory run = pushed();
  run.frames.edit()[2].negative_pivots = 1;
  const Plot plot = force_plot({{&run, "a"}});
  REQUIRE(plot.series.size() == 3);
  CHECK(std::isnan(plot.series[0].y[2]));
  CHECK(plot.series[2].name == "unstable");
  CHECK(plot.series[1].dash.size() == 2);
  CHECK((plot.series[1].x[0] == 2 && plot.series[1].x[1] == 4));
}

TEST_CASE("shells over nets are lines, with the half-span where it is requested") {
  const record::Trajectory run = one_cell();
  MovieStyle style;
  style.size = {64, 48};
  Watch watch;
  const auto figure =
      draw_over_nets({{.run = &run, .name = "shell", .half_span = true}}, style, watch);
  REQUIRE(figure);
  CHECK(figure->as_lines);
  REQUIRE(figure->panels.size() == 1);
  CHECK(figure->panels[0].lines);
  REQUIRE(figure->panels[0].labels.size() == 1);
  CHECK(figure->panels[0].labels[0].text == "*x* = *L*");
}

TEST_CASE("interpenetrations are named in the caption of a panel that marks them") {
  record::Trajectory run = one_cell();
  MovieStyle style;
  style.size = {64, 48};
  Watch watch;
  const auto caption = [&] {
    const auto over_net = draw_over_nets({{.run = &run, .name = "cap"}}, style, watch);
    const auto pushed = draw_pushes({{.run = &run, .name = "cap"}}, style, watch);
    REQUIRE((over_net && pushed));
    CHECK(pushed->panels[0].caption.ends_with(over_net->panels[0].caption.substr(3)));
    return over_net->panels[0].caption;
  };
  CHECK(caption() == "cap");
  run.frames.edit()[0].contacts = 2;
  CHECK(caption() == "cap\nviolet: 2 interpenetrations (contact not modelled)");
}
