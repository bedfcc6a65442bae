// Checks of the program's messages and files after an attack.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/app/program.h"
#include "tests/temporary_folder.h"

/// Checks that the error message is the program's own, not a library's, and has no control
/// characters.
inline void check_message(const Ended& ended) {
  INFO(ended.err.substr(0, 2000));
  CHECK_FALSE(ended.err.empty());
  for (const char* raw : {"filesystem error", "std::", "basic_string", "vector::", "what():",
                          "Assertion", "nan mm", "json.exception", "HDF5-DIAG"})
    CHECK(ended.err.find(raw) == std::string::npos);
  CHECK(std::ranges::all_of(ended.err, [](unsigned char c) { return c == '\n' || c >= 0x20; }));
}

/// Waits so many seconds for the end of the process. Then sends the signal, checks that it is
/// answered within 5 s (SIGKILL counts as not answered), and kills the process if not.
inline Ended ended_within(const Running& running, double seconds, int signal) {
  if (!running.ends_within(seconds)) {
    running.signal(signal);
    const bool answered = signal != SIGKILL && running.ends_within(5);
    CHECK(answered);
    if (!answered) running.signal(SIGKILL);
    auto ended = running.wait();
    if (answered) CHECK(ended.code == 130);
    return ended;
  }
  return running.wait();
}

/// Removes everything from the folder but the names `there`; checks that `may` allows each name.
template <class May>
void clear(const TemporaryFolder& folder, std::initializer_list<const char*> there,
           const May& may) {
  for (const auto& name : folder.entries()) {
    if (std::find(there.begin(), there.end(), name) != there.end()) continue;
    INFO(name);
    CHECK(may(name));
    std::filesystem::remove_all(folder.path() / name);
  }
}
