// Makes the folder of a run that was killed.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>

#include "engine/record/journal.h"
#include "engine/record/trajectory_file.h"

/// Turns a complete run into the folder that it would have left if killed after `count` frames.
inline void cut_short(const std::filesystem::path& whole, const std::filesystem::path& partial,
                      std::size_t count,
                      gridshell::record::Kind kind = gridshell::record::Kind::run) {
  const auto run = gridshell::record::read_trajectory(whole / "trajectory.h5");
  REQUIRE(run);
  std::filesystem::create_directories(partial);
  std::filesystem::copy_file(whole / "preset.toml", partial / "preset.toml");
  auto journal = gridshell::record::JournalWriter::create(partial / gridshell::record::journal_name,
                                                          {"small", kind}, run->layout);
  REQUIRE(journal);
  for (std::size_t k = 0; k < count; ++k) REQUIRE(journal->append(run->frames[k]));
}
