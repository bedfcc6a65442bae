// A shell in hand that is designed: seen step by step, stopped, kept, put back.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "app/window/worker_threads.h"
#include "tests/small_shell.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

preset::Preset small_cap() {
  preset::Preset p;
  p.name = "cap";
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = preset::Placement::on_axis;
  p.net.radius_mm = 80;
  p.net.cut_height = 0.5;
  p.actuation.start = preset::Start::net;
  return p;
}

Design wish_of(std::vector<preset::Vary> vary, int most_iterations) {
  Design wish;
  wish.inverse.vary = std::move(vary);
  wish.most_iterations = most_iterations;
  return wish;
}

void opened(EditSession& hand, const preset::Preset& preset) {
  hand.execute({Open{preset}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  hand.refine(unwatched);
}

}  // namespace

TEST_CASE("a shell in hand is designed step by step, kept, put back and done again to the bit") {
  EditSession hand;
  opened(hand, small_cap());
  const ShellView before = hand.sight();
  std::vector<ShellView> seen;
  hand.tell([&](const ShellView& sight) { seen.push_back(sight); });
  hand.execute({wish_of({preset::Vary::pins}, 6)}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  hand.refine(unwatched);
  const ShellView after = hand.sight();
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
  // what stands in hand is the last step, on the meshes of the preset
  const Eigen::Index joints = Eigen::Index(after.layout->joints.size());
  CHECK((after.frame.nodes - seen.back().frame.nodes.leftCols(after.frame.nodes.cols()))
            .leftCols(joints)
            .cwiseAbs()
            .maxCoeff() < 0.02);
  CHECK(after.refined);
  CHECK(after.stable());
  CHECK(after.preset.ends.table.size() > 0);
  CHECK(after.undo_steps == 1);
  hand.execute({AcceptDesign{}}, unwatched);
  CHECK(hand.sight().design->kept);
  CHECK(hand.sight().frame.nodes == after.frame.nodes);
  CHECK(hand.sight().undo_steps == 1);
  hand.execute({DiscardDesign{}}, unwatched);
  CHECK(hand.sight().trouble == "");
  CHECK(hand.sight().frame.nodes == before.frame.nodes);
  CHECK(hand.sight().certificate.residual_N == before.certificate.residual_N);
  CHECK(hand.sight().preset.ends.table.empty());
  CHECK_FALSE(hand.sight().design);
  CHECK(hand.sight().deviation == before.deviation);
  hand.execute({DiscardDesign{}}, unwatched);
  CHECK(hand.sight().trouble != "");
  hand.execute({Redo{}}, unwatched);
  CHECK(hand.sight().frame.nodes == after.frame.nodes);
  REQUIRE(hand.sight().design);
  hand.execute({DiscardDesign{}}, unwatched);
  CHECK(hand.sight().frame.nodes == before.frame.nodes);
}

TEST_CASE("a design that is stopped leaves the step in hand that was seen last") {
  EditSession hand;
  opened(hand, small_cap());
  Watch watch;
  ShellView last;
  int seen = 0;
  hand.tell([&](const ShellView& sight) {
    last = sight;
    if (++seen == 2) watch.cancel();
  });
  hand.execute({wish_of({preset::Vary::pins}, 25)}, watch);
  REQUIRE(hand.sight().trouble == "");
  CHECK(seen == 2);
  REQUIRE(hand.sight().design);
  CHECK(hand.sight().design->stopped);
  // to the bit but for one more correction of Newton's
  CHECK((hand.sight().frame.nodes - last.frame.nodes).cwiseAbs().maxCoeff() < 1e-6);
  // a hand that goes on has kept it
  const Eigen::Vector3d up(0, 0, 1);
  hand.execute({Push{0, hand.sight().frame.nodes.col(0) - up}}, unwatched);
  CHECK(hand.sight().design->kept);
  CHECK(why_not_designed(hand.sight()) != "");
  hand.execute({DiscardDesign{}}, unwatched);
  CHECK(hand.sight().trouble.find("undone first") != std::string::npos);
  hand.execute({Undo{}}, unwatched);
  hand.execute({DiscardDesign{}}, unwatched);
  CHECK(hand.sight().trouble == "");
}

TEST_CASE("rods that were varied have diameters of their own in sight") {
  EditSession hand;
  opened(hand, small_cap());
  CHECK(hand.sight().layout->diameters_mm.empty());
  hand.execute({wish_of({preset::Vary::diameters}, 4)}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  const record::Layout& layout = *hand.sight().layout;
  REQUIRE(layout.diameters_mm.size() == layout.rods.size());
  const DesignPoint& end = hand.sight().design->points.back();
  CHECK(end.thickest_mm > end.thinnest_mm);
  CHECK(hand.sight().preset.rod_table.size() == layout.rods.size());
}

TEST_CASE("a shell that cannot be designed says why, and stays as it is") {
  EditSession hand;
  opened(hand, small_shell());
  const ShellView before = hand.sight();
  CHECK(why_not_designed(before).find("net") != std::string::npos);
  hand.execute({wish_of({preset::Vary::pins}, 4)}, unwatched);
  CHECK(hand.sight().trouble != "");
  CHECK(hand.sight().frame.nodes == before.frame.nodes);
  CHECK(hand.sight().undo_steps == 0);
  opened(hand, small_cap());
  // pinned ends hold no direction
  hand.execute({wish_of({preset::Vary::directions}, 4)}, unwatched);
  CHECK(hand.sight().trouble.find("directions") != std::string::npos);
  CHECK_FALSE(hand.sight().design);
  CHECK(hand.sight().layout != nullptr);
}

TEST_CASE("the engine's thread shows the steps of a design and stops within one of them") {
  EngineThread engine;
  engine.post({Open{small_cap()}});
  engine.wait();
  engine.post({wish_of({preset::Vary::pins}, 100)});
  for (int k = 0; k < 3000 && !engine.sight()->designing(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  REQUIRE(engine.sight()->designing());
  const auto points = engine.sight()->design->points.size();
  CHECK(points >= 1);
  engine.cancel();
  engine.wait();
  CHECK_FALSE(engine.sight()->designing());
  CHECK(engine.sight()->refined);
}
