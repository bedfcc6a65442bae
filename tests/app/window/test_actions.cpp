#include "app/window/actions.h"

#include <catch2/catch.hpp>
#include <set>

using namespace gridshell;
using namespace gridshell::window;

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

TEST_CASE("the colours' range is of a state, of all states, or stays as the hand set it") {
  for (const std::string& word : all_words<RangeOf>()) CHECK(find_action("range_" + word));
  const render::ColourScale before{render::ColourMap::diverging, -2, 1},
      now{render::ColourMap::diverging, -1, 3};
  CHECK(next_scale(before, now, RangeOf::state) == now);
  const render::ColourScale all = next_scale(before, now, RangeOf::run);
  CHECK((all.low == -2 && all.high == 3));
  const render::ColourScale kept = next_scale(before, now, RangeOf::hand);
  CHECK((kept.low == -2 && kept.high == 1));
  ViewerState viewer({});
  viewer.set_range(2, 1);
  CHECK(viewer.range_of == RangeOf::state);
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
    // those need a shell
    if (!action.on || name == "play" || name == "gravity" || name.starts_with("colour_") ||
        name.starts_with("range_"))
      continue;
    const bool before = action.on(viewer);
    action.act(viewer);
    CHECK(action.on(viewer) != before);
    action.act(viewer);
    CHECK(action.on(viewer) == before);
  }
}
