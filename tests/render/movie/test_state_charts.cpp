// Charts of branches and of states.
#include <set>

#include "engine/record/phase_diagram.h"
#include "render/movie/state_charts.h"
#include "tests/render/canvas/ink.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
using record::BranchEvent;
using record::BranchPoint;
using record::StateClass;

namespace {

/// A path with a gap between two pitchforks near its start, and a branch from the first.
std::vector<BranchPoint> points() {
  std::vector<BranchPoint> all;
  for (int k = 0; k <= 100; ++k) {
    BranchPoint p;
    p.progress = 0.01 * k;
    p.boundary_radius_mm = 126 - 30 * p.progress;
    p.height_mm = 40 * std::sqrt(p.progress);
    p.amplitude = 0;
    p.negative_pivots = k > 5 && k < 9 ? 1 : 0;
    if (k == 5 || k == 9) p.event = BranchEvent::bifurcation;
    all.push_back(p);
  }
  for (int k = 5; k <= 100; ++k) {
    BranchPoint p = all[std::size_t(k)];
    p.branch = 1;
    p.amplitude = 0.01 * std::sqrt(0.01 * (k - 5));
    p.negative_pivots = k == 5 ? 1 : 0;
    p.event = k == 100 ? BranchEvent::locking : BranchEvent::none;
    all.push_back(p);
  }
  return all;
}

}  // namespace

TEST_CASE("load factors are marked where the rods reach their strength, with the error") {
  using record::LoadPoint;
  const std::vector<LoadPoint> path{{"snow", 0, 0, 0, BranchEvent::none, 0.2},
                                    {"snow", 1, 2, 0, BranchEvent::none, 0.6},
                                    {"snow", 2, 5, 0, BranchEvent::none, 1.4},
                                    {"wind", 1, 3, 0, BranchEvent::none, 0.5}};
  record::LoadRow torn, whole;
  torn.load_case = "snow", whole.load_case = "wind";
  torn.strength_factor = 1.45, torn.strength_error = 0.1;
  const Plot plot = load_plot(path, {torn, whole}, "");
  const Series& marks = plot.series.back();
  CHECK(marks.name == "strength reached");
  CHECK(marks.x == std::vector<double>{3.5});
  CHECK(marks.y == std::vector<double>{1.45});
  CHECK(marks.y_error == std::vector<double>{0.1});
  CHECK(load_plot(path, {whole}, "").series.back().name == "wind");
}

TEST_CASE("stable parts are full, others dashed, and parts meet where something happens") {
  const Plot plot = branches_plot(points(), BranchAxis::amplitude);
  CHECK(plot.x.label.starts_with("*R*_{a} (mm)"));
  // a branch is labelled with its number
  REQUIRE(plot.notes.size() == 1);
  CHECK(plot.notes[0].text == "1");
  std::vector<Series> path, branch;
  for (const Series& s : plot.series)
    if (s.line_width > 1.2)
      path.push_back(s);
    else if (s.line_width > 0)
      branch.push_back(s);
  REQUIRE(path.size() == 3);
  CHECK(path[0].dash.empty());
  CHECK_FALSE(path[1].dash.empty());
  CHECK(path[0].x.back() == Approx(126 - 30 * 0.05));
  CHECK(path[1].x.front() == path[0].x.back());
  CHECK(path[1].x.back() == Approx(126 - 30 * 0.09));
  // a branch that is stable from its start, though the path is not there
  REQUIRE(branch.size() == 1);
  CHECK(branch[0].dash.empty());
}

TEST_CASE("where there is no radius progress is the axis") {
  auto all = points();
  for (BranchPoint& p : all) p.boundary_radius_mm = record::unknown;
  const Plot plot = branches_plot(all, BranchAxis::height);
  CHECK(plot.x.label == "progress; actuation →");
  CHECK(plot.series.front().x.back() == 1);
}

TEST_CASE("a diagram with a close-up: all that is written fits") {
  const TemporaryFolder folder;
  int drawn = 0;
  const test::CanvasObserver watch([&](const Canvas& canvas) {
    ++drawn;
    test::check_apart(canvas);
    for (const char* text : {"stable", "unstable", "bifurcation", "strain limit reached"})
      CHECK(test::has(canvas.texts(), text));
    // four panels
    CHECK(std::ranges::count(canvas.texts(), "height (mm)") == 2);
  });
  REQUIRE(write_branches(folder / "branches", points(), "A diagram"));
  CHECK(drawn == 3);
}

namespace {

record::PhasePoint point(double leg, int rods, StateClass kind, const record::StateCount& count) {
  record::PhasePoint made;
  made.longest_leg = leg;
  made.rods = rods;
  made.found = true;
  made.classes[std::size_t(kind)] = count;
  return made;
}

}  // namespace

TEST_CASE("every class of states has a sign and a colour of its own, in all pictures") {
  std::set<Marker> markers;
  std::set<float> reds;
  for (const StateClass kind : {StateClass::i, StateClass::ii, StateClass::iii, StateClass::iv}) {
    markers.insert(look_of(kind).marker);
    reds.insert(look_of(kind).colour.r);
  }
  CHECK(markers.size() == 4);
  CHECK(reds.size() == 4);
  const Plot plot = phase_plot({point(1, 10, StateClass::ii, {1, 5, 0})}, "");
  const Series* ii = test::series_named(plot, "state *ii*");
  REQUIRE(ii);
  CHECK(ii->marker == look_of(StateClass::ii).marker);
  CHECK(ii->colour.r == look_of(StateClass::ii).colour.r);
}

TEST_CASE("a class that trials met is filled, one of symmetric forms alone is hollow") {
  record::PhaseDiagram diagram{point(1, 10, StateClass::ii, {1, 5, 0}),
                               point(2, 10, StateClass::ii, {1, 0, 3}),
                               point(2, 12, StateClass::other, {7, 9, 0})};
  record::PhasePoint nothing;
  nothing.longest_leg = 1;
  nothing.rods = 12;
  diagram.push_back(nothing);
  const Plot plot = phase_plot(diagram, "A diagram");
  const Series* ii = test::series_named(plot, "state *ii*");
  REQUIRE(ii);
  CHECK_FALSE(ii->hollow);
  REQUIRE(ii->x.size() == 1);
  CHECK(std::abs(ii->x[0] - 1) < 0.5);
  const bool hollow = std::ranges::any_of(plot.series, [](const Series& series) {
    return series.hollow && series.x.size() == 1 && std::abs(series.x[0] - 2) < 0.5;
  });
  CHECK(hollow);
  REQUIRE(plot.notes.size() == 1);
  CHECK(plot.notes[0].text == "+7");
  REQUIRE(test::series_named(plot, "none found"));
  CHECK(test::series_named(plot, "none found")->x == std::vector<double>{1});
}

TEST_CASE("the lines of the diagram are those of the shortest leg") {
  const record::PhaseDiagram diagram{point(0.25, 4, StateClass::i, {1, 1, 0}),
                                     point(5, 20, StateClass::i, {1, 1, 0})};
  const Plot plot = phase_plot(diagram, "");
  int lines = 0;
  for (const Series& series : plot.series) {
    if (series.line_width == 0) continue;
    const double leg = lines == 0 ? 1 : lines == 1 ? 0 : -1;
    int drawn = 0;
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.x[k])) continue;
      ++drawn;
      const double n = series.y[k];
      const double radius = series.x[k] + 0.5 * (n - 1);
      CHECK(std::sqrt(radius * radius - 0.25 * (n - 1) * (n - 1)) - 0.5 * (n - 1) ==
            Approx(leg).margin(1e-9));
    }
    CHECK(drawn > 20);
    ++lines;
  }
  CHECK(lines == 3);
}

namespace {

/// Three states of a shell of one rod.
record::Trajectory run() {
  record::Trajectory all;
  all.layout.rods = {{0, 1, 2}};
  all.layout.actuated_boundary = Eigen::Matrix3Xd::Zero(3, 4);
  all.layout.actuated_boundary.row(0) << 10, 0, -10, 0;
  all.layout.actuated_boundary.row(1) << 0, 10, 0, -10;
  for (int k = 0; k < 3; ++k) {
    record::Frame frame;
    frame.index = k;
    frame.nodes = Eigen::Matrix3Xd::Zero(3, 3);
    frame.nodes.row(0) << -10, 0, 10;
    frame.nodes(2, 1) = 3 + k;
    all.frames.push_back(frame);
  }
  return all;
}

using record::Disturbance;

record::StateTables tables() {
  record::StateTables all;
  for (int k = 0; k < 3; ++k) {
    record::StateRow row;
    row.state = k + 1;
    row.energies[Term::bend] = 40;  // all at one height
    row.height_mm = 50;
    all.rows.push_back(row);
  }
  all.rows[0].kind = record::StateClass::ii;
  all.transitions = {{{1}, {2}, Disturbance::released, 1},
                     {{1}, {1}, Disturbance::pushed, 5},
                     {{1}, {}, Disturbance::pushed, 3},
                     {{2}, {3}, Disturbance::pushed, 2}};
  return all;
}

}  // namespace

TEST_CASE("the graph of transitions names every state and counts returns, and no texts overlap") {
  const TemporaryFolder folder;
  {
    const test::CanvasObserver watch([&](const Canvas& canvas) {
      for (const char* text : {"ii.1", "other.2", "back 5, new 3", "back 0"})
        CHECK(test::has(canvas.texts(), text));
      test::check_apart(canvas);
    });
    REQUIRE(write_transition_graph(folder / "graph", tables(), run(), "Some states", {}));
  }
  for (const char* kind : {".png", ".svg", ".pdf"})
    CHECK(std::filesystem::exists(folder / (std::string("graph") + kind)));
}

TEST_CASE("barriers are drawn between known states, as high as they are") {
  record::StateTables states = tables();
  states.barriers = {{{1}, {2}, 41, 1, 0.5}, {{2}, {}, 44, 4, 3}, {{1}, {1}, 43, 3, 3}};
  const Plot plot = barrier_plot(states);
  REQUIRE(plot.series.size() == 3);  // a curve and two bars
  // the curve starts at the state's energy in all other pictures; its highest point is the mean of
  // both states' energies plus their barriers
  const double from = states.rows[0].energy_mJ(), to = states.rows[1].energy_mJ();
  CHECK(plot.series[0].y.front() == Approx(from));
  CHECK(plot.series[0].y.back() == Approx(to));
  CHECK(std::ranges::max(plot.series[0].y) == Approx(0.5 * (from + 1 + to + 0.5)));
  CHECK(barrier_plot({}).series.empty());
}
