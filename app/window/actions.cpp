#include "app/window/actions.h"

#include <algorithm>
#include <array>

namespace gridshell::window {
namespace {

template <ColourBy by>
void colour(ViewerState& viewer) {
  viewer.show.colour_by = by;
  viewer.show.scale = scale_of(values_of(*viewer.sight, by), by);
}
template <RangeOf of>
void range(ViewerState& viewer) {
  viewer.range_of = of;
  const render::ColourScale now =
      scale_of(values_of(*viewer.sight, viewer.show.colour_by), viewer.show.colour_by);
  viewer.show.scale = next_scale(viewer.show.scale, now, of);
}
template <RangeOf of>
bool ranged(const ViewerState& viewer) {
  return viewer.range_of == of;
}
template <ColourBy by>
bool coloured(const ViewerState& viewer) {
  return viewer.show.colour_by == by;
}

template <bool Show::*flag>
void switch_shown(ViewerState& viewer) {
  viewer.show.*flag = !(viewer.show.*flag);
}
template <bool Show::*flag>
bool is_shown(const ViewerState& viewer) {
  return viewer.show.*flag;
}
template <bool ViewerState::*flag>
void switch_desk(ViewerState& viewer) {
  viewer.*flag = !(viewer.*flag);
}
template <bool ViewerState::*flag>
bool is_on(const ViewerState& viewer) {
  return viewer.*flag;
}

void step(ViewerState& viewer, double by) {
  viewer.play(false);
  viewer.go(std::clamp(viewer.part() + by, 0.0, 1.0), false);
}

constexpr Shortcut none{};
constexpr Shortcut on(Key key) { return {key, false, false}; }
constexpr Shortcut ctrl(Key key) { return {key, true, false}; }

// clang-format off
const std::array table{
    Action{"pick_preset", "File", "Pick a preset", ctrl(Key::o),
           "shows all presets to choose from", switch_desk<&ViewerState::picking>, is_on<&ViewerState::picking>},
    Action{"save_picture", "File", "Save picture", ctrl(Key::p),
           "keeps the view as a PNG, of the size and quality set under Keep", [](ViewerState& d) { d.save_picture(); }},
    Action{"save_movie", "File", "Save movie", ctrl(Key::m),
           "makes a movie of what was done, step by step, while the shell stays in hand",
           [](ViewerState& d) { d.save_movie(); }},
    Action{"stop_movie", "File", "Stop the movie", none,
           "ends the making of the movie; the frames made so far stay",
           [](ViewerState& d) { d.movie_task.stop(); }},
    Action{"copy_camera", "File", "Copy camera", ctrl(Key::c),
           "puts the camera on the clipboard, as keys of a preset's [movie]",
           [](ViewerState& d) { d.copy_camera(); }},
    Action{"save_preset", "File", "Save preset", ctrl(Key::s),
           "keeps numbers, camera and what the hand did, step by step, as a preset that runs",
           [](ViewerState& d) { d.save_preset(); }},
    Action{"quit", "File", "Quit", ctrl(Key::q), "closes the window",
           [](ViewerState& d) { d.over = true; }},

    Action{"undo", "Edit", "Undo", ctrl(Key::z), "takes back the last step; a drag is one",
           [](ViewerState& d) { d.send_command(Undo{}); }},
    Action{"undo_all", "Edit", "Undo everything", none,
           "back to the first shell; Redo does it all again",
           [](ViewerState& d) { d.send_command(Undo{true}); }},
    Action{"redo", "Edit", "Redo", ctrl(Key::y), "does it again",
           [](ViewerState& d) { d.send_command(Redo{}); }},
    Action{"stop", "Edit", "Stop", on(Key::escape),
           "stops what the engine is at; of a design the last certified step stays in hand",
           [](ViewerState& d) { d.stop(); }},

    Action{"play", "Shell", "Play", on(Key::space), "plays the preset's path, or stops it",
           [](ViewerState& d) { d.play(!d.playing); }, is_on<&ViewerState::playing>},
    Action{"step_on", "Shell", "Step on", on(Key::right), "a fiftieth of the path on",
           [](ViewerState& d) { step(d, 0.02); }},
    Action{"step_back", "Shell", "Step back", on(Key::left), "a fiftieth of the path back",
           [](ViewerState& d) { step(d, -0.02); }},
    Action{"to_start", "Shell", "To the start", on(Key::home), "back to the begin of the path",
           [](ViewerState& d) { d.play(false); d.go(0, false); }},
    Action{"to_end", "Shell", "To the end", on(Key::end), "on to the end of the path",
           [](ViewerState& d) { d.play(false); d.go(1, false); }},
    Action{"release", "Shell", "Let go of all joints", on(Key::r),
           "takes the forces off all held joints", [](ViewerState& d) { d.send_command(Release{}); }},
    Action{"gravity", "Shell", "Gravity", on(Key::g), "switches the rods' own weight on and off",
           [](ViewerState& d) { d.toggle_gravity(); }, [](const ViewerState& d) { return d.gravity(); }},
    Action{"jitter", "Shell", "Jitter", on(Key::j),
           "shakes the shell by random forces on its joints and lets it come to rest",
           [](ViewerState& d) { d.send_command(Jitter{d.sight->equilibria + 1}); }},
    Action{"rest", "Shell", "Go to rest", on(Key::d), "down the energy to the lower side",
           [](ViewerState& d) { d.send_command(Rest{BranchSide::lower}); }},
    Action{"rest_along", "Shell", "Rest on one side", on(Key::comma),
           "off an unstable state along its soft mode",
           [](ViewerState& d) { d.send_command(Rest{BranchSide::along}); }},
    Action{"rest_against", "Shell", "Rest on the other", on(Key::period),
           "off an unstable state against its soft mode",
           [](ViewerState& d) { d.send_command(Rest{BranchSide::against}); }},
    Action{"soft_mode", "Shell", "Soft mode", on(Key::m),
           "moves an unstable shell to and fro as it would leave",
           switch_desk<&ViewerState::animate_mode>, is_on<&ViewerState::animate_mode>},
    Action{"push_freely", "Shell", "Push freely", on(Key::f),
           "a joint goes with the mouse in every direction instead of along its normal",
           [](ViewerState& d) { d.push_direction = d.push_direction == PushDirection::freely ? PushDirection::normal
                                                                     : PushDirection::freely; },
           [](const ViewerState& d) { return d.push_direction == PushDirection::freely; }},

    Action{"design_start", "Shell", "Start the design", ctrl(Key::d),
           "moves what is ticked until the shell meets its surface, step by step, each one shown",
           [](ViewerState& d) { d.start_design(); }},
    Action{"design_stop", "Shell", "Stop the design", none,
           "the last certified step stays on the screen, to be kept or put back",
           [](ViewerState& d) { d.stop(); }},
    Action{"design_keep", "Shell", "Keep the design", none,
           "the designed shell is the one in hand, one step that can be undone; stops the design",
           [](ViewerState& d) { d.end_design(AcceptDesign{}); }},
    Action{"design_put_back", "Shell", "Put back the design", none,
           "the shell as it was before the design, to the bit; stops the design",
           [](ViewerState& d) { d.end_design(DiscardDesign{}); }},

    Action{"view_home", "View", "Home", on(Key::n0), "the whole shell as movies show it",
           [](ViewerState& d) { d.look(render::view_home); }},
    Action{"view_top", "View", "Top", on(Key::n7), "from above",
           [](ViewerState& d) { d.look(render::view_top); }},
    Action{"view_front", "View", "Front", on(Key::n1), "along y",
           [](ViewerState& d) { d.look(render::view_front); }},
    Action{"view_side", "View", "Side", on(Key::n3), "against x",
           [](ViewerState& d) { d.look(render::view_side); }},
    Action{"view_iso", "View", "Corner", on(Key::n9), "the three axes alike",
           [](ViewerState& d) { d.look(render::view_corner); }},
    Action{"orthographic", "View", "Orthographic", on(Key::n5), "without perspective",
           [](ViewerState& d) { d.camera.field_of_view_deg = d.camera.field_of_view_deg > 0 ? 0 : 20; },
           [](const ViewerState& d) { return d.camera.field_of_view_deg == 0; }},
    Action{"joints", "View", "Joints", none, "shows the joints", switch_shown<&Show::joints>,
           is_shown<&Show::joints>},
    Action{"rings", "View", "Boundaries", none, "shows the original and the actuated boundary",
           switch_shown<&Show::rings>, is_shown<&Show::rings>},
    Action{"ground", "View", "Ground", none, "shows the ground", switch_shown<&Show::ground>,
           is_shown<&Show::ground>},
    Action{"net", "View", "Net", on(Key::n), "lays the net that it was designed on over the shell",
           switch_shown<&Show::net>, is_shown<&Show::net>},
    Action{"footprint", "View", "Footprint", none, "lays the flat footprint over it",
           switch_shown<&Show::footprint>, is_shown<&Show::footprint>},
    Action{"dark", "View", "Dark", on(Key::l), "dark instead of light",
           switch_shown<&Show::dark>, is_shown<&Show::dark>},
    Action{"numbers", "View", "Numbers", on(Key::tab), "every number of the preset",
           switch_desk<&ViewerState::numbers>, is_on<&ViewerState::numbers>},
    Action{"design", "View", "Design", on(Key::i),
           "what may change so that the shell meets its surface, and how far it has come",
           switch_desk<&ViewerState::design_panel>, is_on<&ViewerState::design_panel>},
    Action{"plots", "View", "Plots", on(Key::p), "curves of what was done so far",
           switch_desk<&ViewerState::plots>, is_on<&ViewerState::plots>},

    Action{"colour_none", "Colour", "Nothing", none, "rods and joints alone",
           colour<ColourBy::none>, coloured<ColourBy::none>},
    Action{"colour_K", "Colour", "K□", on(Key::k), "cells by their integrated Gauss curvature",
           colour<ColourBy::K>, coloured<ColourBy::K>},
    Action{"colour_K_change", "Colour", "ΔK□", none, "cells by its change since the shell was formed",
           colour<ColourBy::K_change>, coloured<ColourBy::K_change>},
    Action{"colour_deviation", "Colour", "Deviation", none, "cells by their distance from the net, over ρ",
           colour<ColourBy::deviation>, coloured<ColourBy::deviation>},
    Action{"colour_energy", "Colour", "Bending energy", on(Key::e), "rods by their bending energy",
           colour<ColourBy::energy>, coloured<ColourBy::energy>},
    Action{"colour_axial_force", "Colour", "Axial force", on(Key::a), "rods by their axial force",
           colour<ColourBy::axial_force>, coloured<ColourBy::axial_force>},
    Action{"colour_displacement", "Colour", "Displacement", on(Key::u), "rods by how far they moved",
           colour<ColourBy::displacement>, coloured<ColourBy::displacement>},
    Action{"range_state", "Colour", "Range of this state", none,
           "the colours' range follows the state in sight", range<RangeOf::state>,
           ranged<RangeOf::state>},
    Action{"range_run", "Colour", "Range of all states", on(Key::h),
           "the range only widens, so that states can be compared", range<RangeOf::run>,
           ranged<RangeOf::run>},
    Action{"range_hand", "Colour", "Range by hand", none,
           "the range stays as it is, and its ends can be set", range<RangeOf::hand>,
           ranged<RangeOf::hand>},

    Action{"help", "Help", "Keys and mouse", on(Key::f1), "this sheet",
           switch_desk<&ViewerState::help>, is_on<&ViewerState::help>},
};

const std::array mouse{
    MouseAction{Gesture::push, "left drag on a joint",
                "pushes it along its normal, and holds it", Button::left, Over::joint},
    MouseAction{Gesture::pull_freely, "Shift + left drag on a joint",
                "pulls it freely in the picture's plane", Button::left, Over::joint, true},
    MouseAction{Gesture::drag_edge, "left drag on an edge point",
                "moves it in its plane", Button::left, Over::edge_point},
    MouseAction{Gesture::drag_edge, "Shift + left drag on an edge point",
                "the same", Button::left, Over::edge_point, true},
    MouseAction{Gesture::let_go_joint, "right click on a joint", "lets go of it", Button::right,
                Over::joint},
    MouseAction{Gesture::orbit, "left drag beside it", "turns the view", Button::left,
                Over::nothing},
    MouseAction{Gesture::pan, "right or middle drag", "moves the view", Button::right,
                Over::nothing},
    MouseAction{Gesture::pan, "Shift + left drag beside it", "the same", Button::left,
                Over::nothing, true},
    MouseAction{Gesture::zoom, "wheel", "goes closer to what is under the cursor", Button::middle,
                Over::nothing},
    MouseAction{Gesture::pick, "left click", "shows the figures of a joint, a rod or a cell", Button::left,
                Over::nothing},
};
// clang-format on

}  // namespace

std::string name_of(const Shortcut& shortcut) {
  if (!shortcut.key) return "";
  std::string name;
  if (shortcut.ctrl) name += "Ctrl+";
  if (shortcut.shift) name += "Shift+";
  return name.append(word_of(*shortcut.key));
}

std::span<const Action> actions() { return table; }

const Action* find_action(const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Action& action) { return name == action.name; });
  return found == table.end() ? nullptr : &*found;
}

const Action* action_of(const Shortcut& shortcut) {
  if (!shortcut.key) return nullptr;
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Action& action) { return action.key == shortcut; });
  return found == table.end() ? nullptr : &*found;
}

std::span<const MouseAction> mouse_actions() { return mouse; }

Gesture gesture_of(Button button, Over over, bool shift) {
  for (const MouseAction& action : mouse)
    if (action.button == button && action.over == over && action.shift == shift)
      return action.gesture;
  return button == Button::left ? Gesture::orbit : Gesture::pan;
}

}  // namespace gridshell::window
