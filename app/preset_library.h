// The presets that come with the program, embedded at build time.
#pragma once

#include <string>
#include <vector>

namespace gridshell::app {

/// One of presets/*.toml, as text.
struct EmbeddedPreset {
  std::string name;  ///< of the file, without ".toml"
  std::string text;
};

/// All of them, sorted by name.
const std::vector<EmbeddedPreset>& embedded_presets();

}  // namespace gridshell::app
