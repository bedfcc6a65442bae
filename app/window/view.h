// `gridshell view`, as the program with the window in it does it.
#pragma once

#include "app/cli/commands.h"

namespace gridshell::window {

/// Shows the window, or plays recorded input without one; the exit code. Errors: no window can be
/// opened; input that cannot be read; what is drawn has no equilibrium.
Result<int> view(app::ViewOptions options);

}  // namespace gridshell::window
