// Where a PRESET argument leads: a file, or one of the presets that come with the program.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/preset/reader.h"

namespace gridshell::app {

/// One of presets/*.toml, as text, embedded at build time.
struct EmbeddedPreset {
  std::string name;  ///< of the file, without ".toml"
  std::string text;
};

/// All of them, sorted by name.
const std::vector<EmbeddedPreset>& embedded_presets();

/// The files that they name, as text, by name.
const std::map<std::string, std::string>& embedded_files();

/// The picture of a preset's shell, presets/pictures/cards/NAME.png; empty where there is none.
std::string_view embedded_card(const std::string& name);

/// The preset at the path `argument`, else the embedded one of that name. Errors: bad_input, with
/// every fault of the preset, or the nearest name when there is none.
Result<preset::Presets> load_preset(const std::string& argument,
                                    const std::vector<preset::Override>& overrides);

/// The same; of a run's folder the preset that it came from, named as the folder.
Result<preset::Presets> load_preset_or_run(const std::string& argument);

}  // namespace gridshell::app
