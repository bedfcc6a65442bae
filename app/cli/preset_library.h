// Where a PRESET argument leads: a file, or one of the presets that come with the program.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command_line.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// One of presets/*.toml, as text, embedded at build time.
struct EmbeddedPreset {
  std::string name;  ///< of the file, without ".toml"
  std::string text;
};

/// All of them, sorted by name.
const std::vector<EmbeddedPreset>& embedded_presets();

/// "Title (source)" of one. Errors: it does not read.
Result<std::string> title_of(const EmbeddedPreset& embedded);

/// The files that they name, as text, by name.
const std::map<std::string, std::string>& embedded_files();

/// The picture of a preset's shell, presets/pictures/cards/NAME.png; empty where there is none.
std::string_view embedded_card(const std::string& name);

/// The preset at the path `argument`, else the embedded one of that name. Errors: bad_input, with
/// every error of the preset, or the nearest name if there is none.
Result<preset::Presets> load_preset(const std::string& argument,
                                    const std::vector<preset::Override>& overrides);

/// The preset as above; for a run's folder the preset of the run, with the name of the folder.
Result<preset::Presets> load_preset_or_run(const std::string& argument);

// From the command line to the runs it asks for.

/// The preset that the options name, with what they lay over it. Errors: bad_input.
Result<preset::Presets> load(const Options& options);

/// Prints the result of default < preset < `--set` as a preset; returns the exit code.
Result<int> print_config(const preset::Presets& presets);

/// What a folder keeps as preset.toml: the program's version in a first line of comment, and
/// `toml`.
std::string saved_preset(const std::string& toml);
/// The saved preset without its line of the version; text of older versions has none.
std::string without_version(const std::string& saved);

/// The cases of a preset, or the preset itself as one run without a name.
std::vector<preset::Case> runs_of(const preset::Presets& presets);

/// What would run; an error names the preset.
Result<simulate::Plan> plan_of(const preset::Preset& preset);

/// The folder of a run: that of the command, or the one of its case in it.
inline std::filesystem::path folder_of(const std::filesystem::path& folder,
                                       const std::string& name) {
  return name.empty() ? folder : folder / name;
}

/// The folder that a command writes: the requested one, or out/<preset><suffix>.
inline std::filesystem::path output_of(const Options& options, const preset::Preset& base,
                                       const std::string& suffix = "") {
  return options.output.empty() ? std::filesystem::path("out") / (base.name + suffix)
                                : options.output;
}

}  // namespace gridshell::app
