// The one table of what can be done by a key, a menu or a line of a recording, and that of what the
// mouse does in the view. They bind, they fill the menus and the help sheet.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/window/input_event.h"
#include "app/window/viewer_state.h"

namespace gridshell::window {

/// A key with what is held beside it.
struct Shortcut {
  std::optional<Key> key = {};
  bool ctrl = false, shift = false;

  bool operator==(const Shortcut&) const = default;
};

/// "Ctrl+Z"; empty without a key.
std::string name_of(const Shortcut& shortcut);

struct Action {
  const char* name;   ///< as `do NAME` calls it
  const char* menu;   ///< that it stands in
  const char* label;  ///< there
  Shortcut key;
  const char* help;  ///< one sentence
  void (*act)(ViewerState&);
  bool (*on)(const ViewerState&) = nullptr;  ///< of those that switch: whether it is on
};

/// In the order of the menus.
std::span<const Action> actions();
const Action* find_action(const std::string& name);
const Action* action_of(const Shortcut& shortcut);

/// What lies under the mouse in the view.
enum class Over { nothing, joint, edge_point };

/// What a drag does.
enum class Gesture { orbit, pan, push, pull_freely, drag_edge, let_go_joint, zoom, pick };

struct MouseAction {
  Gesture gesture;
  const char* how;  ///< "left drag"
  const char* help;
  Button button;
  Over over;
  bool shift = false;
};

/// The words of the panels, a sentence each.
std::span<const std::pair<const char*, const char*>> terms();

std::span<const MouseAction> mouse_actions();
/// What a press does there.
Gesture gesture_of(Button button, Over over, bool shift);

}  // namespace gridshell::window
