// The work behind `design`: the ends of a shell moved, the designed shell as a run, what was moved,
// and pictures of before and after.
#pragma once

#include <filesystem>

#include "app/cli/options.h"

namespace gridshell::app {

/// Designs the shell of a preset and writes its folder. Prints what it came to; the exit code.
Result<int> produce_design(const Options& options);

/// A preset whose `[ends] table` and `[rod] table`, where it has them, stand in STEM_ends.csv and
/// STEM_rods.csv beside it. Errors: io.
Result<void> write_preset_with_tables(const preset::Preset& preset,
                                      const std::filesystem::path& file);

}  // namespace gridshell::app
