#include "render/movie/run_summary.h"

#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

// a run of two frames whose cells all have these K
record::Trajectory of_K(double first, double last) {
  record::Trajectory run = synthetic::dome(2, 1);
  run.frames.edit()[0].cell_K.setConstant(first);
  run.frames.edit()[1].cell_K.setConstant(last);
  return run;
}

// two frames whose rods have this force and energy; the first edge has another force
record::Trajectory of_rods(double force_N, double other_N, double energy = 0) {
  record::Trajectory run = synthetic::dome(2, 1);
  for (record::Frame& frame : run.frames.edit()) {
    frame.axial_force_N.setConstant(record::edges_of_rods(run.layout), force_N);
    frame.axial_force_N[0] = other_N;
    frame.bending_mJ_per_m.setConstant(record::points_of_rods(run.layout), energy);
  }
  return run;
}

MovieStyle by(ColourBy what) {
  MovieStyle style;
  style.colour_by = what;
  return style;
}

std::optional<ColourBar> bar(const std::vector<record::Trajectory>& runs,
                             const MovieStyle& style = {}) {
  std::vector<RunSummary> surveys;
  for (const auto& run : runs) surveys.push_back(summarise_run(run));
  std::vector<const RunSummary*> all;
  for (const RunSummary& survey : surveys) all.push_back(&survey);
  return colour_bar_of(all, style);
}

}  // namespace

TEST_CASE("K takes a map about zero, of one sign too, so that a colour means one sign") {
  const auto positive = value_of(bar({of_K(0, 0.3)}));
  CHECK(positive.scale.map == diverging);
  CHECK(positive.scale.low == -positive.scale.high);
  CHECK(positive.scale.high >= 0.3);
  const auto negative = bar({of_K(0, -0.3)});
  CHECK(negative->scale.map == diverging);
  CHECK(negative->scale(0).b == positive.scale(0).b);
  // red above, blue below
  CHECK(positive.scale(0.3).r > positive.scale(0.3).b);
  CHECK(negative->scale(-0.3).r < negative->scale(-0.3).b);
  CHECK(positive.words == "integrated Gauss curvature");
  const auto both = bar({of_K(-0.2, 0.3)});
  CHECK(both->scale.map == diverging);
  CHECK(both->scale.low == -both->scale.high);
}

TEST_CASE("runs shown together share one range, so that what is not curved does not look so") {
  const auto alone = bar({of_K(0.001, -0.001)});
  const auto shared = bar({of_K(0, 0.4), of_K(0.001, -0.001), of_K(0, -0.4)});
  CHECK(shared->scale.high >= 0.4);
  CHECK(shared->scale.map == diverging);
  // nor alone: a scale never shrinks to noise
  CHECK(alone->scale.high >= 0.02);
  // nor is it wide where nothing is curved at all
  CHECK(bar({of_K(0, 0)})->scale.high == 0.02);
}

TEST_CASE("the range of the change of K contains 0, and a range of the style replaces it") {
  MovieStyle style;
  style.colour_by = ColourBy::K_change;
  const auto change = bar({of_K(0.5, 0.45)}, style);
  CHECK(change->scale.low <= -0.05);
  CHECK(change->scale.high <= 0.1);
  CHECK(change->label.starts_with("Δ"));
  style.look.range = {-0.01, 0.03};
  const auto given = bar({of_K(0.5, 0.45)}, style);
  CHECK(given->scale.low == -0.01);
  CHECK(given->scale.high == 0.03);
  CHECK(given->below_scale);
  CHECK_FALSE(given->above_scale);
  style.look.cells = false;
  CHECK_FALSE(bar({of_K(0.5, 0.45)}, style));
}

TEST_CASE("axial forces diverge about zero over all runs, of one sign too") {
  const auto both =
      value_of(bar({of_rods(0.2, 0.2), of_rods(-0.4, -0.4)}, by(ColourBy::axial_force)));
  CHECK(both.label == "*N* (N)");
  CHECK(both.words == "axial force");
  CHECK(both.scale.map == diverging);
  CHECK(both.scale.high >= 0.4);
  CHECK(both.scale.low == -both.scale.high);
  // a rod without force is seen on white
  CHECK(both.scale(0).r < 0.9f);
  CHECK(both.scale(0).r == Approx(both.scale(0).b).margin(0.01));
  const auto pressed = bar({of_rods(-0.2, -0.1)}, by(ColourBy::axial_force));
  CHECK(pressed->scale.map == diverging);
  CHECK(pressed->scale.low <= -0.2);
  CHECK(pressed->scale.high == -pressed->scale.low);
  // a few rods bear more than the scale contains
  CHECK(bar({of_rods(0.2, -3)}, by(ColourBy::axial_force))->below_scale);
}

TEST_CASE("bending energy goes up from zero, and the style's range and map go before") {
  MovieStyle style = by(ColourBy::energy);
  const auto energy = bar({of_rods(0, 0, 1.5), of_rods(0, 0, 0.2)}, style);
  CHECK(energy->label.find("(mJ/m)") != std::string::npos);
  CHECK(energy->scale.map == sequential);
  CHECK(energy->scale.low == 0);
  CHECK(energy->scale.high >= 1.5);
  style.look.range = {0, 1};
  style.look.map = grey;
  const auto given = bar({of_rods(0, 0, 1.5)}, style);
  CHECK(given->scale.high == 1);
  CHECK(given->scale.map == grey);
  CHECK(given->above_scale);
  // without any, as in the flat
  CHECK(bar({of_rods(0, 0, 0)}, by(ColourBy::energy))->scale.map == sequential);
}

TEST_CASE("the deviation's scale is that of the shell at the end of its boundary's path") {
  record::Trajectory run = synthetic::dome(3, 1);
  run.layout.net_nodes = run.frames[2].nodes;
  run.layout.net_nodes.row(2).array() += 0.01 * run.layout.length_scale_mm;
  const auto near = value_of(bar({run}, by(ColourBy::deviation)));
  CHECK(near.scale.low == 0);
  CHECK(near.scale.high == Approx(1));  // %
  CHECK(near.above_scale);
  CHECK_FALSE(near.below_scale);
  // there is no deviation without a net
  CHECK_FALSE(bar({synthetic::dome(3, 1)}, by(ColourBy::deviation)));
}

TEST_CASE("the largest stress is within its scale, a few large energies are not") {
  std::vector<double> sizes(100, 1.0);
  sizes.front() = 9;
  CHECK(colour_scale(ColourBy::stress, sizes, {1, 9}).high >= 9);
  CHECK(colour_scale(ColourBy::energy, sizes, {1, 9}).high < 2);
  CHECK(colour_scale(ColourBy::displacement, sizes, {1, 9}).high >= 9);
  CHECK(named_bar(ColourBy::stress, {}).label == "*σ* (MPa)");
}
