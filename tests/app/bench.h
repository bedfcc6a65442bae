// Runs to look at: those that all tests share, and a folder in which the program is run on a small
// preset.
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

/// The run of that line of tests/images/list.txt, which ctest makes before the tests tagged
/// [shared] (and [s1], for s1_actuation alone).
inline fs::path shared_run(const std::string& name) {
  auto run = fs::path(GRIDSHELL_SHARED_RUNS) / name;
  INFO("made by: ctest -R 'shared run: " << name << "'");
  REQUIRE(fs::exists(run));
  return run;
}

/// A copy of it that may be changed.
inline void copy_shared_run(const std::string& name, const fs::path& to) {
  fs::create_directories(to.parent_path());
  fs::copy(shared_run(name), to, fs::copy_options::recursive);
}

/// The program refuses that, with exit code 2 and such a sentence.
template <class Matcher>
void check_refused(const Arguments& arguments, const fs::path& at, const Matcher& why) {
  const auto ended = gridshell_program(arguments, at);
  INFO(ended.err);
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, why);
}

/// A signal that it answers at once, as one that was stopped.
inline Ended interrupted(const Running& running, int number) {
  const auto ended = running.interrupt(number);
  CAPTURE(ended.wall_seconds, ended.cpu_seconds, ended.err);
  CHECK(ended.prompt());
  CHECK(ended.code == 130);
  return ended;
}

/// Runs the program there, and shows why when it does not end well.
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
