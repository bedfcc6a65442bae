// Effects of commands on the shell of an edit session.
#include "app/window/viewer_state.h"
#include "tests/app/window/edited_shell.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// The last frame of a run of the preset.
record::Frame end_of_run(const preset::Preset& preset) {
  REQUIRE(check_preset(preset));
  Watch watch;
  auto run = value_of(simulate::run(preset, false, watch));
  return run.trajectory.frames.back();
}

/// The largest distance between equal joints of two states, whose meshes may differ.
double apart(const EditedShell& shell, const record::Frame& other) {
  const auto joints = Eigen::Index(shell.view().layout->joints.size());
  return (other.nodes.leftCols(joints) - shell.nodes().leftCols(joints))
      .colwise()
      .norm()
      .maxCoeff();
}

}  // namespace

TEST_CASE("the edited shell is the one that a run ends in") {
  const EditedShell shell;
  CHECK(apart(shell, end_of_run(small_shell())) < 1e-4);
  CHECK(shell.view().refined);
  CHECK(shell.view().stable());
  CHECK(shell.view().certificate.error_estimate_mm < 1e-3 * 66);
}

TEST_CASE("where only finer meshes have the events of a path, the edited shell is the one of a run",
          "[standard]") {
  // a shell that snaps twice and is confirmed on 64 edges per segment; four edges have another end
  preset::Preset preset = shipped("curve_ellipse");
  preset.movie.frames = 2;
  CHECK(apart(EditedShell(preset), end_of_run(preset)) < 1e-4);
}

TEST_CASE("the symmetry of a state is reported once it is refined") {
  EditedShell shell;
  CHECK(shell.view().symmetry == "two diagonal mirrors");
  shell.drag(Move{0.9}, 7);
  CHECK(shell.view().symmetry == "");
  shell.end_drag(7);
  CHECK(shell.view().symmetry == "two diagonal mirrors");
  const int beside = shell.joint(-2, 0);
  const Eigen::Vector3d from = shell.node(beside);
  shell.act(Push{beside, from - Eigen::Vector3d(0, 0, 5)});
  shell.refine();
  CHECK(shell.view().symmetry == "no symmetry");
}

TEST_CASE("a drag of the boundary of a large shell is coarse, a small shell's is not",
          "[standard]") {
  preset::Preset large = small_shell();
  large.footprint.rods = 30;
  large.footprint.radius_mm = 306;
  large.actuation.radius_mm = 285;
  for (const preset::Preset& preset : {large, small_shell()}) {
    EditedShell shell(preset);
    shell.refine();
    const std::size_t meshes = shell.view().meshes.size();
    REQUIRE(meshes > 1);
    shell.drag(Move{0.9}, 7);
    CHECK(shell.view().meshes.size() == (preset.footprint.rods == 30 ? 1 : meshes));
  }
}

TEST_CASE("rods that a circle has no room for are offered a circle that has") {
  EditedShell shell;
  preset::Preset more = shell.view().preset;
  more.footprint.rods = 9;
  CHECK(shell.attempt(Change{more}) != "");
  REQUIRE(shell.view().offer);
  // the longest leg and the ratio of the radii remain
  const preset::Preset offer = *shell.view().offer;
  CHECK(offer.footprint.radius_mm == Approx(66 + 3 * 10));
  CHECK(offer.actuated_radius_mm() == Approx(96 * 54 / 66.0));
  shell.act(Change{offer});
  CHECK(shell.view().preset.footprint.rods == 9);
  CHECK_FALSE(shell.view().offer);
  more = offer;
  more.rod.diameter_mm = 99;
  CHECK(shell.attempt(Change{more}) != "");
  CHECK_FALSE(shell.view().offer);
}

TEST_CASE("a drag of the boundary is refined at its end, and one step to undo") {
  EditedShell shell;
  const ShellView before = shell.view();
  for (double progress : {0.95, 0.9, 0.85}) shell.drag(Move{progress}, 7);
  CHECK_FALSE(shell.view().refined);
  shell.end_drag(7);
  CHECK(shell.view().refined);
  CHECK(shell.view().progress == Approx(0.85));
  CHECK(shell.view().frame.boundary_radius_mm == Approx(66 - 0.85 * 12));
  CHECK(shell.view().undo_steps == 1);
  const ShellView after = shell.view();
  shell.act(Undo{});
  CHECK(difference(shell, before) == 0);
  CHECK(shell.view().progress == before.progress);
  shell.act(Redo{});
  CHECK(difference(shell, after) == 0);
}

TEST_CASE("a push that begins with a long path reports the equilibria on it, and is one step") {
  EditedShell shell;
  const int joint = shell.joint(0, 0);
  const Eigen::Vector3d normal = shell.view().normals.col(joint), from = shell.node(joint);
  const auto push = [&](double depth, int drag) {
    shell.drag(Push{joint, from - depth * normal, normal}, drag);
  };
  push(6, 1);
  const std::vector<PlotPoint> way = shell.view().push_path;
  REQUIRE(way.size() == 5);
  for (std::size_t k = 0; k < way.size(); ++k) {
    // on the coarse mesh of the drag the path starts from a slightly different state
    CHECK(way[k].depth_mm == Approx(double(k + 1)).margin(0.2));
    CHECK(way[k].force_N > (k == 0 ? 0 : way[k - 1].force_N));
  }
  CHECK(shell.view().steps.size() == 1);
  CHECK(shell.view().undo_steps == 1);
  CHECK(shell.view().constrained.at(0).moved_mm.norm() == Approx(6));
  // a short push in the same drag has no path to report
  push(9, 1);
  CHECK(shell.view().push_path.empty());
  CHECK(shell.view().steps.size() == 1);
}

TEST_CASE("steps that are put aside into a file are undone and done again to the bit") {
  // with 0 bytes only the latest state is in memory
  EditedShell shell(small_shell(), 0);
  std::vector<ShellView> seen{shell.view()};
  const auto act = [&](const Edit& edit) {
    shell.act(edit);
    shell.refine();
    seen.push_back(shell.view());
  };
  act(Move{0.9});
  const int joint = shell.joint(0, 0);
  act(Push{joint, shell.node(joint) - Eigen::Vector3d(0, 0, 2)});
  act(Release{joint});
  act(Move{0.8});
  const auto stands = [&](const ShellView& then) {
    CHECK(shell.nodes() == then.frame.nodes);
    CHECK(shell.view().constrained.size() == then.constrained.size());
    CHECK(shell.view().steps.size() == then.steps.size());
    CHECK(shell.view().certificate.residual_N == then.certificate.residual_N);
  };
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = seen.size() - 1; k-- > 0;) {
      shell.act(Undo{});
      stands(seen[k]);
    }
    CHECK(shell.view().undo_steps == 0);
    for (std::size_t k = 1; k < seen.size(); ++k) {
      shell.act(Redo{});
      stands(seen[k]);
    }
  }
}

TEST_CASE(
    "a shell that was perturbed is saved with its mesh, and a run converges to the same state",
    "[standard]") {
  preset::Preset preset = small_shell();
  preset.footprint.rods = 8;
  preset.footprint.radius_mm = 88;
  preset.actuation.radius_mm = 66;
  EditedShell shell(preset);
  const double unshaken = shell.bending_mJ();
  int elsewhere = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    shell.act(Jitter{seed});
    shell.refine();
    ViewerState viewer({});
    viewer.shell = std::make_shared<const ShellView>(shell.view());
    const preset::Preset kept = viewer.preset_to_save();
    const double energy = shell.bending_mJ();
    elsewhere += std::abs(energy - unshaken) > 1e-2 * unshaken;
    // each is computed on the meshes that meet the tolerance, so both errors count
    const record::Frame ran = end_of_run(kept);
    CAPTURE(seed, kept.accuracy.edges_per_segment);
    CHECK(apart(shell, ran) < ran.error_estimate_mm + shell.view().certificate.error_estimate_mm);
    shell.act(Undo{});
  }
  CHECK(elsewhere > 0);
}

TEST_CASE("what was done is kept as steps, and a run of them ends in the same state",
          "[standard]") {
  EditedShell shell;
  const ShellView begun = shell.view();
  const int middle = shell.joint(0, 0), aside = shell.joint(-2, 1);
  const Eigen::Vector3d normal = begun.normals.col(middle), from = shell.node(middle);
  // a drag is one step if it is straight, else one for each of its positions
  for (const double depth : {1., 2.5, 4.})
    shell.drag(Push{middle, from - depth * normal, normal}, 3);
  shell.end_drag(3);
  CHECK(shell.view().steps.size() == 1);
  for (const double x : {0.5, 1.})
    shell.drag(Push{aside, shell.node(aside) + Eigen::Vector3d(x, -x, 0.3 * x)}, 4);
  CHECK(shell.view().steps.size() == 3);
  shell.act(Move{0.9});
  const int edge = begun.layout->edge_points[3];
  shell.act(DragEdge{3, shell.node(edge) + Eigen::Vector3d(1.5, -1, 0)});
  shell.act(Release{middle});
  shell.refine();
  CHECK(shell.view().steps.size() == 6);

  preset::Preset preset = shell.view().preset;
  preset.step = steps_of(shell.view().steps);
  preset.actuation.radius_mm = shell.view().radius_end_mm;
  REQUIRE(check_preset(preset));
  Watch watch;
  const auto run = value_of(simulate::run(preset, false, watch));
  CHECK(run.summary.limit == record::Limit::none);
  const record::Frame &a = shell.view().frame, &b = run.trajectory.frames.back();
  REQUIRE(a.nodes.cols() == b.nodes.cols());
  CHECK((a.nodes - b.nodes).cwiseAbs().maxCoeff() < 1e-9 * 66);
  CHECK(b.energies[Term::bend] == Approx(a.energies[Term::bend]).epsilon(1e-9));

  // opened again, the preset gives the same state
  const EditedShell again(preset);
  CHECK((again.view().frame.nodes - a.nodes).cwiseAbs().maxCoeff() < 1e-9 * 66);
  CHECK(again.view().steps.size() == 6);
  REQUIRE(again.view().constrained.size() == 1);
  // its constraint was set on the coarsest mesh, at most 0.2 mm off
  CHECK((again.view().constrained[0].moved_mm - shell.view().constrained[0].moved_mm).norm() < 0.2);
  shell.act(Undo{});
  CHECK(shell.view().steps.size() == 5);
}

TEST_CASE("edge points go where they are dragged, and put back the shell is as before") {
  EditedShell shell;
  const ShellView before = shell.view();
  CHECK(before.edges_dragged.empty());
  for (const int k : {3, 5}) {
    const int node = before.layout->edge_points[std::size_t(k)];
    const Eigen::Vector3d to = before.frame.nodes.col(node) + Eigen::Vector3d(1.5, -1, 0);
    shell.act(DragEdge{k, to});
    CHECK((shell.node(node) - to).norm() < 1e-9);
  }
  REQUIRE(shell.view().edges_dragged.size() == 2);
  CHECK(shell.view().edges_dragged[1].edge_point == 5);
  CHECK(shell.view().edges_dragged[1].off_mm == Approx(std::hypot(1.5, 1)));
  CHECK(difference(shell, before) > 0.1);
  // the radius still moves
  shell.act(Move{0.9});
  CHECK(shell.view().progress == Approx(0.9));
  shell.act(Undo{});
  CHECK(shell.view().progress == Approx(1));
  shell.act(ResetEdgePoint{3});
  CHECK(shell.view().edges_dragged.size() == 1);
  shell.act(ResetEdgePoint{});
  CHECK(shell.view().edges_dragged.empty());
  CHECK(difference(shell, before) < 1e-6);
  CHECK(shell.attempt(ResetEdgePoint{}) == "no such edge point was dragged");
}

TEST_CASE(
    "a parameter of rods or loads changes the present shell, one of its shape forms another") {
  EditedShell shell;
  const double energy = shell.bending_mJ();
  preset::Preset stiffer = shell.view().preset;
  stiffer.rod.young_GPa *= 2;
  CHECK(kind_of_change(shell.view().preset, stiffer) == ChangeKind::rods);
  shell.act(Change{stiffer});
  CHECK(shell.bending_mJ() == Approx(2 * energy).epsilon(1e-3));
  // gravity lowers the nodes in the mean
  const double height = shell.nodes().row(2).mean();
  preset::Preset heavy = shell.view().preset;
  heavy.rod.density_kg_m3 = 6450;
  heavy.loads.gravity_m_s2 = 9.81;
  shell.act(Change{heavy});
  CHECK(shell.nodes().row(2).mean() < height);
  preset::Preset larger = shell.view().preset;
  larger.footprint.rods = 4;
  larger.footprint.radius_mm = 46;
  larger.actuation.radius_mm = 40;
  shell.act(Change{larger});
  CHECK(shell.view().layout->rods.size() == 8);
  // after undoing everything the first shell is shown, with its rods
  shell.act(Undo{true});
  CHECK(shell.view().layout->rods.size() == 12);
  CHECK(shell.bending_mJ() == Approx(energy));
}

TEST_CASE(
    "a path past states that are not stable marks them, and reports them though its end is "
    "stable") {
  // near the flat state the symmetric branch of the shell of Movie S1 is not stable
  preset::Preset preset = small_shell();
  preset.footprint.rods = 12;
  preset.footprint.radius_mm = 126;
  preset.actuation.radius_mm = 94.5;
  EditedShell shell(preset);
  const auto unstable = [&] {
    std::vector<PathMark> marks = shell.view().marks;
    // one of the first load steps from the flat state is not stable either
    std::erase_if(marks, [](const PathMark& mark) { return !mark.unstable || mark.to < 0.03; });
    return marks;
  };
  shell.act(Move{0.03});
  REQUIRE_FALSE(shell.view().stable());
  CHECK(shell.view().event.find("stability lost") == 0);
  REQUIRE(unstable().size() == 1);
  const PathMark there = unstable().front();
  CHECK((there.joint == -1 && there.from <= 0.03 && there.to > 0.03 && there.to < 0.9));
  // a move between states that are not stable is no loss of stability
  shell.act(Move{0.031});
  CHECK(shell.view().event.empty());
  shell.act(Move{1});
  CHECK(shell.view().stable());
  CHECK(shell.view().event.find("stable again; not stable on the path at Rₐ = ") == 0);
  REQUIRE(unstable().size() == 1);
  shell.act(Undo{});
  CHECK_FALSE(shell.view().stable());
}

TEST_CASE("a shake that comes back to the same state says so, and is no snap") {
  EditedShell shell;
  const auto joints = Eigen::Index(shell.view().layout->joints.size());
  int same = 0;
  for (int seed = 1; seed < 8; ++seed) {
    const Eigen::Matrix3Xd before = shell.nodes().leftCols(joints);
    shell.act(Jitter{seed});
    const double moved_mm = (shell.nodes().leftCols(joints) - before).colwise().norm().maxCoeff();
    const bool back = shell.view().message == "perturbed, and in the same state again";
    CHECK(back == (moved_mm < 2e-3 * shell.view().layout->length_scale_mm));
    if (back) CHECK(shell.view().event.empty());
    same += back;
    shell.refine();
  }
  CHECK(same > 0);
  CHECK(same < 7);
}

TEST_CASE("a state that was found near another one is recalled, as one step") {
  EditedShell shell;
  CHECK_FALSE(shell.view().found);
  CHECK(shell.attempt(Recall{0}).find("no other state") == 0);
  const ShellView first = shell.view();
  for (int seed = 1; seed < 12 && !shell.view().found; ++seed)
    shell.act(Jitter{seed}), shell.refine();
  REQUIRE(shell.view().found);
  REQUIRE(shell.view().found->size() == 2);
  const double other_mJ = shell.bending_mJ();
  const int undo_steps = shell.view().undo_steps;
  shell.act(Recall{0});
  shell.refine();
  CHECK(difference(shell, first) < 1e-6);
  CHECK(shell.view().undo_steps == undo_steps + 1);
  shell.act(Recall{1});
  shell.refine();
  CHECK(shell.bending_mJ() == Approx(other_mJ).epsilon(1e-9));
  CHECK(shell.view().found->size() == 2);
  shell.act(Undo{});
  CHECK(shell.bending_mJ() == Approx(first.frame.energies[Term::bend]).epsilon(1e-9));
  // a preset that cannot be opened leaves the states
  preset::Preset wrong = first.preset;
  wrong.footprint.radius_mm = 1;
  CHECK(shell.attempt(Open{wrong}) != "");
  REQUIRE(shell.view().found);
  CHECK(shell.view().found->size() == 2);
  shell.act(Recall{1});
  CHECK(shell.bending_mJ() == Approx(other_mJ).epsilon(1e-9));
}

TEST_CASE("a command that cannot be met leaves the last good shell and says why") {
  EditedShell shell;
  const ShellView before = shell.view();
  preset::Preset wrong = before.preset;
  wrong.footprint.radius_mm = 1;
  CHECK(shell.attempt(Change{wrong}) != "");
  CHECK(difference(shell, before) == 0);
  CHECK(shell.attempt(Push{-3}) == "no such joint");
  CHECK(shell.attempt(Redo{}) == "there is nothing to do again");
  CHECK(difference(shell, before) == 0);
}

TEST_CASE("without a shell there is nothing to do") {
  EditSession session;
  for (const Edit& edit : std::vector<Edit>{Move{0.5}, Push{}, Release{}, DragEdge{}, Rest{},
                                            Jitter{}, Recall{}, Undo{}, Redo{}}) {
    session.execute({edit}, unwatched);
    CHECK(session.shell().error != "");
    CHECK_FALSE(session.shell().any());
  }
}
