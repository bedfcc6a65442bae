// Proof that a folder is a run: the list of what was written into it. Whoever replaces or removes a
// folder asks here first.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/result.h"

namespace gridshell::app {

/// File of a finished folder that lists all others, a path a line after the line that names it.
inline constexpr const char* manifest_name = "manifest.txt";

/// Lists what stands in `folder` in its manifest. Errors: io.
Result<void> write_manifest(const std::filesystem::path& folder);

/// Why a folder is not a run whose every file this program wrote, naming what is foreign; empty
/// when it is one. Without a manifest (an unfinished run, or one of version 0.1) the summary or the
/// journal is the proof, and the names that a run gives its files decide.
std::string no_run_because(const std::filesystem::path& folder);

}  // namespace gridshell::app
