// A folder for temporary files.
#pragma once

#include <stdlib.h>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/core/result.h"

namespace gridshell {

/// A new folder in the system's temporary one, removed with its contents by the destructor.
class ScratchFolder {
 public:
  /// Errors: io.
  static Result<ScratchFolder> make() {
    const auto within = std::filesystem::temp_directory_path();
    std::string name = (within / "gridshell-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      return fail(Fault::io, "cannot make a folder in '{}'", within.string());
    return ScratchFolder(std::move(name));
  }
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace gridshell
