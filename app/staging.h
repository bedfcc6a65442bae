// A run's folder in the making: written beside its final name and swapped in only once it is whole,
// so that a run that is stopped, killed or out of disk leaves what stood there before.
#pragma once

#include <filesystem>

#include "engine/core/result.h"

namespace gridshell::app {

/// The folder `DIR.partial-<pid>`, which becomes DIR on commit().
class StagedFolder {
 public:
  /// Errors: bad_input when DIR exists and is neither a run (summary.json) nor empty, or cannot be
  /// written.
  static Result<StagedFolder> create(const std::filesystem::path& final_folder);

  StagedFolder(StagedFolder&& other) noexcept;
  StagedFolder& operator=(StagedFolder&&) = delete;
  /// Without a commit or keep() the folder goes, and with it the parents made for it.
  ~StagedFolder();

  const std::filesystem::path& path() const { return partial_; }

  /// Takes the final name; a run that stood there is removed after that. Errors: io.
  Result<void> commit();

  /// Leaves the folder under its partial name, without half-written files.
  void keep();

 private:
  StagedFolder(std::filesystem::path final_folder, std::filesystem::path partial,
               std::filesystem::path first_made);
  void remove() noexcept;

  std::filesystem::path final_, partial_;
  std::filesystem::path first_made_;  // the outermost parent that was made, or empty
  bool settled_ = false;              // committed, kept or moved from
};

/// Removes what writers had not finished (hidden temporaries) under `folder`.
void remove_unfinished(const std::filesystem::path& folder) noexcept;

}  // namespace gridshell::app
