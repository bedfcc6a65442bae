// Reads a preset: default < file < override. All errors of a file are reported at once, one per
// line:
//   file:line:column: [table] key: got X, expected Y; did you mean 'x'?
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
  std::string source;  ///< the option, named in messages: "--set", "--frames"
  std::string key;     ///< "table.key"
  std::string value;   ///< TOML; what is not TOML is a string
};

/// One `[[case]]`: the base preset with some keys changed.
struct Case {
  std::string name;  ///< unique in the file and safe as the name of a folder
  Preset preset;     ///< its `name` is "<file>/<case>"
};

/// A preset file: the preset without its cases, and the cases.
struct Presets {
  Preset base;
  std::vector<Case> cases;
  std::vector<std::string> files =
      {};  ///< one sentence on the contents of each file that the preset names
  std::vector<std::string> notes = {};  ///< sentences on values that are probably a mistake
};

/// The error of a case's name, which becomes a folder among the files of a run; empty: it is valid.
std::string case_name_error(const std::string& name);

/// "table.key=value" as given to --set. Errors: bad_input when there is no key or no '='.
Result<Override> parse_override(const std::string& argument);

/// Reads TOML text. `source` names the text in messages, `name` becomes Preset::name; files of
/// points and surfaces are searched for in the folder of `source`, unless they are among `files`
/// (texts by name), and their contents are copied into the preset. Errors: bad_input with every
/// error found.
Result<Presets> read_preset_text(const std::string& text, const std::string& source,
                                 const std::string& name,
                                 const std::vector<Override>& overrides = {},
                                 const std::map<std::string, std::string>& files = {});

/// Reads a file. Errors: bad_input, also when the file cannot be read.
Result<Presets> read_preset_file(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides = {});

// Writes presets as text: as TOML that runs again, and as the reference of all keys.

/// Every key that has an effect in this preset, with value, unit and meaning. Reading the text
/// gives an equivalent preset.
std::string to_toml(const Preset& preset);

/// TOML of the base, then one [[case]] per case with the keys in which it differs from the base.
std::string to_toml(const Presets& presets);

/// The texts of a key in the reference.
struct KeyText {
  std::string table;  ///< empty at the top of the file
  std::string key, unit;
  std::string value;    ///< its default, as TOML
  std::string allowed;  ///< "a number >= 0"
  std::string meaning;
};

/// All keys, in the order of the reference.
std::vector<KeyText> key_texts();

/// The reference of all keys: a Markdown table of key, unit, default, allowed values and meaning
/// for each table of the file.
std::string reference_markdown();

}  // namespace gridshell::preset
