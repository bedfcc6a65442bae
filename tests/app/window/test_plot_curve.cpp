// Curves of the panel of plots as they are saved.
#include "app/window/plot_curve.h"

#include <catch2/catch.hpp>

#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::window;
namespace fs = std::filesystem;

namespace {

/// Three states on the mesh of a drag, a jump, and two refined ones, the last of them unstable.
Curve curve_with_jump() {
  Curve curve{"force (N)", "depth (mm)", "", {0, 1, 2, 3, 4}, {0, 5, 6, 2, 1}};
  curve.jumps = {3};
  curve.coarse = {0, 1, 2};
  curve.unstable = {4};
  curve.marks = {{1, 9, true, "not stable"}, {3, 3, false, "snapped"}, {7, 7, false, "later"}};
  return curve;
}

}  // namespace

TEST_CASE("a curve is divided at its jumps and at unknown values") {
  Curve curve = curve_with_jump();
  REQUIRE(pieces_of(curve, curve.y).size() == 2);
  curve.y[1] = NAN;
  const auto pieces = pieces_of(curve, curve.y);
  REQUIRE(pieces.size() == 3);
  CHECK((pieces[0].is_point() && pieces[0].coarse && pieces[1].is_point()));
  CHECK((pieces[2].from == 3 && pieces[2].end == 5 && !pieces[2].coarse));
}

TEST_CASE("a saved plot has the jumps, states and marks of the screen") {
  const render::Plot plot = plot_of(curve_with_jump());
  REQUIRE(plot.series.size() == 3);
  CHECK(plot.series[0].x == std::vector<double>{0, 1, 2});
  CHECK_FALSE(plot.series[0].name.empty());
  CHECK(plot.series[1].x == std::vector<double>{3, 4});
  CHECK(plot.series[2].x == std::vector<double>{4});
  CHECK(plot.series[2].line_width == 0);
  REQUIRE(plot.bands.size() == 1);
  CHECK(plot.bands[0].x == std::vector<double>{1, 4});
  REQUIRE(plot.references.size() == 1);
  CHECK(plot.references[0].at == 3);
  // on one mesh a jump interrupts the line
  Curve fine = curve_with_jump();
  fine.coarse.clear();
  const render::Plot parted = plot_of(fine);
  REQUIRE(parted.series[0].x.size() == 6);
  CHECK(std::isnan(parted.series[0].x[3]));
}

TEST_CASE("the table of a plot names lines, the mesh of a drag and unstable states") {
  CHECK(table_of(curve_with_jump()) ==
        "depth (mm),force (N),line,coarse mesh,unstable\n"
        "0,0,1,1,0\n1,5,1,1,0\n2,6,1,1,0\n3,2,2,0,0\n4,1,2,0,1\n");
}

TEST_CASE("the message of saved plots names every file") {
  const TemporaryFolder folder;
  Library library;
  library.save_to = folder / "kept";
  ViewerState viewer(std::move(library));
  viewer.save_plots();
  CHECK(viewer.message_bad);
  viewer.save_plots({curve_with_jump(), curve_with_jump()});
  CHECK_FALSE(viewer.message_bad);
  for (const char* file : {"_1.pdf", "_2.pdf"})
    CHECK(viewer.message.find(file) != std::string::npos);
  int tables = 0;
  for (const auto& file : fs::directory_iterator(folder / "kept"))
    tables += file.path().extension() == ".csv";
  CHECK(tables == 2);
}
