// The table of actions, which keys, menus and lines of a recording call, and the table of what the
// mouse does in the view. Key bindings, menus and help sheet are made from these two tables.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/window/input_event.h"
#include "app/window/viewer_state.h"

namespace gridshell::window {

/// A key with its modifiers.
struct Shortcut {
  std::optional<Key> key = {};
  bool ctrl = false, shift = false;

  bool operator==(const Shortcut&) const = default;
};

/// "Ctrl+Z"; empty without a key.
std::string name_of(const Shortcut& shortcut);

/// What a key, a menu or a line of a recording does.
struct Action {
  const char* name;   ///< in a recording: `do NAME`
  const char* menu;   ///< the menu that has it
  const char* label;  ///< its text in the menu
  Shortcut key;
  const char* help;  ///< one sentence
  void (*act)(ViewerState&);
  bool (*on)(const ViewerState&) = nullptr;  ///< of a switch: whether it is on
  /// The reason why it has no effect now; empty: it has one. Null: it always has.
  std::string (*why_not)(const ViewerState&) = nullptr;
  bool below_line = false;  ///< a line above it begins a group of the menu

  std::string why_not_now(const ViewerState& viewer) const;
  /// Acts, or reports in the status line why it has no effect now.
  void perform(ViewerState& viewer) const;
};

/// All actions, in the order of the menus.
std::span<const Action> actions();
/// The action with this name, or with this key; null if there is none.
const Action* find_action(const std::string& name);
const Action* action_of(const Shortcut& shortcut);

/// What is under the mouse in the view.
enum class Over { nothing, joint, edge_point };

/// What a drag does.
enum class Gesture { orbit, pan, push, pull_freely, drag_edge, let_go_joint, zoom, pick };

/// A row of the table of the mouse.
struct MouseAction {
  Gesture gesture;
  const char* how;  ///< "left drag"
  const char* help;
  std::optional<Button> button;  ///< that is dragged; empty: none is
  Over over;
  bool shift = false;
};

/// The terms that the panels use, with a sentence that explains each.
std::span<const std::pair<const char*, const char*>> terms();

/// The table of the mouse.
std::span<const MouseAction> mouse_actions();
/// What a drag does that begins with this button on this object.
Gesture gesture_of(Button button, Over over, bool shift);

/// The mouse in the view of the shell: finds what is under it and moves what it drags. Positions
/// are pixels from the top left of the view.
class Picker {
 public:
  explicit Picker(ViewerState& viewer) : viewer_(viewer) {}

  void hover(double x, double y);
  void leave();
  void press(Button button, bool shift, double x, double y);
  void drag(double x, double y);
  void release(double x, double y);
  void wheel(double steps, double x, double y);

  bool dragging() const { return pressed_; }

 private:
  void find(double x, double y);
  void check_dragged();
  PointOnRod rod_at(double x, double y) const;
  int cell_at(double x, double y) const;
  bool is_covered(int node, double by_mm) const;
  Eigen::Vector2d pixel_of(int node) const;

  ViewerState& viewer_;
  int joint_ = -1, edge_ = -1;
  bool pressed_ = false, moved_ = false;
  Gesture gesture_ = Gesture::orbit;
  double begin_x_ = 0, begin_y_ = 0, last_x_ = 0, last_y_ = 0;
  Eigen::Vector2d press_offset_ =
      Eigen::Vector2d::Zero();  // press minus the joint's picture, pixels
  Eigen::Vector3d pushed_from_ = Eigen::Vector3d::Zero(), along_ = Eigen::Vector3d::UnitZ();
};

}  // namespace gridshell::window
