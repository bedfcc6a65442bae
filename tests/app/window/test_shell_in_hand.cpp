// What a hand does to a shell, without a window and without a thread.
#include "app/window/edit_session.h"

#include <catch2/catch.hpp>
#include <thread>

#include "app/window/command.h"
#include "app/window/viewer_state.h"
#include "app/window/worker_threads.h"
#include "engine/simulate/run.h"
#include "tests/small_shell.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// A shell formed and refined.
EditSession formed(const preset::Preset& preset = small_shell()) {
  EditSession hand;
  hand.execute({Open{preset}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  hand.refine(unwatched);
  return hand;
}

int joint_of(const ShellView& sight, int i, int j) {
  for (const record::Joint& joint : sight.layout->joints)
    if (joint.i == i && joint.j == j) return joint.node;
  return -1;
}

double difference(const ShellView& a, const ShellView& b) {
  return (a.frame.nodes - b.frame.nodes).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the shell in hand is the one that a run ends in") {
  const EditSession hand = formed();
  Watch watch;
  const auto run = simulate::run(small_shell(), true, watch);
  REQUIRE(run);
  const Eigen::Matrix3Xd& nodes = run->trajectory.frames.back().nodes;
  const auto joints = Eigen::Index(hand.sight().layout->joints.size());
  CHECK((hand.sight().frame.nodes - nodes).leftCols(joints).cwiseAbs().maxCoeff() < 1e-4);
  CHECK(hand.sight().refined);
  CHECK(hand.sight().stable());
  CHECK(hand.sight().certificate.error_estimate_mm < 1e-3 * 66);
}

TEST_CASE("the symmetry of a state is told once it is refined") {
  EditSession hand = formed();
  CHECK(hand.sight().symmetry == "two diagonal mirrors");
  hand.execute({Move{0.9}, 7, true}, unwatched);
  CHECK(hand.sight().symmetry == "");
  hand.execute({RefineAfterDrag{}, 7, false}, unwatched);
  hand.refine(unwatched);
  CHECK(hand.sight().symmetry == "two diagonal mirrors");
  const int beside = joint_of(hand.sight(), -2, 0);
  const Eigen::Vector3d from = hand.sight().frame.nodes.col(beside);
  hand.execute({Push{beside, from - Eigen::Vector3d(0, 0, 5)}}, unwatched);
  hand.refine(unwatched);
  CHECK(hand.sight().symmetry == "no symmetry");
}

TEST_CASE("a drag of the boundary is coarse, then refined, and one step to undo") {
  EditSession hand = formed();
  const ShellView before = hand.sight();
  for (double progress : {0.95, 0.9, 0.85}) hand.execute({Move{progress}, 7, true}, unwatched);
  CHECK(hand.sight().meshes.size() == 1);
  CHECK_FALSE(hand.sight().refined);
  hand.execute({RefineAfterDrag{}, 7, false}, unwatched);
  hand.refine(unwatched);
  CHECK(hand.sight().refined);
  CHECK(hand.sight().progress == Approx(0.85));
  CHECK(hand.sight().frame.boundary_radius_mm == Approx(66 - 0.85 * 12));
  CHECK(hand.sight().undo_steps == 1);
  const ShellView after = hand.sight();
  hand.execute({Undo{}}, unwatched);
  CHECK(difference(hand.sight(), before) == 0);
  CHECK(hand.sight().progress == before.progress);
  hand.execute({Redo{}}, unwatched);
  CHECK(difference(hand.sight(), after) == 0);
}

TEST_CASE("a joint pushed along its normal resists, and lets go to where it was") {
  EditSession hand = formed();
  const ShellView before = hand.sight();
  const int joint = joint_of(before, 0, 0);
  const Eigen::Vector3d normal = before.normals.col(joint), from = before.frame.nodes.col(joint);
  hand.execute({Push{joint, from - 4 * normal, normal}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  REQUIRE(hand.sight().held.size() == 1);
  const HeldJoint held = hand.sight().held[0];
  CHECK(held.moved_mm.dot(normal) == Approx(-4));
  CHECK(held.force_N.dot(normal) < 0);
  hand.execute({Release{}}, unwatched);
  hand.refine(unwatched);
  CHECK(hand.sight().held.empty());
  CHECK(difference(hand.sight(), before) < 1e-4);
}

TEST_CASE("an edge point goes where it is dragged, and the radius still moves") {
  EditSession hand = formed();
  const int node = hand.sight().layout->edge_points[3];
  const Eigen::Vector3d to = hand.sight().frame.nodes.col(node) + Eigen::Vector3d(1.5, -1, 0);
  hand.execute({DragEdge{3, to}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK((hand.sight().frame.nodes.col(node) - to).norm() < 1e-9);
  hand.execute({Move{0.9}}, unwatched);
  CHECK(hand.sight().progress == Approx(0.9));
  hand.execute({Undo{}}, unwatched);
  hand.execute({Undo{}}, unwatched);
  CHECK(hand.sight().progress == Approx(1));
}

TEST_CASE("steps that are put aside into a file are undone and done again to the bit") {
  // no memory for more than the latest
  EditSession hand(0);
  hand.execute({Open{small_shell()}}, unwatched);
  hand.refine(unwatched);
  std::vector<ShellView> seen{hand.sight()};
  const auto act = [&](const Edit& edit) {
    hand.execute({edit}, unwatched);
    hand.refine(unwatched);
    REQUIRE(hand.sight().trouble == "");
    seen.push_back(hand.sight());
  };
  act(Move{0.9});
  const int joint = joint_of(hand.sight(), 0, 0);
  act(Push{joint, hand.sight().frame.nodes.col(joint) - Eigen::Vector3d(0, 0, 2)});
  act(Release{joint});
  act(Move{0.8});
  const auto stands = [&](const ShellView& then) {
    CHECK(hand.sight().frame.nodes == then.frame.nodes);
    CHECK(hand.sight().held.size() == then.held.size());
    CHECK(hand.sight().steps.size() == then.steps.size());
    CHECK(hand.sight().certificate.residual_N == then.certificate.residual_N);
  };
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = seen.size() - 1; k-- > 0;) {
      hand.execute({Undo{}}, unwatched);
      stands(seen[k]);
    }
    CHECK(hand.sight().undo_steps == 0);
    for (std::size_t k = 1; k < seen.size(); ++k) {
      hand.execute({Redo{}}, unwatched);
      stands(seen[k]);
    }
  }
}

TEST_CASE("the boundary moves in a drag while a joint is held, which stays in its place") {
  EditSession hand = formed();
  const int joint = joint_of(hand.sight(), 0, 0);
  const Eigen::Vector3d to = hand.sight().frame.nodes.col(joint) - Eigen::Vector3d(0, 0, 3);
  hand.execute({Push{joint, to}}, unwatched);
  hand.execute({Move{0.9}, 5, true}, unwatched);
  hand.execute({RefineAfterDrag{}, 5, false}, unwatched);
  hand.refine(unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().refined);
  CHECK(hand.sight().progress == Approx(0.9));
  CHECK((hand.sight().frame.nodes.col(joint) - to).norm() < 1e-6);
}

/// What a window would save.
preset::Preset saved(const ShellView& sight) {
  preset::Preset preset = sight.preset;
  preset.step = sight.steps.all();
  preset.actuation.radius_mm = sight.radius_end_mm;
  return preset;
}

TEST_CASE("a shell that was shaken is kept with its leading mesh, and a run comes to it",
          "[standard]") {
  preset::Preset shell = small_shell();
  shell.footprint.rods = 8;
  shell.footprint.radius_mm = 88;
  shell.actuation.radius_mm = 66;
  EditSession hand = formed(shell);
  const double unshaken = hand.sight().frame.energies[Term::bend];
  int elsewhere = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    hand.execute({Jitter{seed}}, unwatched);
    hand.refine(unwatched);
    REQUIRE(hand.sight().trouble == "");
    ViewerState viewer({});
    viewer.sight = std::make_shared<const ShellView>(hand.sight());
    const preset::Preset kept = viewer.preset_to_save();
    CHECK(kept.accuracy.leading_edges == 4);
    REQUIRE(check_preset(kept));
    Watch watch;
    const auto run = simulate::run(kept, false, watch);
    REQUIRE(run);
    const double energy = hand.sight().frame.energies[Term::bend];
    elsewhere += std::abs(energy - unshaken) > 1e-2 * unshaken;
    // each on the meshes that it took to meet the tolerance
    const record::Frame& ran = run->trajectory.frames.back();
    const auto joints = Eigen::Index(hand.sight().layout->joints.size());
    const double apart = (ran.nodes.leftCols(joints) - hand.sight().frame.nodes.leftCols(joints))
                             .colwise()
                             .norm()
                             .maxCoeff();
    CHECK(apart < ran.error_estimate_mm + hand.sight().certificate.error_estimate_mm);
    hand.execute({Undo{}}, unwatched);
  }
  CHECK(elsewhere > 0);
}

TEST_CASE("what a hand did is kept as steps, and a run of them ends in the same state",
          "[standard]") {
  EditSession hand = formed();
  const ShellView begun = hand.sight();
  const auto place = [&](int joint) -> Eigen::Vector3d {
    return hand.sight().frame.nodes.col(joint);
  };
  const int middle = joint_of(begun, 0, 0), aside = joint_of(begun, -2, 1);
  const Eigen::Vector3d normal = begun.normals.col(middle), from = place(middle);
  // a drag is one step where it goes straight, each of its places where it does not
  for (const double depth : {1., 2.5, 4.})
    hand.execute({Push{middle, from - depth * normal, normal}, 3, true}, unwatched);
  hand.execute({RefineAfterDrag{}, 3, false}, unwatched);
  hand.refine(unwatched);
  CHECK(hand.sight().steps.size() == 1);
  for (const double x : {0.5, 1.})
    hand.execute({Push{aside, place(aside) + Eigen::Vector3d(x, -x, 0.3 * x)}, 4, true}, unwatched);
  CHECK(hand.sight().steps.size() == 3);
  hand.execute({Move{0.9}}, unwatched);
  const int edge = begun.layout->edge_points[3];
  hand.execute({DragEdge{3, place(edge) + Eigen::Vector3d(1.5, -1, 0)}}, unwatched);
  hand.execute({Release{middle}}, unwatched);
  hand.execute({Jitter{2}}, unwatched);
  hand.refine(unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().steps.size() == 7);

  const preset::Preset preset = saved(hand.sight());
  REQUIRE(check_preset(preset));
  Watch watch;
  const auto run = simulate::run(preset, false, watch);
  REQUIRE(run);
  // a jitter may come past other states
  const record::Limit limit = run->summary.limit;
  CHECK((limit == record::Limit::none || limit == record::Limit::snap));
  const record::Frame &a = hand.sight().frame, &b = run->trajectory.frames.back();
  REQUIRE(a.nodes.cols() == b.nodes.cols());
  CHECK((a.nodes - b.nodes).cwiseAbs().maxCoeff() < 1e-9 * 66);
  CHECK(b.energies[Term::bend] == Approx(a.energies[Term::bend]).epsilon(1e-9));

  // and opened again it stands there
  const EditSession again = formed(preset);
  CHECK((again.sight().frame.nodes - a.nodes).cwiseAbs().maxCoeff() < 1e-9 * 66);
  CHECK(again.sight().steps.size() == 7);
  REQUIRE(again.sight().held.size() == 1);
  // it was taken hold of on the coarsest mesh, 0.2 mm off at most
  CHECK((again.sight().held[0].moved_mm - hand.sight().held[0].moved_mm).norm() < 0.2);
  hand.execute({Undo{}}, unwatched);
  CHECK(hand.sight().steps.size() == 6);
}

TEST_CASE("edge points dragged off the boundary are told, and put back the shell is as before") {
  EditSession hand = formed();
  const ShellView before = hand.sight();
  CHECK(before.edges_dragged.empty());
  for (const int k : {3, 5}) {
    const int node = before.layout->edge_points[std::size_t(k)];
    hand.execute({DragEdge{k, before.frame.nodes.col(node) + Eigen::Vector3d(1.5, -1, 0)}},
                 unwatched);
  }
  REQUIRE(hand.sight().edges_dragged.size() == 2);
  CHECK(hand.sight().edges_dragged[1].edge_point == 5);
  CHECK(hand.sight().edges_dragged[1].off_mm == Approx(std::hypot(1.5, 1)));
  CHECK(difference(hand.sight(), before) > 0.1);
  hand.execute({ResetEdgePoint{3}}, unwatched);
  CHECK(hand.sight().edges_dragged.size() == 1);
  hand.execute({ResetEdgePoint{}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().edges_dragged.empty());
  CHECK(difference(hand.sight(), before) < 1e-6);
  hand.execute({ResetEdgePoint{}}, unwatched);
  CHECK(hand.sight().trouble == "no such edge point was dragged");
}

TEST_CASE("a number of the rods changes the shell in hand, one of its shape forms another") {
  EditSession hand = formed();
  const double energy = hand.sight().frame.energies[Term::bend];
  preset::Preset stiffer = hand.sight().preset;
  stiffer.rod.young_GPa *= 2;
  CHECK(kind_of_change(hand.sight().preset, stiffer) == ChangeKind::rods);
  hand.execute({Change{stiffer}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().frame.energies[Term::bend] == Approx(2 * energy).epsilon(1e-3));
  preset::Preset larger = hand.sight().preset;
  larger.footprint.rods = 4;
  larger.footprint.radius_mm = 46;
  larger.actuation.radius_mm = 40;
  hand.execute({Change{larger}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().layout->rods.size() == 8);
  // undone, the first shell stands again, on the rods that it had
  hand.execute({Undo{}}, unwatched);
  hand.execute({Undo{}}, unwatched);
  CHECK(hand.sight().layout->rods.size() == 12);
  CHECK(hand.sight().frame.energies[Term::bend] == Approx(energy));
}

TEST_CASE("gravity is a number of the preset, and pulls") {
  EditSession hand = formed();
  // of all nodes, which lie evenly along the rods
  const double height = hand.sight().frame.nodes.row(2).mean();
  preset::Preset heavy = hand.sight().preset;
  heavy.rod.density_kg_m3 = 6450;
  heavy.loads.gravity_m_s2 = 9.81;
  hand.execute({Change{heavy}}, unwatched);
  REQUIRE(hand.sight().trouble == "");
  CHECK(hand.sight().frame.nodes.row(2).mean() < height);
}

TEST_CASE("a wish that cannot be met leaves the last good shell and says why") {
  EditSession hand = formed();
  const ShellView before = hand.sight();
  preset::Preset wrong = before.preset;
  wrong.footprint.radius_mm = 1;
  hand.execute({Change{wrong}}, unwatched);
  CHECK(hand.sight().trouble != "");
  CHECK(difference(hand.sight(), before) == 0);
  Push no_joint;
  no_joint.joint = -3;
  hand.execute({no_joint}, unwatched);
  CHECK(hand.sight().trouble != "");
  hand.execute({Redo{}}, unwatched);
  CHECK(hand.sight().trouble == "there is nothing to do again");
  CHECK(difference(hand.sight(), before) == 0);
}

TEST_CASE("without a shell there is nothing to do") {
  EditSession hand;
  const std::vector<Edit> edits{Move{0.5}, Push{},   Release{}, DragEdge{},
                                Rest{},    Jitter{}, Undo{},    Redo{}};
  for (const Edit& edit : edits) {
    hand.execute({edit}, unwatched);
    CHECK(hand.sight().trouble != "");
    CHECK_FALSE(hand.sight().any());
  }
}

TEST_CASE("the thread meets every wish, and the latest of a drag") {
  EngineThread engine;
  engine.post({Open{small_shell()}});
  engine.wait();
  REQUIRE(engine.sight()->any());
  CHECK(engine.sight()->refined);
  for (int k = 1; k <= 50; ++k) engine.post({Move{1 - 0.004 * k}, 3, true});
  engine.post({RefineAfterDrag{}, 3, false});
  engine.wait();
  CHECK(engine.sight()->progress == Approx(0.8));
  CHECK(engine.sight()->refined);
  CHECK(engine.sight()->undo_steps == 1);
  // fewer equilibria than wishes, or as many on a machine that is quick
  CHECK(engine.sight()->equilibria <= 60);
}

TEST_CASE("a cancel stops the thread and keeps a certified state") {
  EngineThread engine;
  engine.post({Open{small_shell()}});
  engine.wait();
  engine.post({Move{0.1}});
  engine.cancel();
  engine.wait();
  CHECK(engine.idle());
  CHECK(engine.sight()->certificate.residual_N < 1e-5);
}
