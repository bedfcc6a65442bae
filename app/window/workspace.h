// The workspace: camera, colours, what is shown and which panels, saved when the window closes and
// restored when it opens.
#pragma once

#include <filesystem>
#include <string>

#include "app/window/viewer_state.h"

namespace gridshell::window {

/// The workspace as JSON.
std::string workspace_text(const ViewerState& viewer);

/// Applies a workspace to the viewer; members that are missing or have a wrong type change nothing.
/// The camera is applied when a shell of the same preset is shown. Errors: bad_input if the text is
/// no JSON object.
Result<void> take_workspace(ViewerState& viewer, const std::string& text);

/// The file of the workspace: $XDG_STATE_HOME/gridshell/workspace.json, or below ~/.local/state;
/// empty if neither folder is known.
std::filesystem::path workspace_file();

}  // namespace gridshell::window
