// Plots of shells on nets show the numbers they are given.
#include <catch2/catch.hpp>
#include <cmath>

#include "render/figure/net_figure.h"
#include "render/figure/net_plots.h"
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
  for (double one : deviation_of_nodes(run)) CHECK(one == Approx(0.02));
}

TEST_CASE("K is plotted at the centroid of the cell over the half-span") {
  record::Trajectory run = one_cell();
  run.frames[0].nodes.row(0).array() += 5;
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
}

TEST_CASE("footprints are written as PNG and SVG") {
  const TemporaryFolder folder;
  const record::Trajectory run = one_cell();
  REQUIRE(write_footprints(folder.path() / "boundaries", {{&run, "a"}, {&run, "b"}}).has_value());
  CHECK(std::filesystem::file_size(folder.path() / "boundaries.png") > 1000);
  CHECK(std::filesystem::file_size(folder.path() / "boundaries.svg") > 1000);
}
