// Where the values of a preset came from, and what is wrong with them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// What is laid over what.
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

  /// A line each, in the order of the file and each once; those of the command line come last.
  std::string report() const;

 private:
  struct LocatedError {
    SourceLocation location;
    std::string text;
  };
  std::vector<LocatedError> errors_;
};

/// Where the files lie that a preset names: in a folder, or with it in the program.
struct FileContext {
  std::filesystem::path folder;
  const std::map<std::string, std::string>* built_in = nullptr;  ///< texts by name
};

/// A file that a key names: it is read once every other key is known.
struct NamedFile {
  std::string table, key;
  int item = -1;  ///< of a list of tables
  std::string name;
  FileContext context;
};

// A preset while its file is read, and what its keys say together once all are laid.

/// A preset that is being read, and the source of each of its keys.
struct PresetBuilder {
  Preset preset;
  /// Gives the rods of a table what their material says, but for what the same layer or a later one
  /// sets itself.
  void take_material(const std::string& table);

  std::map<std::string, SourceLocation> set_at;  ///< by bracketed name
  std::set<std::string> faulty;                  ///< keys whose value was refused
  std::map<std::string, NamedFile> files;        ///< by bracketed name
  std::vector<std::string> read, notes;          ///< what came of them, and what may not be meant

  /// A list of tables made empty again, and where its keys were set.
  void forget_items(const std::string& table);
};

/// Adds errors for values that contradict each other; if none of them was set, the error is in
/// `source`.
void check_conflicts(const PresetBuilder& builder, const std::string& source,
                     LocatedErrors& errors);

/// Keys that count for nothing in any of the runs of a file, because of what others are set to.
void check_unused_keys(const std::vector<PresetBuilder>& runs, LocatedErrors& errors);

}  // namespace gridshell::preset
