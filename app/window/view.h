// `gridshell view`, in the program that has the window.
#pragma once

#include "app/cli/commands.h"

namespace gridshell::window {

/// Shows the window, or plays recorded input without one; returns the exit code. Errors: io if no
/// window can be opened; bad_input for input that cannot be read; no_equilibrium if the shell to be
/// drawn has none.
Result<int> view(app::ViewOptions options);

}  // namespace gridshell::window
