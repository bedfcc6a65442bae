// A program of another maker, run without a shell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::render {

/// Takes a line that a child wrote to stderr, as it comes.
using Listener = std::function<void(const std::string& line)>;

/// Runs `arguments[0]` (a path) with the rest as its arguments, no input, its output discarded, and
/// waits; `heard` is called on this thread. Errors: Fault::io when it cannot start, fails (with the
/// last line it wrote to stderr) or is killed; Fault::cancelled when `watch` asks to stop, which
/// ends it.
Result<void> run_child(const std::vector<std::string>& arguments, const Watch& watch,
                       const Listener& heard = {});

}  // namespace gridshell::render
