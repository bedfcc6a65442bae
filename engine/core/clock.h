// Wall time for reports, and the processor's time for measurements.
#pragma once

#include <time.h>

#include <chrono>

namespace gridshell {

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

}  // namespace gridshell
