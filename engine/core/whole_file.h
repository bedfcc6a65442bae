// Files that are whole or absent: written beside their final name, then renamed over it. A killed
// program leaves at most a `.part` file, never half a file under a final name.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gridshell {

/// Lets `write` make the file `temporary` (beside `path`, named `<path>.part`) and renames it to
/// `path` when that succeeded; removes it otherwise. Errors: those of `write`, or Fault::io naming
/// `path` and what the system said.
Result<void> write_whole_file(
    const std::filesystem::path& path,
    const std::function<Result<void>(const std::filesystem::path& temporary)>& write);

/// The same with the bytes at hand; a disk that fills up is noticed at write, flush or close.
Result<void> write_whole_file(const std::filesystem::path& path, std::string_view bytes);

/// All bytes of a file. Errors: Fault::io naming `path` and what the system said.
Result<std::string> read_whole_file(const std::filesystem::path& path);

/// Makes a folder and its parents; one that exists is fine. Errors: Fault::io as above.
Result<void> make_folder(const std::filesystem::path& folder);

}  // namespace gridshell
