// The interface in a window of the desktop.
#pragma once

#include <functional>

#include "app/window/desk.h"
#include "app/window/input_event.h"

namespace gridshell::ui {

/// Opens the window and stays until it is closed or `stopped`. Every event goes to `seen` as well.
/// Errors: io where there is no GLFW, no display or no OpenGL, saying what to use instead.
Result<void> run_desktop(window::Desk& desk,
                         const std::function<void(const window::InputEvent&)>& seen,
                         const std::function<bool()>& stopped);

}  // namespace gridshell::ui
