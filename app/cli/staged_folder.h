// Which folders are runs of this program, so that they may be replaced; writing a folder under a
// temporary name until it is complete.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::app {

/// File in a finished folder that lists all other files in it. Its first line names the format and
/// the command that made the folder; then follows one path per line.
inline constexpr const char* manifest_name = "manifest.txt";

/// Writes the manifest of `folder`, which `command` ("run") made. Errors: io.
Result<void> write_manifest(const std::filesystem::path& folder, const std::string& command);

/// The command that made a run's folder ("run", "figure", "sweep"), from its manifest, else from
/// its summary; empty if neither names it.
std::string maker_of(const std::filesystem::path& folder);

/// Whether a folder has the manifest that commands of this program write.
bool has_manifest(const std::filesystem::path& folder);

/// Why a folder is not a run, or which of its files this program did not write; empty if it is a
/// run without foreign files. A folder without a manifest (an unfinished run, or one of version
/// 0.1) is a run if it has a summary or journal; files with other names than those of a run are
/// foreign.
std::string why_not_a_run(const std::filesystem::path& folder);

/// `folder` with `suffix` appended to its name, "out/run_report.pdf"; the name of "." is that of
/// the current folder.
std::filesystem::path next_to(const std::filesystem::path& folder, const std::string& suffix);

/// Checks that the file or folder `to` is not in the folder of a run, which could then no longer be
/// replaced. Errors: bad_input.
Result<void> check_outside_runs(const std::filesystem::path& to);
/// check_outside_runs() for a file, whose name nothing but a file may have, in a folder that can be
/// written or made. Errors: bad_input.
Result<void> check_output_file(const std::filesystem::path& to);

// A run's folder while it is written: under a temporary name, exchanged with the final one only
// when it is complete, so that a run that is stopped, killed or out of disk leaves the old folder
// unchanged.

/// The folder `DIR.partial-<pid>`, which commit() renames to DIR. If DIR is a link to a folder,
/// that folder is replaced. It is locked as long as this object exists, so that no other program
/// uses it.
class StagedFolder {
 public:
  /// Makes the folder. Errors: bad_input if it cannot be made, or if DIR exists and is neither
  /// empty nor a run without foreign files that `command` may replace.
  static Result<StagedFolder> create(const std::filesystem::path& final_folder,
                                     const std::string& command);

  /// Continues in `partial`, one of left_behind(). Errors: bad_input if `command` may not replace
  /// DIR; io if another program uses `partial` now.
  static Result<StagedFolder> resume(const std::filesystem::path& final_folder,
                                     const std::string& command,
                                     const std::filesystem::path& partial);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  /// Removes the folder and the parents made for it, unless commit() or keep() was called.
  ~StagedFolder();

  const std::filesystem::path& path() const { return partial_; }

  /// Writes the manifest, gives the folder its final name and removes the run that had it. Returns
  /// a message if that run could not be removed completely, else an empty text. Errors: io, also if
  /// the final name now belongs to something that must not be replaced, to a folder that another
  /// program wrote since create(), or to a run with more frames than this movie.
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
  ino_t replaces_;                    // the folder that had the final name at first; 0: none
  int lock_ = -1;                     // descriptor of the folder, locked
  bool settled_ = false;              // commit() or keep() was called, or it was moved from
};

/// Why a command must not write to this folder; empty if it may. A command replaces only folders
/// that the same command made, and `movie` also those of `run`; an empty command replaces any run.
std::string refusal_to_write(const std::filesystem::path& folder, const std::string& command);

/// Temporary folders that unfinished runs to `final_folder` left and no program uses, sorted.
std::vector<std::filesystem::path> left_behind(const std::filesystem::path& final_folder);

/// Removes half-written files (their names begin with a dot) under `folder`.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace gridshell::app
