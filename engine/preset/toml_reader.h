// Reads TOML into presets: single values, the axes of a sweep, complete files, options.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/preset/field_table.h"
#include "engine/preset/preset.h"
#include "engine/preset/preset_builder.h"
#include "engine/preset/preset_file.h"

namespace gridshell::preset {

/// Assigns `value` to the member of `preset` that `field` names; in a list of tables to that of
/// item `item` (below 0: the last item). Returns an empty text, or the error and the allowed
/// values, with `preset` unchanged. A file that `value` names is searched for as `context` says;
/// `report` receives a sentence on its contents.
std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const FileContext& context, int item = -1, FileReport* report = nullptr);

/// Sets the options by which the file of a key, "[footprint] file", is read to their defaults: its
/// contents are in the preset, in mm and joined, and the options must not be applied again when the
/// preset is written and read.
void forget_file_options(const std::string& key, Preset& preset);

/// The value as a message shows it: TOML on one line, shortened if long.
std::string toml_text(const toml::node& value);

/// Whether a table of that name is a list of tables.
bool is_list_name(const std::string& name);

// Reads the axes of a sweep: `[sweep.over]` with keys in dotted form.
//   rod.diameter_mm = [0.2, 0.3]
//   actuation.radius_mm = { from = 90, to = 110, count = 5 }

/// An error in the axes of a sweep, and its position.
struct AxisError {
  toml::source_region location;
  std::string text;  ///< "[sweep.over] rod.diameter_mm: got "x" (a string), expected a number > 0"
};

/// Applies TOML to presets and collects the errors.
class TomlReader {
 public:
  /// `source` names the text in messages.
  TomlReader(std::string source, FileContext context)
      : source_(std::move(source)), context_(std::move(context)) {}

  /// Applies the keys of a file (`apart` = "case"), or of one of its cases (`apart` = "name"), to a
  /// builder. The key `apart` itself is skipped: the caller reads it.
  void apply(const toml::table& root, const std::string& apart, PresetBuilder& builder);
  /// Applies one value of the command line to a builder.
  void apply_override(const Override& change, PresetBuilder& builder);
  /// Reads the files that a builder's keys name. Call it last: other keys decide how they are read.
  void read_files(PresetBuilder& builder);

  const std::string& source() const { return source_; }
  SourceLocation location_of(const toml::source_region& region) const;
  LocatedErrors& errors() { return errors_; }

 private:
  void read_items(const std::string& name, const toml::key& key, const toml::node& value,
                  PresetBuilder& builder);
  void override_item(const std::string& list, const Override& change, PresetBuilder& builder);
  void read_table(const toml::key& key, const toml::node& value, PresetBuilder& builder);
  void assign_key(const std::string& table, const toml::key& key, const toml::node& value,
                  PresetBuilder& builder, int item = -1);

  void read_sweep_axes(const toml::table& over, PresetBuilder& builder);
  FileContext context()
      const;  // where the files of the part that is being applied are searched for

  std::string source_;
  FileContext context_;                  // where the file's preset searches for files
  std::string override_;                 // the option whose value is being applied; else empty
  ValueLayer layer_ = ValueLayer::file;  // layer of the part of the file that is being applied
  LocatedErrors errors_;
};

}  // namespace gridshell::preset
