// Finds the preset that a PRESET argument names: a file, or one that comes with the program.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command_line.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// The text of one of presets/*.toml, embedded at build time.
struct EmbeddedPreset {
  std::string name;  ///< of the file, without ".toml"
  std::string text;
};

/// All embedded presets, sorted by name.
const std::vector<EmbeddedPreset>& embedded_presets();

/// "Title (source)" of an embedded preset. Errors: bad_input if it cannot be read.
Result<std::string> title_of(const EmbeddedPreset& embedded);

/// The text of the files that embedded presets name, by their names.
const std::map<std::string, std::string>& embedded_files();

/// The picture of an embedded preset, presets/pictures/cards/NAME.png; empty if it has none.
std::string_view embedded_card(const std::string& name);

/// The preset in the file `argument`, from standard input if that is "-", else the embedded preset
/// of that name. Errors: bad_input, with every error of the preset, or with the nearest name if
/// there is no such preset.
Result<preset::Presets> load_preset(const std::string& argument,
                                    const std::vector<preset::Override>& overrides);

/// Like load_preset(); for the folder of a run the preset of the run, with the name of the folder.
Result<preset::Presets> load_preset_or_run(const std::string& argument);

// The runs that a command line requests.

/// The preset that the options name, with the changes that they make. Errors: bad_input.
Result<preset::Presets> load(const Options& options);

/// Prints a preset with its defaults and the changes of `--set`; returns the exit code.
Result<int> print_config(const preset::Presets& presets);

/// The text of preset.toml in a run's folder: a comment with the program's version, then `toml`.
std::string saved_preset(const std::string& toml);
/// The saved preset without the comment with the version; older versions did not write one.
std::string without_version(const std::string& saved);

/// The cases of a preset, or the preset itself as one run without a name.
std::vector<preset::Case> runs_of(const preset::Presets& presets);

/// The result, with the name of the preset before the message of an error.
template <class T>
Result<T> with_name_of(const preset::Preset& preset, Result<T> result) {
  return std::move(result).map_error([&](Error error) {
    error.message = preset.name + ": " + error.message;
    return error;
  });
}

/// simulate::plan(), with the name of the preset in errors.
Result<simulate::Plan> plan_of(const preset::Preset& preset);

/// The folder of a run: `folder`, or in it that of the case `name` if there are cases.
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
