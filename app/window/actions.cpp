#include "app/window/actions.h"

#include <algorithm>
#include <iterator>

namespace gridshell::window {
namespace {

/// A member of ViewerState, or of its `show`.
template <auto flag>
auto& member_of(auto& viewer) {
  if constexpr (requires { viewer.*flag; })
    return viewer.*flag;
  else
    return viewer.show.*flag;
}

/// An action that switches a flag.
template <auto flag>
constexpr Action toggle(const char* name, const char* menu, const char* label, Shortcut key,
                        const char* help, std::string (*why_not)(const ViewerState&) = nullptr) {
  constexpr auto act = [](ViewerState& viewer) { member_of<flag>(viewer) ^= true; };
  constexpr auto on = [](const ViewerState& viewer) { return member_of<flag>(viewer); };
  return {name, menu, label, key, help, act, on, why_not};
}

template <ColourBy by>
constexpr Action colour(const char* name, const char* label, Shortcut key, const char* help) {
  constexpr auto act = [](ViewerState& viewer) {
    viewer.show.colour_by = by;
    viewer.show.scale = scale_of(*viewer.shell, viewer.show);
  };
  constexpr auto on = [](const ViewerState& viewer) { return viewer.show.colour_by == by; };
  return {name, "Colour", label, key, help, act, on};
}

template <RangeOf of>
constexpr Action range(const char* name, const char* label, Shortcut key, const char* help) {
  constexpr auto act = [](ViewerState& viewer) {
    viewer.range_of = of;
    const render::ColourScale now = scale_of(*viewer.shell, viewer.show);
    viewer.show.scale = next_scale(viewer.show.scale, now, of);
  };
  constexpr auto on = [](const ViewerState& viewer) { return viewer.range_of == of; };
  return {name, "Colour", label, key, help, act, on};
}

/// An action that turns the view as a drag by so many pixels to the right and down does.
template <int right, int down>
constexpr Action turn(const char* name, const char* label, Key key, const char* help) {
  constexpr auto act = [](ViewerState& viewer) { orbit(viewer.camera, right, down); };
  return {name, "View", label, {key, false, false}, help, act};
}
template <int right, int down>
constexpr Action shift_view(const char* name, const char* label, Key key, const char* help) {
  constexpr auto act = [](ViewerState& viewer) { pan(viewer.camera, viewer.view, right, down); };
  return {name, "View", label, {key, true, false}, help, act};
}
void zoom_by(ViewerState& viewer, double steps) {
  zoom(viewer.camera, viewer.view, steps, viewer.view.width / 2, viewer.view.height / 2);
}

template <const render::ViewDirection& from>
constexpr Action look(const char* name, const char* label, Shortcut key, const char* help) {
  return {name, "View", label, key, help, [](ViewerState& viewer) { viewer.look(from); }};
}

/// Makes an action the first of a group.
constexpr Action below_line(Action action) {
  action.below_line = true;
  return action;
}

void step(ViewerState& viewer, double by) {
  viewer.play(false);
  viewer.go(std::clamp(viewer.part() + by, 0.0, 1.0), false);
}

// Why an action has no effect now.

std::string no_shell(const ViewerState& viewer) {
  return viewer.shell->any() ? "" : "there is no shell yet";
}

std::string not_on_net(const ViewerState& viewer) {
  if (!viewer.shell->any()) return no_shell(viewer);
  return viewer.shell->layout->net_nodes.cols() > 0 ? "" : "this shell was not designed on a net";
}

std::string not_compared(const ViewerState& viewer) {
  return viewer.show.other ? "" : "nothing is compared: File > Compare with…";
}

// a step that is being computed can be undone, too

std::string not_undone(const ViewerState& viewer) {
  const bool any = viewer.shell->undo_steps > 0 || !viewer.engine.idle();
  return any ? "" : "there is nothing to undo";
}

std::string not_redone(const ViewerState& viewer) {
  const bool any = viewer.shell->redo_steps > 0 || !viewer.engine.idle();
  return any ? "" : "there is nothing to do again";
}

std::string none_prescribed(const ViewerState& viewer) {
  return viewer.shell->constrained.empty() ? "no joint is prescribed" : "";
}

std::string already_stable(const ViewerState& viewer) {
  if (!viewer.shell->any()) return no_shell(viewer);
  return viewer.shell->stable() ? "the shell is stable" : "";
}

std::string no_lowest_mode(const ViewerState& viewer) {
  return viewer.animate_mode ? "" : already_stable(viewer);
}

std::string one_state(const ViewerState& viewer) {
  return viewer.shell->found
             ? ""
             : "only one state of this shell has been found so far: Jitter searches for others";
}

std::string not_designed(const ViewerState& viewer) {
  return viewer.shell->designing() ? "the shell is being designed already"
                                   : why_not_designed(*viewer.shell);
}

std::string no_design(const ViewerState& viewer) {
  return viewer.shell->design ? "" : "there is no design";
}

constexpr Shortcut none{};
constexpr Shortcut on(Key key) { return {key, false, false}; }
constexpr Shortcut ctrl(Key key) { return {key, true, false}; }
constexpr Shortcut ctrl_shift(Key key) { return {key, true, true}; }

// clang-format off
const Action table[] = {
    {"new_shell", "File", "New shell…", ctrl(Key::n),
     "a shell of your own by a form: boundary, rods, spacing, material",
     [](auto& v) { v.new_shell = true; }},
    toggle<&ViewerState::picking>("pick_preset", "File", "Pick a preset", ctrl(Key::o),
     "shows all presets to choose from"),
    {"open_file", "File", "Open a file or run…", ctrl_shift(Key::o),
     "a preset's file, or the folder of a run; either may also be dropped on the window",
     [](auto& v) { v.ask_file(FileUse::open); }},
    below_line({"compare", "File", "Compare with a run or scan…", none,
     "draws a run's last state or a scan's joints over the shell, with the distances of the joints",
     [](auto& v) { v.ask_file(FileUse::compare); }, nullptr, no_shell}),
    {"compare_now", "File", "Compare with this state", none,
     "shows this state in green over the next ones, with the distances of the joints",
     [](auto& v) { v.compare_with_this(); }, nullptr, no_shell},
    {"compare_net", "File", "Compare with the net", none,
     "shows the net that it was designed on over it, with the distances of the joints",
     [](auto& v) { v.compare_with_net(); }, nullptr, not_on_net},
    {"compare_off", "File", "Compare no more", none, "takes the other shell away",
     [](auto& v) { v.compare({}); }, nullptr, not_compared},
    below_line({"save_preset", "File", "Save preset", ctrl(Key::s),
     "saves parameters, camera and all that was done, step by step, as a preset that runs",
     [](auto& v) { v.save_preset(); }, nullptr, no_shell}),
    {"save_as", "File", "Save preset as…", ctrl_shift(Key::s), "the same, under a name of your own",
     [](auto& v) { v.ask_file(FileUse::save_preset); }, nullptr, no_shell},
    below_line({"export", "File", "Export…", ctrl(Key::e),
     "the shell for other programs and for the workshop, in the format that the ending names",
     [](auto& v) { v.ask_file(FileUse::export_shell); }, nullptr, no_shell}),
    below_line({"save_picture", "File", "Save picture", ctrl(Key::p),
     "saves the view as a PNG, of the size and quality set under Save",
     [](auto& v) { v.save_picture(); }, nullptr, no_shell}),
    {"save_picture_as", "File", "Save picture as…", ctrl_shift(Key::p),
     "the same under a name of your own, by its width in print and dots per inch",
     [](auto& v) { v.ask_file(FileUse::save_picture); }, nullptr, no_shell},
    {"save_movie", "File", "Save movie", ctrl(Key::m),
     "makes a movie of what was done, step by step, while you continue with the shell",
     [](auto& v) { v.save_movie(); }, nullptr, no_shell},
    {"save_plots", "File", "Save plots", none,
     "each plot that shows anything as PDF, SVG, PNG and CSV", [](auto& v) { v.save_plots(); }, nullptr, no_shell},
    {"stop_movie", "File", "Stop the movie", none,
     "ends the making of the movie; the frames made so far stay",
     [](auto& v) { v.movie_task.stop(); }, nullptr,
     [](auto& v) -> std::string { return v.movie_task.under_way() ? "" : "no movie is being made"; }},
    below_line({"copy_camera", "File", "Copy camera", ctrl(Key::c),
     "puts the camera on the clipboard, as keys of a preset's [movie]",
     [](auto& v) { v.copy_camera(); }, nullptr, no_shell}),
    below_line({"quit", "File", "Quit", ctrl(Key::q), "closes the window", [](auto& v) { v.over = true; }}),

    {"undo", "Edit", "Undo", ctrl(Key::z), "takes back the last step; a drag is one",
     [](auto& v) { v.send_command(Undo{}); }, nullptr, not_undone},
    {"undo_all", "Edit", "Undo everything", none, "back to the first shell; Redo does it all again",
     [](auto& v) { v.send_command(Undo{true}); }, nullptr, not_undone},
    {"redo", "Edit", "Redo", ctrl(Key::y), "does it again",
     [](auto& v) { v.send_command(Redo{}); }, nullptr, not_redone},
    below_line({"find_number", "Edit", "Find a parameter", ctrl(Key::f), "searches all parameters of the preset",
     [](auto& v) { v.numbers = v.find_number = true; }}),
    below_line({"stop", "Edit", "Stop", on(Key::escape),
     "stops the calculation; of a design the last certified step remains",
     [](auto& v) { v.stop(); }}),

    {"play", "Shell", "Play", on(Key::space), "plays the preset's path, or stops it",
     [](auto& v) { v.play(!v.playing); }, [](auto& v) { return v.playing; }, no_shell},
    {"step_on", "Shell", "Step on", on(Key::right), "forward by a fiftieth of the path",
     [](auto& v) { step(v, 0.02); }, nullptr, no_shell},
    {"step_back", "Shell", "Step back", on(Key::left), "back by a fiftieth of the path",
     [](auto& v) { step(v, -0.02); }, nullptr, no_shell},
    {"to_start", "Shell", "To the start", on(Key::home), "back to the start of the path",
     [](auto& v) { v.play(false); v.go(0, false); }, nullptr, no_shell},
    {"to_end", "Shell", "To the end", on(Key::end), "on to the end of the path",
     [](auto& v) { v.play(false); v.go(1, false); }, nullptr, no_shell},
    below_line({"release", "Shell", "Release all joints", on(Key::r), "releases all prescribed joints",
     [](auto& v) { v.send_command(Release{}); }, nullptr, none_prescribed}),
    below_line({"gravity", "Shell", "Gravity", on(Key::g), "switches the rods' own weight on and off",
     [](auto& v) { v.toggle_gravity(); }, [](auto& v) { return v.gravity(); }, no_shell}),
    {"jitter", "Shell", "Jitter", on(Key::j),
     "perturbs the shell by random forces on its joints, then finds an equilibrium",
     [](auto& v) { v.send_command(Jitter{v.shell->equilibria + 1}); }, nullptr, no_shell},
    {"rest", "Shell", "Go to equilibrium", on(Key::d), "down the energy to the lower side",
     [](auto& v) { v.send_command(Rest{BranchSide::lower}); }, nullptr, no_shell},
    {"rest_along", "Shell", "To one side", on(Key::comma),
     "from an unstable state along its lowest mode to an equilibrium",
     [](auto& v) { v.send_command(Rest{BranchSide::along}); }, nullptr, already_stable},
    {"rest_against", "Shell", "To the other side", on(Key::period),
     "from an unstable state against its lowest mode to an equilibrium",
     [](auto& v) { v.send_command(Rest{BranchSide::against}); }, nullptr, already_stable},
    below_line(toggle<&ViewerState::animate_mode>("soft_mode", "Shell", "Lowest mode", on(Key::m),
     "moves an unstable shell forward and back along its lowest mode", no_lowest_mode)),
    toggle<&ViewerState::push_freely>("push_freely", "Shell", "Push freely", on(Key::f),
     "a joint goes with the mouse in every direction instead of along its normal"),

    below_line({"state_next", "Shell", "Next state", on(Key::page_down),
     "to the next of the states that were found on this boundary",
     [](auto& v) { v.recall(v.current_state() + 1); }, nullptr, one_state}),
    {"state_before", "Shell", "State before", on(Key::page_up), "to the one before it",
     [](auto& v) { v.recall(v.current_state() < 0 ? -1 : v.current_state() - 1); }, nullptr, one_state},
    {"to_loss", "Shell", "Where stability is lost", on(Key::b),
     "moves the boundary to the next range without a stable state on its path, red on the slider",
     [](auto& v) { v.go_to_loss(); }, nullptr, no_shell},

    below_line({"design_start", "Shell", "Start the design", ctrl(Key::d),
     "moves what is ticked until the shell meets its surface, step by step, each one shown",
     [](auto& v) { v.start_design(); }, nullptr, not_designed}),
    {"design_stop", "Shell", "Stop the design", none,
     "the last certified step stays on the screen: keep it or put it back",
     [](auto& v) { v.stop(); }, nullptr,
     [](auto& v) -> std::string { return v.shell->designing() ? "" : "no design is running"; }},
    {"design_keep", "Shell", "Keep the design", none,
     "continues with the designed shell, one step that can be undone; stops the design",
     [](auto& v) { v.send_command(AcceptDesign{}); }, nullptr,
     [](auto& v) { return v.shell->design && v.shell->design->kept ? "the design is kept already" : no_design(v); }},
    {"design_put_back", "Shell", "Put back the design", none,
     "the shell as it was before the design, to the bit; stops the design",
     [](auto& v) { v.send_command(DiscardDesign{}); }, nullptr, no_design},

    look<render::view_home>("view_home", "Home", on(Key::n0), "the whole shell as movies show it"),
    look<render::view_top>("view_top", "Top", on(Key::n7), "from above"),
    look<render::view_front>("view_front", "Front", on(Key::n1), "along y"),
    look<render::view_side>("view_side", "Side", on(Key::n3), "against x"),
    look<render::view_corner>("view_iso", "Corner", on(Key::n9), "the three axes with equal scales"),
    below_line({"closer", "View", "Closer", on(Key::plus), "as a turn of the wheel",
     [](auto& v) { zoom_by(v, 1); }}),
    {"further", "View", "Further", on(Key::minus), "as a turn of the wheel back",
     [](auto& v) { zoom_by(v, -1); }},
    below_line(turn<40, 0>("turn_left", "Turn left", Key::n4, "turns the view as a drag to the right")),
    turn<-40, 0>("turn_right", "Turn right", Key::n6, "turns the view as a drag to the left"),
    turn<0, 40>("turn_up", "Turn up", Key::n8, "more from above"),
    turn<0, -40>("turn_down", "Turn down", Key::n2, "more from below"),
    shift_view<-40, 0>("move_left", "Move left", Key::left, "moves the picture"),
    shift_view<40, 0>("move_right", "Move right", Key::right, "moves the picture"),
    shift_view<0, -40>("move_up", "Move up", Key::up, "moves the picture"),
    shift_view<0, 40>("move_down", "Move down", Key::down, "moves the picture"),
    below_line({"orthographic", "View", "Parallel projection", on(Key::n5), "without perspective",
     [](auto& v) { v.camera.field_of_view_deg = v.camera.field_of_view_deg > 0 ? 0 : 20; },
     [](auto& v) { return v.camera.field_of_view_deg == 0; }}),
    {"beside", "View", "Side by side", on(Key::v),
     "the shell and what it is compared with next to one another, in the same colours",
     [](auto& v) { v.show_side_by_side(!v.show.side_by_side); }, [](auto& v) { return v.show.shells() > 1; }, not_compared},
    {"measure", "View", "Measure", on(Key::w),
     "a click on two joints gives their distance, on a third one the angle at the second",
     [](auto& v) { v.measuring = !v.measuring, v.measured.clear(); },
     [](auto& v) { return v.measuring; }, no_shell},
    below_line(toggle<&Show::joints>("joints", "View", "Joints", none, "shows the joints")),
    toggle<&Show::rings>("rings", "View", "Boundaries", none,
     "shows the original and the actuated boundary"),
    toggle<&Show::ground>("ground", "View", "Ground", none, "shows the ground"),
    toggle<&Show::net>("net", "View", "Net", on(Key::n),
     "lays the net that it was designed on over the shell", not_on_net),
    toggle<&Show::footprint>("footprint", "View", "Footprint", none,
     "lays the flat footprint over it"),
    toggle<&Show::loads>("loads", "View", "Loads", none,
     "shows the loads as arrows, all to one scale, and their sum next to that of the supports"),
    toggle<&Show::braces>("braces", "View", "Braces", none, "shows the braces of its cells as bars"),
    toggle<&Show::dark>("dark", "View", "Dark", on(Key::l), "dark instead of light"),
    below_line(toggle<&ViewerState::numbers>("numbers", "View", "Parameters", on(Key::f4),
     "every parameter of the preset")),
    toggle<&ViewerState::design_panel>("design", "View", "Design", on(Key::i),
     "what may change so that the shell meets its surface, and how far it has come"),
    {"plots", "View", "Plots", on(Key::p), "curves of what was done so far",
     [](auto& v) { (v.small_window ? v.plots_when_small : v.plots) ^= true; },
     [](auto& v) { return v.small_window ? v.plots_when_small : v.plots; }},

    colour<ColourBy::none>("colour_none", "Nothing", none, "rods and joints alone"),
    colour<ColourBy::K>("colour_K", "K□", on(Key::k), "cells by their integrated Gauss curvature"),
    colour<ColourBy::K_change>("colour_K_change", "ΔK□", none,
     "cells by its change since the shell was formed"),
    colour<ColourBy::deviation>("colour_deviation", "Deviation", none,
     "cells by their distance from the net, over ρ"),
    below_line(colour<ColourBy::energy>("colour_energy", "Bending energy", on(Key::e),
     "rods by their bending energy")),
    colour<ColourBy::axial_force>("colour_axial_force", "Axial force", on(Key::a),
     "rods by their axial force"),
    colour<ColourBy::stress>("colour_stress", "Stress", none,
     "rods by the largest stress of their fibres"),
    colour<ColourBy::utilisation>("colour_utilisation", "Utilisation", none,
     "rods by that stress over their strength"),
    colour<ColourBy::joint_angle>("colour_joint_angle", "Joint angle", none,
     "rods by the angle at their joints, where these have laws or springs"),
    colour<ColourBy::displacement>("colour_displacement", "Displacement", on(Key::u),
     "rods by how far they moved"),
    below_line(range<RangeOf::run>("range_run", "Range of all states", none,
     "the range only widens, so that states can be compared")),
    range<RangeOf::state>("range_state", "Range of this state", on(Key::h),
     "the range is that of the state that is shown"),
    range<RangeOf::hand>("range_hand", "Range of your own", none,
     "the range stays as it is; type its ends into the bar"),

    toggle<&ViewerState::help>("help", "Help", "Keys and mouse", on(Key::f1), "this sheet"),
    toggle<&ViewerState::terms>("terms", "Help", "What is this?", none,
     "the terms of the panels, a sentence each"),
    {"manual", "Help", "Manual", none, "commands, keys of presets and of this window, in the browser",
     [](auto& v) { v.show_manual(); }},
};

constexpr MouseAction mouse[] = {
    {Gesture::push, "left drag on a joint", "pushes it along its normal, and prescribes its depth",
     Button::left, Over::joint},
    {Gesture::pull_freely, "Shift + left drag on a joint", "pulls it freely in the picture's plane",
     Button::left, Over::joint, true},
    {Gesture::drag_edge, "left drag on an edge point", "moves it in its plane", Button::left,
     Over::edge_point},
    {Gesture::drag_edge, "Shift + left drag on an edge point", "the same", Button::left,
     Over::edge_point, true},
    {Gesture::let_go_joint, "right click on a joint", "releases it", Button::right, Over::joint},
    {Gesture::orbit, "left drag next to it", "turns the view", Button::left, Over::nothing},
    {Gesture::pan, "right or middle drag", "moves the view", Button::right, Over::nothing},
    {Gesture::pan, "Shift + left drag next to it", "the same", Button::left, Over::nothing, true},
    {Gesture::zoom, "wheel", "goes closer to what is under the cursor", {},
     Over::nothing},
    {Gesture::pick, "left click", "shows the figures of a joint, a rod or a cell", {},
     Over::nothing},
};
// clang-format on

constexpr std::pair<const char*, const char*> words_of_panels[] = {
    {"rod", "an elastic wire of the net; u-rods and v-rods cross"},
    {"joint", "where two rods are connected; they turn freely there"},
    {"footprint", "the flat grid of rods before it is actuated"},
    {"actuated boundary", "the curve onto which the rods' ends are moved, Rₐ of a circle"},
    {"edge point", "the end of a rod, pinned to the boundary"},
    {"leg", "the piece of a rod between its last joint and the boundary"},
    {"cell", "four joints and the rods between them"},
    {"K□",
     "integrated Gauss curvature of a cell: 2π less its four angles; red domes, blue saddles"},
    {"Δ/ρ", "distance from the net that the shell was designed on, over its radius"},
    {"stable", "every small displacement raises the energy: no negative pivot of the Hessian"},
    {"lowest mode", "the displacement along which the energy rises least, or falls"},
    {"snap", "the state was lost and the shell snapped to another one"},
    {"residual", "the largest force on an unconstrained node; of an equilibrium round-off"},
    {"error ±", "how far the joints may be off, from what finer meshes change"},
    {"edges per segment", "straight pieces between two joints that a mesh computes with"},
    {"tolerance", "the requested error, over Rₒ of a circle or ρ of a net"}};

}  // namespace

std::string Action::why_not_now(const ViewerState& viewer) const {
  return why_not ? why_not(viewer) : "";
}

void Action::perform(ViewerState& viewer) const {
  if (const std::string why = why_not_now(viewer); !why.empty()) return viewer.say(why, true);
  act(viewer);
}

std::string name_of(const Shortcut& shortcut) {
  if (!shortcut.key) return "";
  std::string name;
  if (shortcut.ctrl) name += "Ctrl+";
  if (shortcut.shift) name += "Shift+";
  return name.append(word_of(*shortcut.key));
}

std::span<const Action> actions() { return table; }

const Action* find_action(const std::string& name) {
  const auto found =
      std::ranges::find_if(table, [&](const Action& action) { return name == action.name; });
  return found == std::end(table) ? nullptr : found;
}

const Action* action_of(const Shortcut& shortcut) {
  if (!shortcut.key) return nullptr;
  const auto found = std::ranges::find(table, shortcut, &Action::key);
  return found == std::end(table) ? nullptr : found;
}

std::span<const std::pair<const char*, const char*>> terms() { return words_of_panels; }

std::span<const MouseAction> mouse_actions() { return mouse; }

Gesture gesture_of(Button button, Over over, bool shift) {
  for (const MouseAction& action : mouse)
    if (action.button == button && action.over == over && action.shift == shift)
      return action.gesture;
  return button == Button::left ? Gesture::orbit : Gesture::pan;
}

}  // namespace gridshell::window
