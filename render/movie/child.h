// A program of another maker, run without a shell.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::render {

/// Runs `arguments[0]` (a path) with the rest as its arguments, no input, its output discarded, and
/// waits. Errors: Fault::io when it cannot start, fails (with the last line it wrote to stderr) or
/// is killed; Fault::cancelled when `watch` asks to stop, which ends it.
Result<void> run_child(const std::vector<std::string>& arguments, const Watch& watch);

}  // namespace gridshell::render
