// How somebody likes the window: camera, colours, what is shown and which panels, from one visit to
// the next.
#pragma once

#include <filesystem>
#include <string>

#include "app/window/desk.h"

namespace gridshell::window {

/// As JSON.
std::string workspace_text(const Desk& desk);

/// Lays what such a text says over the desk; what it does not say, or says wrongly, stays as it is.
/// The camera is taken once the shell of the same preset comes. Errors: bad_input for what is no
/// JSON object.
Result<void> take_workspace(Desk& desk, const std::string& text);

/// Where the window keeps it: $XDG_STATE_HOME/gridshell/workspace.json, or below ~/.local/state;
/// empty where neither is known.
std::filesystem::path workspace_file();

}  // namespace gridshell::window
