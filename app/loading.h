// From the command line to the runs it asks for.
#pragma once

#include <vector>

#include "app/options.h"
#include "engine/experiment/experiment.h"
#include "engine/preset/reader.h"

namespace gridshell::app {

/// The preset that the options name, with what they lay over it. Errors: bad_input.
Result<preset::Presets> load(const Options& options);

/// The cases of a preset, or the preset itself as one run without a name.
std::vector<preset::Case> runs_of(const preset::Presets& presets);

/// What would run; an error names the preset.
Result<experiment::Plan> plan_of(const preset::Preset& preset);

/// The folder of a run: that of the command, or the one of its case in it.
inline std::filesystem::path folder_of(const std::filesystem::path& folder,
                                       const std::string& name) {
  return name.empty() ? folder : folder / name;
}

/// The folder that a command writes: the one asked for, or out/<preset>.
inline std::filesystem::path output_of(const Options& options, const preset::Preset& base) {
  return options.output.empty() ? std::filesystem::path("out") / base.name : options.output;
}

}  // namespace gridshell::app
