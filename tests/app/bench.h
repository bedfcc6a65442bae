// For tests of the program: the shared runs, and a folder in which it runs on a small preset.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>

#include "engine/core/file_io.h"
#include "tests/app/program.h"
#include "tests/small_preset.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using Catch::Contains;
using gridshell::read_file;
using gridshell::write_file;

inline std::string text_of(const fs::path& file) { return read_file(file).value(); }

/// Folder of the run that the line `name` of tests/images/list.txt describes. ctest makes these
/// runs before the tests tagged [shared]; tests tagged [s1] use s1_actuation alone.
inline fs::path shared_run(const std::string& name) {
  auto run = fs::path(GRIDSHELL_SHARED_RUNS) / name;
  INFO("made by: ctest -R 'shared run: " << name << "'");
  REQUIRE(fs::exists(run));
  return run;
}

/// Copies a shared run to `to`, where a test may change it.
inline void copy_shared_run(const std::string& name, const fs::path& to) {
  fs::create_directories(to.parent_path());
  fs::copy(shared_run(name), to, fs::copy_options::recursive);
}

/// Checks that the program refuses the arguments: exit code 2 and a message that `why` matches.
template <class Matcher>
void check_refused(const Arguments& arguments, const fs::path& at, const Matcher& why) {
  const auto ended = gridshell_program(arguments, at);
  INFO(ended.err);
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, why);
}

/// Sends a signal and checks that the program ends promptly, with exit code 130 (stopped).
inline Ended interrupted(const Running& running, int number) {
  const auto ended = running.interrupt(number);
  CAPTURE(ended.wall_seconds, ended.cpu_seconds, ended.err);
  CHECK(ended.prompt());
  CHECK(ended.code == 130);
  return ended;
}

/// Runs the program in the folder `at` and requires exit code 0; prints its output otherwise.
inline Ended good(const Arguments& arguments, const fs::path& at) {
  const auto ended = gridshell_program(arguments, at);
  INFO(ended.out << ended.err);
  REQUIRE(ended.code == 0);
  return ended;
}

struct Bench {
  TemporaryFolder folder;
  fs::path at = folder.path();

  /// A folder with this preset as small.toml in it.
  explicit Bench(const std::string& preset) { REQUIRE(write_file(at / "small.toml", preset)); }
  Ended run(const Arguments& arguments) const { return gridshell_program(arguments, at); }
  Ended good(const Arguments& arguments) const { return ::good(arguments, at); }
};
