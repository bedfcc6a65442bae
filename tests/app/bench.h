// A folder in which the program is run on a small preset.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "engine/core/file_io.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

struct Bench {
  TemporaryFolder folder;
  std::filesystem::path at = folder.path();

  /// A folder with this preset as small.toml in it.
  explicit Bench(const std::string& preset) {
    REQUIRE(gridshell::write_file(at / "small.toml", preset));
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
