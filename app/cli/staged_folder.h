// Proof that a folder is a run: the list of what was written into it. Whoever replaces or removes a
// folder asks here first.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::app {

/// File of a finished folder that lists all others, a path a line after the line that names it and
/// the command that made the folder.
inline constexpr const char* manifest_name = "manifest.txt";

/// Lists what is in `folder` in its manifest, as made by `command` ("run"). Errors: io.
Result<void> write_manifest(const std::filesystem::path& folder, const std::string& command);

/// The command that made a run's folder ("run", "figure", "sweep"), as its manifest says, else its
/// summary; empty where neither says it.
std::string maker_of(const std::filesystem::path& folder);

/// Why a folder is not a run whose every file this program wrote, naming what is foreign; empty
/// when it is one. Without a manifest (an unfinished run, or one of version 0.1) the summary or the
/// journal is the proof, and the names that a run gives its files decide.
std::string why_not_a_run(const std::filesystem::path& folder);

/// Whether a file may be written there: in a run's folder it would be taken for one of the run, or
/// keep it from being replaced. Errors: bad_input.
Result<void> check_beside_runs(const std::filesystem::path& to);

// A run's folder while it is written: under a temporary name, exchanged with the final one only
// when it is complete, so that a run that is stopped, killed or out of disk leaves the old folder
// unchanged.

/// The folder `DIR.partial-<pid>`, of no other program's, which becomes DIR on commit(). Where DIR
/// is a link to a folder, that folder is what is written. Locked while it lives.
class StagedFolder {
 public:
  /// Errors: bad_input when DIR exists and is neither empty nor a run without foreign files that
  /// `command` may replace, or cannot be written.
  static Result<StagedFolder> create(const std::filesystem::path& final_folder,
                                     const std::string& command);

  /// Takes up one of left_behind(). Errors: io where another program has taken it meanwhile.
  static Result<StagedFolder> resume(const std::filesystem::path& final_folder,
                                     const std::string& command,
                                     const std::filesystem::path& partial);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  /// Without a commit or keep() the folder goes, and with it the parents made for it.
  ~StagedFolder();

  const std::filesystem::path& path() const { return partial_; }

  /// Lists its files and takes the final name at once; the old run is removed after that. Returns a
  /// sentence with the remains if that fails; else nothing. Errors: io, also if something that must
  /// not be replaced has the final name now, or a run of which a movie would not retain every
  /// frame.
  Result<std::string> commit();

  /// Leaves the folder under its partial name, without half-written files.
  void keep();

 private:
  StagedFolder(std::filesystem::path final_folder, std::string command,
               std::filesystem::path partial, std::filesystem::path first_made, int lock);
  void remove() noexcept;
  Result<std::string> remove_old(const std::filesystem::path& old);

  std::filesystem::path final_, partial_;
  std::string command_;
  std::filesystem::path first_made_;  // the outermost parent that was made, or empty
  int lock_ = -1;                     // descriptor of the folder, locked
  bool settled_ = false;              // committed, kept or moved from
};

/// Why a command must not write to this folder; empty when it may. A command replaces only what the
/// same command made, and `movie` a `run` of which it keeps the frames; an empty one replaces any
/// run.
std::string refusal_to_write(const std::filesystem::path& folder, const std::string& command);

/// Folders that unfinished runs to `final_folder` left behind and nobody is working in, sorted.
std::vector<std::filesystem::path> left_behind(const std::filesystem::path& final_folder);

/// Removes what writers had not finished (hidden temporaries) under `folder`.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace gridshell::app
