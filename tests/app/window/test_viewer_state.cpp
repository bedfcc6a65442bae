// State of the window: actions, recorded input, and the marks of a path.
#include <set>

#include "app/window/actions.h"
#include "app/window/input_event.h"
#include "app/window/viewer_state.h"
#include "engine/solve/pinned_motion.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::window;
namespace fs = std::filesystem;

TEST_CASE("no two actions share a name or a key") {
  std::set<std::string> names, keys;
  for (const Action& action : actions()) {
    CHECK(names.insert(action.name).second);
    if (action.key.key) CHECK(keys.insert(name_of(action.key)).second);
    CHECK(find_action(action.name) == &action);
    CHECK(std::string(action.help).size() > 3);
  }
  CHECK(action_of({Key::z, true, false}) == find_action("undo"));
  CHECK(action_of({Key::z, false, false}) == nullptr);
}

TEST_CASE("every colouring has an action") {
  for (const std::string& word : all_words<ColourBy>()) CHECK(find_action("colour_" + word));
}

TEST_CASE("the colours' range is of a state, of all states, or stays as it was set") {
  for (const std::string& word : all_words<RangeOf>()) CHECK(find_action("range_" + word));
  const render::ColourScale before{render::diverging, -2, 1}, now{render::diverging, -1, 3};
  CHECK(next_scale(before, now, RangeOf::state) == now);
  const render::ColourScale all = next_scale(before, now, RangeOf::run);
  CHECK((all.low == -2 && all.high == 3));
  const render::ColourScale kept = next_scale(before, now, RangeOf::hand);
  CHECK((kept.low == -2 && kept.high == 1));
  ViewerState viewer({});
  viewer.set_range(2, 1);
  CHECK(viewer.range_of == RangeOf::run);
  viewer.set_range(-0.5, 0.25);
  CHECK(viewer.range_of == RangeOf::hand);
  CHECK(viewer.show.scale.high == 0.25);
}

TEST_CASE("every press of the mouse means something") {
  CHECK(gesture_of(Button::left, Over::joint, false) == Gesture::push);
  CHECK(gesture_of(Button::left, Over::joint, true) == Gesture::pull_freely);
  CHECK(gesture_of(Button::left, Over::edge_point, false) == Gesture::drag_edge);
  CHECK(gesture_of(Button::left, Over::nothing, false) == Gesture::orbit);
  CHECK(gesture_of(Button::right, Over::joint, false) == Gesture::let_go_joint);
  CHECK(gesture_of(Button::right, Over::edge_point, false) == Gesture::pan);
}

TEST_CASE("switches switch, and back") {
  ViewerState viewer({});
  for (const Action& action : actions()) {
    const std::string name = action.name;
    // actions that need a shell, or a second one
    if (!action.on || name == "play" || name == "gravity" || name == "beside" ||
        name.starts_with("colour_") || name.starts_with("range_"))
      continue;
    const bool before = action.on(viewer);
    action.act(viewer);
    CHECK(action.on(viewer) != before);
    action.act(viewer);
    CHECK(action.on(viewer) == before);
  }
}

namespace {

/// Joints (0, 0), (1, 0) and (2, 0) on one bent rod, and (0, 1) next to it.
ShellView shell_of_four_joints() {
  auto layout = std::make_shared<record::Layout>();
  const int names[4][2] = {{0, 0}, {1, 0}, {2, 0}, {0, 1}};
  for (int k = 0; k < 4; ++k) {
    layout->joints.push_back({});
    layout->joints.back().i = names[k][0], layout->joints.back().j = names[k][1];
    layout->joints.back().node = k;
  }
  layout->rods = {{0, 1, 2}};
  ShellView shell;
  shell.layout = layout;
  shell.frame.nodes.resize(3, 4);
  shell.frame.nodes << 0, 3, 3, 0, 0, 0, 4, 2, 0, 0, 0, 0;
  return shell;
}

}  // namespace

TEST_CASE("two joints give their distance, straight and along their rod, three an angle") {
  const ShellView shell = shell_of_four_joints();
  CHECK(text_of_measure(shell, {0}).empty());
  CHECK(text_of_measure(shell, {0, 2}) == "5.00 mm, 7.00 mm along the rod");
  CHECK(text_of_measure(shell, {2, 0}) == "5.00 mm, 7.00 mm along the rod");
  CHECK(text_of_measure(shell, {0, 3}) == "2.00 mm");
  CHECK(text_of_measure(shell, {0, 1, 2}) == "90.00°");
  ViewerState viewer({});
  for (const int joint : {4, 4, 5, 6, 7}) viewer.measure(joint);
  CHECK(viewer.measured == std::vector<int>{7});
}

TEST_CASE("another run's joints are compared by their names") {
  ViewerState viewer({});
  viewer.shell = std::make_shared<ShellView>(shell_of_four_joints());
  record::Layout layout = *viewer.shell->layout;
  record::Frame frame = viewer.shell->frame;
  std::swap(layout.joints[0].node, layout.joints[3].node);
  frame.nodes.col(1).z() = 1;
  const auto compare = [&] {
    viewer.compare(
        std::make_shared<const OtherShell>(OtherShell{"other", view_of(layout, frame, frame)}));
  };
  compare();
  CHECK(viewer.difference_text() == "largest distance 2 mm at joint (0, 0), mean 1.25 mm");
  layout.joints.clear();
  compare();
  CHECK(viewer.difference_text() == "no joint has the same name in both");
}

TEST_CASE("two shells are side by side, each in half of the view") {
  ViewerState viewer({});
  auto shell = std::make_shared<ShellView>(shell_of_four_joints());
  viewer.shell = shell;
  viewer.view = {800, 600};
  find_action("beside")->perform(viewer);
  CHECK(viewer.message_bad);
  CHECK(viewer.show.shells() == 1);
  record::Frame higher = shell->frame;
  higher.nodes.row(2).array() += 1;
  viewer.compare(std::make_shared<const OtherShell>(
      OtherShell{"higher", view_of(*shell->layout, higher, higher)}));
  find_action("beside")->act(viewer);
  CHECK(viewer.show.shells() == 2);
  CHECK(viewer.view.width == 400);
  // the legend is at the right edge of the picture, which the shell leaves free
  for (const auto& node : shell->frame.nodes.colwise())
    CHECK(render::to_pixel(viewer.camera, 400, 600, node).x() < 0.83 * 400);
  // the other shell is a ghost if it is drawn over this one, but not side by side
  const auto ghosts = [&] { return drawing_of(*shell, viewer.show, 0.1).ghosts.size(); };
  CHECK(ghosts() == 0);
  find_action("beside")->act(viewer);
  CHECK(viewer.view.width == 800);
  CHECK(ghosts() == 1);
  find_action("beside")->act(viewer);
  viewer.compare({});
  CHECK(viewer.view.width == 800);
  CHECK(viewer.show.shells() == 1);
}

TEST_CASE("an action that has no effect now does nothing, and the status line says why") {
  ViewerState viewer({});
  const auto refused = [&](const char* name) {
    viewer.say("");
    find_action(name)->perform(viewer);
    CHECK(viewer.message_bad);
    CHECK(viewer.engine.idle());
    return viewer.message;
  };
  CHECK(refused("play") == "there is no shell yet");
  CHECK_FALSE(viewer.playing);
  auto shell = std::make_shared<ShellView>(shell_of_four_joints());
  viewer.shell = shell;
  CHECK(refused("rest_along") == "the shell is stable");
  CHECK(refused("undo_all") == "there is nothing to undo");
  CHECK(refused("redo") == "there is nothing to do again");
  CHECK(refused("release") == "no joint is prescribed");
  CHECK(refused("state_next").starts_with("only one state"));
  CHECK(refused("compare_net") == "this shell was not designed on a net");
  CHECK(refused("design_keep") == "there is no design");
  shell->certificate.negative_pivots = 1;
  shell->undo_steps = 1;
  for (const char* name : {"rest_along", "undo"})
    CHECK(find_action(name)->why_not_now(viewer) == "");
}

TEST_CASE("what loads a shell is drawn as arrows and its braces as bars, until switched off") {
  ShellView shell = shell_of_four_joints();
  auto layout = std::make_shared<record::Layout>(*shell.layout);
  layout->length_scale_mm = 10, layout->spacing_mm = 2;
  layout->actuated_boundary = layout->original_boundary = Eigen::Matrix3Xd::Zero(3, 2);
  layout->supports = {0, 1, 2};
  layout->cells.emplace_back().joints = {0, 1, 2, 3};
  shell.layout = layout;
  shell.frame.loads_N = Eigen::Vector3d(0, 0, -1) * Eigen::RowVector3d(1, 2, 1e-4);
  shell.frame.brace_force_N = Eigen::Vector2d(3, NAN);
  Show show;
  show.colour_by = ColourBy::none;
  show.largest_load_N = 4;
  const render::Drawing drawn = drawing_of(shell, show, 0.1);
  // the third is too small to be seen
  REQUIRE(drawn.arrows.size() == 2);
  const auto length = [&](int k) {
    return (drawn.arrows[std::size_t(k)].to - drawn.arrows[std::size_t(k)].from).norm();
  };
  CHECK(length(1) == Approx(2 * length(0)));
  REQUIRE(drawn.ghosts.size() == 1);
  CHECK(drawn.ghosts[0].rods == std::vector<std::vector<int>>{{0, 2}});
  show.loads = show.braces = false;
  CHECK(drawing_of(shell, show, 0.1).arrows.empty());
  CHECK(drawing_of(shell, show, 0.1).ghosts.empty());
}

TEST_CASE("a path that was left without a loss of stability is not searched for one") {
  ViewerState viewer({});
  auto shell = std::make_shared<ShellView>(shell_of_four_joints());
  viewer.shell = shell;
  viewer.go_to_loss();
  CHECK(viewer.message == "every state computed on the boundary's path is stable");
  shell->path_left = "jitter at R_a = 94.5 mm";
  viewer.go_to_loss();
  CHECK(viewer.message.find("left by jitter at R_a = 94.5 mm") != std::string::npos);
}

TEST_CASE("every quantity of a plot has a name and a position of its own") {
  std::set<std::string> names;
  for (const Quantity& quantity : quantities) {
    CHECK(names.insert(quantity.name).second);
    PlotPoint point;
    point.*quantity.value = 1.5;
    int set = 0;
    for (const Quantity& other : quantities) set += point.*other.value == 1.5;
    CHECK(set == 1);
  }
}

TEST_CASE("an event reads back as it was written") {
  for (const char* line :
       {"size 1280 720 1.5", "mouse 12.5 300", "mouse @R_a 0.25 0.5", "mouse @joint:3,-4 0 -20",
        "press left", "release middle", "wheel -2", "down Ctrl", "up F1", "type R a", "type Space",
        "do undo", "open s1_actuation", "wait 0.25"}) {
    const auto event = value_of(read_event(line));
    CHECK(write_event(event) == line);
  }
}

TEST_CASE("a line that is no event is refused with what would be right") {
  for (const char* line : {"", "click 1 2", "mouse 1", "mouse nan 2", "press", "press thumb",
                           "down Hyper", "size 10 10 1", "wait 1e9", "wait -1", "press left now"})
    CHECK_FALSE(read_event(line));
  CHECK(read_event("press thumb").error().message.find("left") != std::string::npos);
}

TEST_CASE("a recording's error names its line") {
  const auto events = read_events("# a comment\n\nmouse 1 2\r\nmouse one two\n", "visit.txt");
  REQUIRE_FALSE(events);
  CHECK(events.error().message.find("visit.txt:4:") == 0);
  CHECK(read_events("# nothing\n", "visit.txt")->empty());
  const auto beside =
      value_of(read_events("size 640 480 1   # pixels\n  type a # b\n", "visit.txt"));
  REQUIRE(beside.size() == 2);
  CHECK(beside[1].text == "a # b");
}

namespace {

/// A path of load steps at these parameters, with these numbers of negative pivots.
PathRecord path_of(const std::vector<std::pair<double, int>>& steps) {
  PathRecord path;
  for (const auto& [t, pivots] : steps) {
    LoadStep step;
    step.point.t = t;
    step.certificate.negative_pivots = pivots;
    path.load_steps.push_back(std::move(step));
  }
  return path;
}

}  // namespace

TEST_CASE(
    "a stretch that is not stable reaches as far as states are known not to be, or to its event") {
  const PathRecord path = path_of({{0.2, 0}, {0.4, 1}, {0.6, 2}, {0.8, 0}});
  const auto marks = marks_of(path, {}, -1, progress_at);
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].unstable);
  CHECK(marks[0].from == Approx(0.4 * 0.4));
  CHECK(marks[0].to == Approx(0.6 * 0.6));
  Event lost;
  lost.t = 0.35;
  const auto reported = marks_of(path, {lost}, -1, progress_at);
  REQUIRE(reported.size() == 2);
  CHECK(reported[0].from == Approx(0.35 * 0.35));
  CHECK((!reported[1].unstable && reported[1].from == reported[1].to &&
         reported[1].what == "stability lost"));
}

TEST_CASE("ranges of several paths that meet are one, separate ones or of other joints are not") {
  std::vector<PathMark> marks{{0.1, 0.2, -1, true, "not stable"}};
  add_marks(marks, {{0.2, 0.4, -1, true, "not stable"},
                    {0.6, 0.7, -1, true, "not stable"},
                    {0.3, 0.5, 7, true, "not stable"}});
  REQUIRE(marks.size() == 3);
  CHECK((marks[0].from == 0.1 && marks[0].to == 0.4));
  CHECK(text_of_range(marks[0], [](double at) { return 100 * at; }) == "40 to 10");
  // a path back is no other interval
  add_marks(marks, marks_of(path_of({{0.7, 1}, {0.65, 1}}), {}, -1, [](double t) { return t; }));
  CHECK(marks.size() == 3);
}

TEST_CASE("laths are drawn as laths, and a line that the preset does not show is not drawn") {
  ShellView shell = shell_of_four_joints();
  auto layout = std::make_shared<record::Layout>(*shell.layout);
  layout->laths_mm = {6, 2};
  layout->original_boundary = Eigen::Matrix3Xd::Zero(3, 2);
  layout->actuated_boundary = Eigen::Matrix3Xd::Ones(3, 2);
  shell.layout = layout;
  Show show;
  show.colour_by = ColourBy::none;
  const render::Drawing drawn = drawing_of(shell, show, 0.1);
  CHECK(drawn.laths_mm == layout->laths_mm);
  CHECK(drawn.joint_diameter_mm == 3);
  CHECK(drawn.rings.size() == 2);
  shell.preset.style.rings = preset::Visibility::off;
  CHECK(drawing_of(shell, show, 0.1).rings.empty());
}
