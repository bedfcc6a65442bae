// The 512 bytes before the HDF5 part of trajectory.h5: its size and checksum, which HDF5 programs
// skip.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gridshell::record {

/// What a trajectory says that it is, in its seal and as an attribute.
inline constexpr const char* trajectory_format = "gridshell trajectory 1";

/// HDF5 looks for its own beginning at 0, 512, 1024 ...: what lies before is the program's to use.
inline constexpr std::size_t seal_size = 512;

/// The seal that a file should bear, from the bytes after its first 512; empty when it cannot be
/// read.
std::string seal_due(const std::filesystem::path& path);

/// Why a file is not to be trusted, or empty. A file without a seal was written by another program:
/// it is trusted where `unsealed` is wanted.
std::string distrust(const std::filesystem::path& path, bool unsealed);

}  // namespace gridshell::record
