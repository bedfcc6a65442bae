// Keys of the rods that are changed in the window.
#include "tests/app/window/edited_shell.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("rods that are changed have their diameter in pictures, and their interpenetrations") {
  EditedShell shell;
  REQUIRE(shell.view().layout->rod_diameter_mm == 0.254);
  REQUIRE(shell.view().frame.contacts == 0);
  const ShellView before = shell.view();
  preset::Preset thick = before.preset;
  thick.rod.diameter_mm = 0.5;
  thick.joints.diameter_mm = 25;  // wider than the spacing
  shell.act(Change{thick});
  shell.refine();
  CHECK(shell.view().layout->rod_diameter_mm == 0.5);
  CHECK(shell.view().layout->joint_diameter_mm == 25);
  // as the same preset that is opened
  const EditedShell opened(thick);
  CHECK(opened.view().frame.contacts > 0);
  CHECK(shell.view().frame.contacts == opened.view().frame.contacts);
  // the boundary is where it was, and continues from there
  CHECK(shell.view().radius_end_mm == before.radius_end_mm);
  shell.act(Move{0.9});
  CHECK(shell.view().frame.boundary_radius_mm == Approx(66 - 0.9 * 12));
  shell.act(Undo{true});
  CHECK(difference(shell, before) == 0);
  CHECK(shell.view().layout->rod_diameter_mm == 0.254);
}

TEST_CASE("rods that would be past a limit are refused, as a drag of a slider too") {
  EditedShell shell;
  preset::Preset thick = shell.view().preset;
  thick.rod.diameter_mm = 3;
  const ShellView before = shell.view();
  CHECK_THAT(shell.attempt(Change{thick}), Catch::Contains("past a limit in this state"));
  CHECK(difference(shell, before) == 0);
  preset::Preset thicker = before.preset;
  thicker.rod.diameter_mm = 0.3;
  shell.drag(Change{thicker}, 5);
  shell.session.execute({Change{thick}, 5, true}, unwatched);
  CHECK_THAT(shell.view().error, Catch::Contains("past a limit in this state"));
  CHECK(shell.view().layout->rod_diameter_mm == 0.3);
  shell.act(Undo{});
  CHECK(difference(shell, before) == 0);
  // a limit of the bending strain, which thicker rods reach
  preset::Preset limited = small_shell();
  limited.limits.max_bending_strain = 0.004;
  EditedShell bent(limited);
  limited = bent.view().preset;
  limited.rod.diameter_mm = 0.6;
  CHECK_THAT(bent.attempt(Change{limited}), Catch::Contains("max_bending_strain = 0.004"));
}
