// Runs to look at: those that all tests share, and a folder in which the program is run on a small
// preset.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "engine/core/atomic_file.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

/// The run of that line of tests/images/list.txt, which ctest makes before the tests tagged
/// [shared] (and [s1], for s1_actuation alone).
inline std::filesystem::path shared_run(const std::string& name) {
  auto run = std::filesystem::path(GRIDSHELL_SHARED_RUNS) / name;
  INFO("made by: ctest -R 'shared run: " << name << "'");
  REQUIRE(std::filesystem::exists(run));
  return run;
}

/// A copy of it that may be changed.
inline void copy_shared_run(const std::string& name, const std::filesystem::path& to) {
  std::filesystem::create_directories(to.parent_path());
  std::filesystem::copy(shared_run(name), to, std::filesystem::copy_options::recursive);
}

struct Bench {
  TemporaryFolder folder;
  std::filesystem::path at = folder.path();

  /// A folder with this preset as small.toml in it.
  explicit Bench(const std::string& preset) {
    REQUIRE(gridshell::write_atomically(at / "small.toml", preset));
  }
  Ended run(const std::vector<std::string>& arguments) const {
    return gridshell_program(arguments, at);
  }
  /// Runs, and shows why when it does not end well.
  Ended good(const std::vector<std::string>& arguments) const {
    const auto ended = run(arguments);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended;
  }
};
