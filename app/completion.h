// Completion of command lines in bash.
#pragma once

#include <string>

namespace gridshell::app {

/// A script for bash: commands, options and their words, names of presets, keys after --set; files
/// and folders elsewhere.
std::string bash_completion();

}  // namespace gridshell::app
