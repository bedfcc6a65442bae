// Colours of a shell that is compared with another one.
#include "app/window/shell_drawing.h"

#include <catch2/catch.hpp>

#include "render/movie/run_summary.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("the distance from a scan, which has joints alone, is known along the complete rods") {
  // a rod from edge point 2 over the joints 0 and 1 to edge point 3, with a node between the joints
  auto layout = std::make_shared<record::Layout>();
  layout->joints.resize(2);
  layout->joints[1].i = 1;
  layout->edge_points = {2, 3};
  layout->rods = {{2, 0, 4, 1, 3}};
  ShellView shell;
  shell.layout = layout;
  shell.frame.nodes = Eigen::Matrix3Xd::Zero(3, 5);
  record::Layout joints;
  joints.joints = layout->joints;
  record::Frame scan;
  scan.nodes = Eigen::Matrix3Xd::Zero(3, 2);
  scan.nodes.row(2) << 1, 3;
  Show show;
  show.colour_by = ColourBy::displacement;
  show.other = std::make_shared<const OtherShell>(OtherShell{"scan", view_of(joints, scan, scan)});
  const Eigen::VectorXd values = values_of(shell, show);
  REQUIRE(values.size() == 5);
  CHECK(values[0] == 1);
  CHECK(values[1] == 3);
  CHECK(values[4] == 2);
  // past the joints it is that of the nearest one
  CHECK(values[2] == 1);
  CHECK(values[3] == 3);
  CHECK(scale_of(shell, show).high < 10);
}

TEST_CASE("colours of the window have the scale and the bar of movies") {
  auto layout = std::make_shared<record::Layout>();
  layout->cells.resize(2);
  record::Frame frame;
  frame.cell_K = Eigen::Vector2d(-0.3, 0.1);
  const auto shell = view_of(*layout, frame, frame);
  Show show;
  show.scale = scale_of(*shell, show);
  CHECK(show.scale == render::colour_scale(ColourBy::K, {0.3, 0.1}, {-0.3, 0.1}));
  CHECK(bar_of(*shell, show).label == "*K*_{□} (rad)");
  CHECK(bar_of(*shell, show).words == "integrated Gauss curvature");
  show.colour_by = ColourBy::K_change;  // none at all
  CHECK(scale_of(*shell, show).high == 0.02);
}

TEST_CASE("arrows of loads have a scale only if their lengths are to scale") {
  ShellView shell;
  shell.layout = std::make_shared<const record::Layout>();
  shell.frame.loads_N = Eigen::Vector3d(0, 0, -1).replicate(1, 30);
  Show show;
  show.largest_load_N = 1;
  CHECK_FALSE(arrow_key_of(shell, show));
  shell.frame.loads_N(2, 0) = -29;
  CHECK(arrow_key_of(shell, show));
  show.loads = false;
  CHECK_FALSE(arrow_key_of(shell, show));
}
