// Reads a preset: default < file < override. All faults of a file are reported at once, a line
// each:
//   file:line:column: [table] key = value: what is wrong; did you mean 'x'?
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/preset/preset.h"

namespace gridshell::preset {

/// A value from the command line, laid over the file: `--set rod.diameter_mm=0.3`.
struct Override {
  std::string source;  ///< the option, named in faults: "--set", "--frames"
  std::string key;     ///< "table.key"
  std::string value;   ///< TOML; what is not TOML is a string
};

/// One `[[case]]`: the base preset with some keys changed.
struct Case {
  std::string name;  ///< unique in the file and safe as the name of a folder
  Preset preset;     ///< its `name` is "<file>/<case>"
};

/// A preset file: what it says outside of any case, and its cases.
struct Presets {
  Preset base;
  std::vector<Case> cases;
};

/// Why a case cannot have this name, which is that of a folder among a run's files; empty when it
/// can.
std::string case_name_fault(const std::string& name);

/// "table.key=value" as given to --set. Errors: bad_input when there is no key or no '='.
Result<Override> parse_override(const std::string& argument);

/// Reads TOML text. `source` names the text in faults, `name` becomes Preset::name; files of points
/// and surfaces are looked for beside `source`, unless they are among `files` (texts by name), and
/// what is in them becomes the preset's own.
/// Errors: bad_input with every fault found.
Result<Presets> read_preset_text(const std::string& text, const std::string& source,
                                 const std::string& name,
                                 const std::vector<Override>& overrides = {},
                                 const std::map<std::string, std::string>& files = {});

/// Reads a file. Errors: bad_input, also when the file cannot be read.
Result<Presets> read_preset_file(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides = {});

}  // namespace gridshell::preset
