// All that lies in a folder, to be compared with what lay there before.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "engine/core/file_io.h"

/// Every file's bytes, by its path in the folder; of folders, links and pipes their kind.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto kind = entry.symlink_status().type();
    all[entry.path().lexically_relative(folder)] = kind == fs::file_type::regular
                                                       ? gridshell::read_file(entry.path()).value()
                                                       : std::to_string(int(kind));
  }
  return all;
}
