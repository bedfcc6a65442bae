#include "render/movie/run_summary.h"

#include <catch2/catch.hpp>

#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

/// A dome whose joints each bear the same load downwards.
record::Trajectory loaded_dome() {
  record::Trajectory run = synthetic::dome(2, 6);
  run.layout.supports.clear();
  for (const record::Joint& joint : run.layout.joints) run.layout.supports.push_back(joint.node);
  for (record::Frame& frame : run.frames.edit())
    frame.loads_N = Eigen::Vector3d(0, 0, -2).replicate(1, long(run.layout.supports.size()));
  return run;
}

}  // namespace

TEST_CASE("a state alone is compared with the first frame of its run") {
  const record::Trajectory run = synthetic::dome(3, 2);
  record::Trajectory last{run.layout, {}};
  last.frames = {record::Frame(run.frames.back())};
  const record::Frame first(run.frames.front());
  CHECK(summarise_run(last).largest_move_mm == 0);
  CHECK(summarise_run(last, &first).largest_move_mm == Approx(summarise_run(run).largest_move_mm));
}

TEST_CASE("of the loads of an area a few arrows of one length are shown, without a scale") {
  record::Trajectory run = loaded_dome();
  REQUIRE(run.layout.joints.size() >= 25);
  record::Frame& last = run.frames.edit().back();
  CHECK(loads_all_alike(last));
  auto arrows = force_arrows(run.layout, last, 2);
  CHECK(arrows.size() > 5);
  CHECK(arrows.size() <= 25);
  CHECK((arrows[0].to - arrows[0].from).norm() == Approx(longest_force(run.layout)));
  CHECK_FALSE(summarise_run(run).arrows_to_scale);
  // one that is larger, or points elsewhere, is a load of its own
  last.loads_N(2, 3) = -80;
  CHECK_FALSE(loads_all_alike(last));
  CHECK(summarise_run(run).arrows_to_scale);
  last.loads_N.col(3) << 2, 0, 0;
  CHECK_FALSE(loads_all_alike(last));
  arrows = force_arrows(run.layout, last, 2);
  CHECK(arrows.size() == run.layout.supports.size());
}

TEST_CASE("arrows of an area are even over the footprint, with their tips at the shell") {
  record::Trajectory run = loaded_dome();
  // a shell below its boundary, as the foot of a vault is
  run.layout.actuated_boundary.row(2).array() += 200;
  const record::Frame last = run.frames.back();
  const auto arrows = force_arrows(run.layout, last, 2);
  for (std::size_t k = 0; k < arrows.size(); ++k) {
    CHECK((arrows[k].to - last.nodes.col(arrows[k].node)).norm() < 1e-9);
    CHECK(arrows[k].from.z() > arrows[k].to.z());
    for (std::size_t other = 0; other < k; ++other)
      CHECK((last.nodes.col(arrows[k].node) - last.nodes.col(arrows[other].node)).head<2>().norm() >
            0.8 * synthetic::spacing);  // no neighbours
  }
}

TEST_CASE("many loads that are much smaller than the largest are one distributed load") {
  record::Trajectory run = loaded_dome();
  record::Frame& last = run.frames.edit().back();
  CHECK(small_loads(last).cols() == 0);
  last.loads_N(2, 3) = -80;
  CHECK(small_loads(last).cols() == last.loads_N.cols() - 1);
  last.loads_N.rightCols(last.loads_N.cols() - 20).setZero();
  CHECK(small_loads(last).cols() == 0);
}

TEST_CASE("a summary knows how far the means of the bins move") {
  record::Trajectory run = synthetic::dome(3, 2);
  for (int k = 0; k < 3; ++k) {
    record::Frame& frame = run.frames.edit()[std::size_t(k)];
    frame.K_bins.resize(2, 3);
    frame.K_bins << 0.03 + 0.01 * k, 0.002, 8, 0.02 - 0.004 * k, 0.004, 9;
  }
  const RunSummary summary = summarise_run(run);
  CHECK(summary.bins_change_rad.high == Approx(0.02));
  CHECK(summary.bins_change_rad.low == Approx(-0.008));
}

TEST_CASE("a frame on another mesh does not make earlier ones forgotten") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.frames.edit()[0].cell_K[7] = 9;
  run.frames.edit()[1].cell_K.conservativeResize(5);
  const RunSummary summary = summarise_run(run);
  CHECK(summary.spread(ColourBy::K).most.maxCoeff() == 9);
  CHECK(summary.spread(ColourBy::K).most.size() == run.frames[0].cell_K.size());
}
