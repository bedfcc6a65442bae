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

TEST_CASE("every press of the mouse means something") {
  CHECK(gesture_of(Button::left, Over::joint, false) == Gesture::push);
  CHECK(gesture_of(Button::left, Over::joint, true) == Gesture::pull_freely);
  CHECK(gesture_of(Button::left, Over::edge_point, false) == Gesture::drag_edge);
  CHECK(gesture_of(Button::left, Over::nothing, false) == Gesture::orbit);
  CHECK(gesture_of(Button::right, Over::joint, false) == Gesture::let_go_joint);
  CHECK(gesture_of(Button::right, Over::edge_point, false) == Gesture::pan);
}

TEST_CASE("switches switch, and back") {
  Desk desk({});
  for (const Action& action : actions()) {
    const std::string name = action.name;
    // those need a shell
    if (!action.on || name == "play" || name == "gravity" || name.starts_with("colour_")) continue;
    const bool before = action.on(desk);
    action.act(desk);
    CHECK(action.on(desk) != before);
    action.act(desk);
    CHECK(action.on(desk) == before);
  }
}
