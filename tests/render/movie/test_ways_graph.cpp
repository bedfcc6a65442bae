#include "render/movie/state_charts.h"

#include <catch2/catch.hpp>

#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

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

record::StateTables tables() {
  record::StateTables all;
  for (int k = 0; k < 3; ++k) {
    record::StateRow row;
    row.state = k + 1;
    row.energies[Term::bend] = 40;  // all in one place
    row.height_mm = 50;
    all.rows.push_back(row);
  }
  all.rows[0].kind = record::StateClass::ii;
  all.transitions = {
      {1, 2, "let out", 1}, {1, 1, "poked", 5}, {1, 0, "poked", 3}, {2, 3, "poked", 2}};
  return all;
}

}  // namespace

TEST_CASE("the graph of ways writes every state and what came back, apart from one another") {
  const TemporaryFolder folder;
  std::vector<std::string> texts;
  std::vector<Box> boxes;
  {
    const CanvasObserver watch([&](const Canvas& canvas) {
      texts = canvas.texts();
      boxes = canvas.text_boxes();
    });
    REQUIRE(write_transition_graph(folder.path() / "ways", tables(), run(), "Some states", {}));
  }
  for (const char* text : {"1", "2", "1: state ii", "back 5, new 3", "back 0"})
    CHECK(std::ranges::find(texts, text) != texts.end());
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      CAPTURE(texts[a], texts[b]);
      CHECK_FALSE(boxes[a].overlaps(boxes[b]));
    }
  for (const char* kind : {".png", ".svg", ".pdf"})
    CHECK(std::filesystem::exists(folder.path() / (std::string("ways") + kind)));
}

TEST_CASE("barriers are drawn between known states, as high as they are") {
  record::StateTables states = tables();
  states.barriers = {{1, 2, 41, 1, 0.5}, {2, 0, 44, 4, 3}, {1, 1, 43, 3, 3}};
  const Plot plot = barrier_plot(states);
  REQUIRE(plot.series.size() == 3);  // a curve and two bars
  CHECK(std::ranges::max(plot.series[0].y) == Approx(41));
  CHECK(plot.series[0].y.front() == Approx(40));
  CHECK(plot.series[0].y.back() == Approx(40.5));
  CHECK(barrier_plot({}).series.empty());
}
