// Which gridshell this is.
#pragma once

#include <time.h>
#include <chrono>
#include <cstdint>
#include <string>

namespace gridshell {

/// "0.2.0", that of the CMake project.
const char* version();

/// Identifies the build: the version, and the hash that the linker gave the program or library (the
/// same for the same sources, compiler and options). Another build may continue a run differently.
std::string build_id();

// Wall time for reports, and the processor's time for measurements.

/// Seconds of a clock that never goes back; only differences mean anything.
inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds that the processor has worked for a thread, by default the calling one: other programs
/// and threads on the machine do not count.
inline double cpu_seconds_now(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec t{};
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// How much memory there is to work with.

/// Bytes of the machine, or of the fraction that a container gives this program; 0 when nobody
/// says.
std::uint64_t machine_memory_bytes();

/// What a command may use where a preset does not say ([accuracy] memory_GB): half of that.
inline double default_memory_GB() { return 0.5e-9 * double(machine_memory_bytes()); }

}  // namespace gridshell
