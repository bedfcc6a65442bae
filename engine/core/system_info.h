// Version and build of the program, clocks, and the machine's memory.
#pragma once

#include <time.h>
#include <chrono>
#include <cstdint>
#include <string>

namespace gridshell {

/// The version of the CMake project: "0.2.0".
const char* version();

/// Identifies the build: the version, and the hash that the linker gave the program or library (the
/// same for the same sources, compiler and options). Another build may continue a run differently.
std::string build_id();

// Wall time for reports, and the processor's time for measurements.

/// Seconds of a clock that never goes back; only differences mean anything.
inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of a thread, s, by default of the calling one; other programs and threads do not
/// count.
inline double cpu_seconds_now(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec t{};
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// Available memory.

/// Memory of the machine, or the limit of the container that the program runs in, bytes; 0: not
/// known.
std::uint64_t machine_memory_bytes();

/// Limit of a command's memory without [accuracy] memory_GB in the preset, GB: half of the memory.
inline double default_memory_GB() { return 0.5e-9 * double(machine_memory_bytes()); }

}  // namespace gridshell
