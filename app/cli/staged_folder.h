// Proof that a folder is a run: the list of what was written into it. Whoever replaces or removes a
// folder asks here first.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::app {

/// File of a finished folder that lists all others, a path a line after the line that names it.
inline constexpr const char* manifest_name = "manifest.txt";

/// Lists what stands in `folder` in its manifest. Errors: io.
Result<void> write_manifest(const std::filesystem::path& folder);

/// Why a folder is not a run whose every file this program wrote, naming what is foreign; empty
/// when it is one. Without a manifest (an unfinished run, or one of version 0.1) the summary or the
/// journal is the proof, and the names that a run gives its files decide.
std::string why_not_a_run(const std::filesystem::path& folder);

/// Whether a file may be written there: in a run's folder it would be taken for one of the run, or
/// keep it from being replaced. Errors: bad_input.
Result<void> check_beside_runs(const std::filesystem::path& to);

// A run's folder in the making: written beside its final name and swapped in only once it is whole,
// so that a run that is stopped, killed or out of disk leaves what stood there before.

/// The folder `DIR.partial-<pid>`, of no other program's, which becomes DIR on commit(). Where DIR
/// is a link to a folder, that folder is what is written. Locked while it lives.
class StagedFolder {
 public:
  /// Errors: bad_input when DIR exists and is neither a run without foreign files nor empty, or
  /// cannot be written.
  static Result<StagedFolder> create(const std::filesystem::path& final_folder);

  /// Takes up one of left_behind(). Errors: io where another program has taken it meanwhile.
  static Result<StagedFolder> resume(const std::filesystem::path& final_folder,
                                     const std::filesystem::path& partial);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  /// Without a commit or keep() the folder goes, and with it the parents made for it.
  ~StagedFolder();

  const std::filesystem::path& path() const { return partial_; }

  /// Lists its files and takes the final name at once; a run that stood there is removed after
  /// that. Returns a sentence where that cannot be, naming what stayed behind; else nothing.
  /// Errors: io, also when something that is no run has appeared under the final name meanwhile.
  Result<std::string> commit();

  /// Leaves the folder under its partial name, without half-written files.
  void keep();

 private:
  StagedFolder(std::filesystem::path final_folder, std::filesystem::path partial,
               std::filesystem::path first_made, int lock);
  void remove() noexcept;
  Result<std::string> remove_old(const std::filesystem::path& old);

  std::filesystem::path final_, partial_;
  std::filesystem::path first_made_;  // the outermost parent that was made, or empty
  int lock_ = -1;                     // descriptor of the folder, locked
  bool settled_ = false;              // committed, kept or moved from
};

/// Why a command must not write to this folder; empty when it may.
std::string refusal_to_write(const std::filesystem::path& folder);

/// Folders that unfinished runs to `final_folder` left behind and nobody is working in, sorted.
std::vector<std::filesystem::path> left_behind(const std::filesystem::path& final_folder);

/// Removes what writers had not finished (hidden temporaries) under `folder`.
void remove_unfinished(const std::filesystem::path& folder);

}  // namespace gridshell::app
