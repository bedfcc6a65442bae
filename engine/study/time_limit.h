// When a method is cut off.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/core/watch.h"

namespace gridshell::study {

/// From here on BLAS works on the calling thread alone, where the library can be told so
/// (OpenBLAS): its helpers would not be charged, and sums would depend on how many there are.
void keep_blas_on_one_thread();

/// A Watch of its own that is cancelled once the thread that made it has worked for `seconds` more,
/// or with `outer`.
class TimeLimit {
 public:
  TimeLimit(double seconds, const Watch& outer);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  const Watch& watch() const { return watch_; }
  Watch& watch() { return watch_; }
  /// Whether the time ran out, and not the patience of the user.
  bool ran_out() const { return watch_.cancelled() && !outer_.cancelled(); }

 private:
  Watch watch_;
  const Watch& outer_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace gridshell::study
