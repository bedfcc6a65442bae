// PresetBuilder: a preset while it is read, with the source of each value; and the errors of its
// file.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Layer that a value comes from; a later layer overrides the earlier ones.
enum class ValueLayer { file, one_case, command_line };

/// Source of a value: a position in a file, or an option of the command line.
struct SourceLocation {
  std::string source;
  unsigned line = 0, column = 0;
  ValueLayer layer = ValueLayer::file;

  std::string text() const;
};

/// All errors of a file, with their positions.
class LocatedErrors {
 public:
  void add(const SourceLocation& location, std::string text) {
    errors_.push_back({location, std::move(text)});
  }
  bool empty() const { return errors_.empty(); }

  /// All errors, one per line in the order of the file, each once; those of the command line last.
  std::string report() const;

 private:
  struct LocatedError {
    SourceLocation location;
    std::string text;
  };
  std::vector<LocatedError> errors_;
};

/// Where the files that a preset names are searched for: in a folder, or among texts in the
/// program.
struct FileContext {
  std::filesystem::path folder;
  const std::map<std::string, std::string>* built_in = nullptr;  ///< texts by name
  /// Surfaces that were read, by file and unit (mm), for the cases of a preset.
  using Surfaces = std::map<std::pair<std::string, double>, SurfaceData>;
  std::shared_ptr<Surfaces> surfaces = std::make_shared<Surfaces>();
};

/// A file that a key names. It is read after all other keys, since some of them (unit, spacing)
/// decide how.
struct NamedFile {
  std::string table, key;
  int item = -1;  ///< index in a list of tables; -1: no list
  std::string name;
  FileContext context;
};

/// A preset that is being read, and the source of each of its keys.
struct PresetBuilder {
  Preset preset;
  Preset given;  ///< only `rod` and `rod_v`, without the values that their materials give
  /// Sets the rod's values of the table ("rod" or "rod_v") to those of its material, except for
  /// those that the layer of the material or a later one sets; to those of `given` without one.
  void take_material(const std::string& table);

  std::map<std::string, SourceLocation> set_at;  ///< source of each key, by key_label()
  std::set<std::string> faulty;                  ///< keys whose value was refused
  std::map<std::string, NamedFile> files;        ///< files that keys name, by key_label()
  /// Sentences on the contents of the files that were read, and on what is probably a mistake.
  std::vector<std::string> read, notes;

  /// Empties a list of tables and removes its keys from set_at, faulty and files.
  void forget_items(const std::string& table);
};

/// Adds an error for each pair of values that contradict each other. Its position is that of the
/// first key that was set; if none was, it is `source` without a line.
void check_conflicts(const PresetBuilder& builder, const std::string& source,
                     LocatedErrors& errors);

/// Adds errors for keys that are set and have no effect: those of a case in its own run, those of
/// the file in all `runs`.
void check_unused_keys(const std::vector<PresetBuilder>& runs, LocatedErrors& errors);

}  // namespace gridshell::preset
