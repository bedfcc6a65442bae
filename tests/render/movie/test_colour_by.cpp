#include <cmath>

#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "tests/presets.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

MovieStyle coloured(ColourBy by) {
  MovieStyle style;
  style.colour_by = by;
  return style;
}

}  // namespace

TEST_CASE("what no frame knows cannot be what is coloured") {
  record::Trajectory run = synthetic::dome(3, 2);
  const auto lacks = [&](ColourBy by) {
    const MovieStyle style = coloured(by);
    const auto checked = check_showable(run, style);
    CHECK(bool(check_coloured(summarise_run(run), style)) == bool(checked));
    return checked ? "" : checked.error().message;
  };
  CHECK(lacks(ColourBy::axial_force)
            .find("[movie] colour_by = \"axial_force\": the run has no axial forces") == 0);
  CHECK(lacks(ColourBy::energy).find("bending energy") != std::string::npos);
  CHECK(lacks(ColourBy::deviation).find("no net") != std::string::npos);
  run.layout.net_nodes = run.frames[0].nodes;
  CHECK(lacks(ColourBy::deviation).empty());
  run.frames.edit()[2].axial_force_N.setConstant(record::edges_of_rods(run.layout), -0.1);
  CHECK(lacks(ColourBy::axial_force).empty());
  CHECK(lacks(ColourBy::stress).find("stress") != std::string::npos);
  run.frames.edit()[2].stress_MPa.setConstant(record::points_of_rods(run.layout), 300);
  CHECK(lacks(ColourBy::stress).empty());
  CHECK(lacks(ColourBy::utilisation).find("strength") != std::string::npos);
  run.layout.strength_MPa.assign(run.layout.rods.size(), 500);
  CHECK(lacks(ColourBy::utilisation).empty());
}

TEST_CASE("rods are coloured by the angles of their joints, from the least on") {
  record::Trajectory run = synthetic::dome(3, 2);
  const MovieStyle style = coloured(ColourBy::joint_angle);
  CHECK(check_showable(run, style).error().message.find("no joint has") != std::string::npos);
  Eigen::VectorXd& angles = run.frames.edit()[2].angle_deg;
  angles.setLinSpaced(Eigen::Index(run.layout.joints.size()), 60, 80);
  const Stage stage(run, style);
  const ColourScale scale = stage.colour_bar()->scale;
  CHECK(scale.low == 60);
  CHECK(scale.high == 80);
  const auto colours = stage.drawing(run.frames[2]).node_colours;
  for (std::size_t k = 0; k < run.layout.joints.size(); ++k)
    CHECK(colours[std::size_t(run.layout.joints[k].node)] == scale(angles[Eigen::Index(k)]));
}

TEST_CASE("rods are coloured by their forces, grey where a frame does not know them") {
  record::Trajectory run = synthetic::dome(3, 2);
  record::Frame& last = run.frames.edit()[2];
  last.axial_force_N.setConstant(record::edges_of_rods(run.layout), -0.1);
  last.axial_force_N.head(4).setConstant(0.1);
  MovieStyle style = coloured(ColourBy::axial_force);
  const Stage stage(run, style);
  const Drawing known = stage.drawing(run.frames[2]), unknown = stage.drawing(run.frames[1]);
  REQUIRE(long(known.node_colours.size()) == last.nodes.cols());
  CHECK(known.cell_colours.empty());
  const Colour pulled = known.node_colours[std::size_t(run.layout.rods[0][0])],
               pressed = known.node_colours[std::size_t(run.layout.rods[5][0])];
  CHECK(pulled.r > pulled.b);
  CHECK(pressed.b > pressed.r);
  for (const Colour& grey : unknown.node_colours) CHECK(grey == stage.colour_bar()->scale(NAN));
  CHECK(unknown.rod_diameter_mm == known.rod_diameter_mm);
  // joints would interrupt the colours
  CHECK(known.joint_diameter_mm == 0);
  style.look.joint_chosen = true;
  CHECK(Stage(run, style).drawing(run.frames[2]).joint_diameter_mm > 0);
}

TEST_CASE("cells are coloured by their deviation from the net") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.net_nodes = run.frames[2].nodes;
  run.layout.net_nodes.leftCols(60).row(2).array() += 2;
  const Stage stage(run, coloured(ColourBy::deviation));
  const Drawing drawing = stage.drawing(run.frames[2]);
  REQUIRE(drawing.cell_colours.size() == run.layout.cells.size());
  CHECK(drawing.node_colours.empty());
  CHECK(drawing.cell_colours.front().r < drawing.cell_colours.back().r);
}
