// The work behind `design`: the ends of a shell moved, the designed shell as a run, what was moved,
// and pictures of before and after.
#pragma once

#include "app/options.h"

namespace gridshell::app {

/// Designs the shell of a preset and writes its folder. The exit code.
int produce_design(const Options& options);

}  // namespace gridshell::app
