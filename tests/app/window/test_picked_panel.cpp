#include "app/window/shell_drawing.h"
#include "tests/app/window/edited_shell.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("of a picked node only values that are known are written") {
  EditedShell shell;
  const auto lines = known_values(shell.view(), 0, 0.25, 0.01);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == "axial force 0.25 N");
  CHECK(lines[1] == "curvature 0.0100 1/mm");
  CHECK(lines[2].starts_with("bending "));
  CHECK(lines[3].starts_with("stress "));
  // of a large shell
  CHECK(known_values(shell.view(), 0, 0.25, 2e-5)[1] == "curvature 2.00e-05 1/mm");
  // as of a frame between solved ones
  ShellView unsolved = shell.view();
  unsolved.frame.bending_mJ_per_m.resize(0);
  unsolved.frame.stress_MPa.resize(0);
  CHECK(known_values(unsolved, 0, record::unknown).empty());
}
