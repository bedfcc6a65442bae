// Trajectory files that were changed after they were written, and the messages that refuse them.
#pragma once

#include <hdf5.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "engine/core/file_io.h"
#include "tests/engine/record/sample_run.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

namespace gridshell::record {

/// The message with which a file of these bytes is refused
inline std::string refusal(const std::string& bytes, bool no_checksum = false) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "trajectory.h5";
  REQUIRE(write_file(path, bytes));
  const std::string start = "'" + path.string() + "' is no trajectory of a run: ",
                    why = gridshell::refusal(read_trajectory(path, {.no_checksum = no_checksum}));
  CHECK_THAT(why, Catch::StartsWith(start));
  return why.substr(start.size());
}

/// A trajectory as another program would write it, without a checksum, changed by `change(file)`
template <class Change>
std::string changed(Change change, const Trajectory& run = sample_trajectory()) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "a.h5";
  REQUIRE(write_trajectory(path, run));
  REQUIRE(write_file(path, read_file(path)->substr(512)));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(file);
  H5Fclose(file);
  return read_file(path).value();
}

}  // namespace gridshell::record
