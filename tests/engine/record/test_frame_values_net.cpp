#include "engine/record/frame_values.h"

#include <catch2/catch.hpp>

#include "tests/engine/record/sample_run.h"

using namespace gridshell;
using namespace gridshell::record;

TEST_CASE("a cell lies off its net by the mean of its joints, over the length scale") {
  Trajectory run = sample_trajectory();
  Frame frame = run.frames[0];
  CHECK_FALSE(has_net(run.layout));
  CHECK(deviation_of_nodes(run.layout, frame).size() == 0);
  CHECK(deviation_of_cells(run.layout, frame).size() == 0);
  run.layout.net_nodes = frame.nodes;
  for (int joint = 0; joint < 4; ++joint) frame.nodes(2, joint) += 1.26 * (joint + 1);
  const Eigen::VectorXd of_nodes = deviation_of_nodes(run.layout, frame);
  REQUIRE(of_nodes.size() == 12);
  CHECK(of_nodes[3] == Approx(0.04));
  CHECK(of_nodes[4] == 0);
  const Eigen::VectorXd of_cells = deviation_of_cells(run.layout, frame);
  REQUIRE(of_cells.size() == 1);
  CHECK(of_cells[0] == Approx(0.025));
}
