// Design of a shell in the window: shown step by step, stopped, accepted, discarded.
#include <chrono>
#include <thread>

#include "app/window/worker_threads.h"
#include "tests/app/window/edited_shell.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

preset::Preset small_cap() {
  preset::Preset p = cap(0.5);
  p.name = "cap";
  p.net.radius_mm = 80;
  return p;
}

Design design_of(std::vector<preset::Vary> vary, int most_iterations) {
  Design command;
  command.inverse.vary = std::move(vary);
  command.most_iterations = most_iterations;
  return command;
}

}  // namespace

TEST_CASE("a shell is designed step by step, kept, put back and done again to the bit") {
  EditedShell shell(small_cap());
  const ShellView before = shell.view();
  std::vector<ShellView> seen;
  shell.session.set_listener([&](const ShellView& view) { seen.push_back(view); });
  shell.act(design_of({preset::Vary::pins}, 6));
  shell.refine();
  const ShellView after = shell.view();
  REQUIRE(after.design);
  CHECK_FALSE(after.designing());
  CHECK(after.design->points.size() == seen.size());
  REQUIRE(seen.size() >= 3);
  for (const ShellView& one : seen) {
    CHECK(one.designing());
    CHECK(one.stable());
    CHECK(one.deviation.size() == Eigen::Index(one.layout->cells.size()));
  }
  CHECK(after.design->points.back().max_mm < 0.7 * after.design->points.front().max_mm);
  CHECK(after.deviation.maxCoeff() < before.deviation.maxCoeff());
  // the edited shell is the last step, on the meshes of the preset
  const Eigen::Index joints = Eigen::Index(after.layout->joints.size());
  CHECK((after.frame.nodes - seen.back().frame.nodes.leftCols(after.frame.nodes.cols()))
            .leftCols(joints)
            .cwiseAbs()
            .maxCoeff() < 0.02);
  CHECK(after.refined);
  CHECK(after.stable());
  CHECK(after.preset.ends.table.size() > 0);
  CHECK(after.undo_steps == 1);
  shell.act(AcceptDesign{});
  CHECK(shell.view().design->kept);
  CHECK(shell.nodes() == after.frame.nodes);
  CHECK(shell.view().undo_steps == 1);
  shell.act(DiscardDesign{});
  CHECK(shell.nodes() == before.frame.nodes);
  CHECK(shell.view().certificate.residual_N == before.certificate.residual_N);
  CHECK(shell.view().preset.ends.table.empty());
  CHECK_FALSE(shell.view().design);
  CHECK(shell.view().deviation == before.deviation);
  CHECK(shell.attempt(DiscardDesign{}) != "");
  shell.act(Redo{});
  CHECK(shell.nodes() == after.frame.nodes);
  REQUIRE(shell.view().design);
  shell.act(DiscardDesign{});
  CHECK(shell.nodes() == before.frame.nodes);
}

TEST_CASE("a design that is stopped leaves the step in the window that was seen last") {
  EditedShell shell(small_cap());
  Watch watch;
  ShellView last;
  int seen = 0;
  shell.session.set_listener([&](const ShellView& view) {
    last = view;
    if (++seen == 2) watch.cancel();
  });
  shell.session.execute({design_of({preset::Vary::pins}, 25)}, watch);
  CHECK(shell.view().error == "");
  CHECK(seen == 2);
  REQUIRE(shell.view().design);
  CHECK(shell.view().design->stopped);
  // the states are equal, except for one more correction of Newton's method
  CHECK((shell.nodes() - last.frame.nodes).cwiseAbs().maxCoeff() < 1e-6);
  // another command accepts the design
  const Eigen::Vector3d up(0, 0, 1);
  shell.attempt(Push{0, shell.node(0) - up});
  CHECK(shell.view().design->kept);
  CHECK(why_not_designed(shell.view()) != "");
  CHECK(shell.attempt(DiscardDesign{}).find("undone first") != std::string::npos);
  shell.act(Undo{});
  shell.act(DiscardDesign{});
}

TEST_CASE("rods that were varied have diameters of their own in sight") {
  EditedShell shell(small_cap());
  CHECK(shell.view().layout->diameters_mm.empty());
  shell.act(design_of({preset::Vary::diameters}, 4));
  const record::Layout& layout = *shell.view().layout;
  REQUIRE(layout.diameters_mm.size() == layout.rods.size());
  const DesignPoint& end = shell.view().design->points.back();
  CHECK(end.thickest_mm > end.thinnest_mm);
  CHECK(shell.view().preset.rod_table.size() == layout.rods.size());
}

TEST_CASE("a shell that cannot be designed says why, and stays as it is") {
  EditedShell shell(small_shell());
  const ShellView before = shell.view();
  CHECK(why_not_designed(before).find("net") != std::string::npos);
  CHECK(shell.attempt(design_of({preset::Vary::pins}, 4)) != "");
  CHECK(shell.nodes() == before.frame.nodes);
  CHECK(shell.view().undo_steps == 0);
  shell.act(Open{small_cap()});
  shell.refine();
  // pinned ends have no prescribed direction
  CHECK_THAT(shell.attempt(design_of({preset::Vary::directions}, 4)),
             Catch::Contains("directions"));
  CHECK_FALSE(shell.view().design);
  CHECK(shell.view().layout != nullptr);
}

TEST_CASE("the engine's thread shows the steps of a design and stops it") {
  EngineThread engine;
  engine.post({Open{small_cap()}});
  engine.wait();
  engine.post({design_of({preset::Vary::pins}, 100)});
  for (int k = 0; k < 3000 && !engine.shell()->designing(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  REQUIRE(engine.shell()->designing());
  const auto points = engine.shell()->design->points.size();
  CHECK(points >= 1);
  engine.cancel();
  engine.wait();
  CHECK_FALSE(engine.shell()->designing());
  CHECK(engine.shell()->refined);
}
