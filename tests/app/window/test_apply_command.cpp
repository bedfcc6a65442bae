// Commands on the shell of a window.
#include "tests/app/window/edited_shell.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("a dragged joint resists before the rods lock, and goes back with the cursor") {
  EditedShell shell;
  const int joint = shell.joint(0, 0);
  const Eigen::Vector3d normal = shell.view().normals.col(joint), from = shell.node(joint);
  const auto pull = [&](double height) {
    shell.drag(Push{joint, from + height * normal, normal}, 5);
    return (shell.node(joint) - from).dot(normal);
  };
  double most = 0;
  for (const double height : {5.0, 40.0, 60.0, 61.0}) most = std::max(most, pull(height));
  CHECK(most > 5);
  CHECK(most < 40);
  CHECK_THAT(shell.view().message, Catch::StartsWith("the joint resists"));
  CHECK(shell.view().constrained.at(0).force_N.norm() > 0);
  // it is free to go back, and the drag is one step
  CHECK(pull(3) == Approx(3).margin(1e-3));
  CHECK(shell.view().message.empty());
  shell.end_drag(5);
  CHECK(shell.view().undo_steps == 1);
}
