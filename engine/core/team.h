// Threads that work repeatedly on loops of well under a millisecond. Longer independent tasks use
// parallel_for (parallel.h).
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/core/watch.h"

namespace gridshell {

/// A caller and threads that help it; one caller at a time.
class Team {
 public:
  /// `threads`: number of threads, including the caller.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const { return int(helpers_.size()) + 1; }

  /// Calls task(k) once for every k from 0 to `tasks`, on any thread and in any order, and returns
  /// when all are done. Results must not depend on the thread. If a task throws, tasks not yet
  /// started are left out, and the first exception is thrown again by the caller.
  void run(int tasks, const std::function<void(int)>& task);

 private:
  void help(const std::stop_token& stop);
  void work();

  const std::function<void(int)>* task_ = nullptr;
  int tasks_ = 0;
  std::atomic<int> next_{0};  // next task
  std::atomic<int> busy_{0};  // helpers that have not finished this round
  std::atomic<std::uint32_t> round_{0};
  std::mutex guard_;
  std::exception_ptr thrown_;  // the first of this round
  std::vector<std::jthread> helpers_;
};

/// Overload for an optional team: without one the caller does all tasks.
inline void parallel_for(Team* team, int tasks, const std::function<void(int)>& task) {
  if (team) return team->run(tasks, task);
  for (int k = 0; k < tasks; ++k) task(k);
}

// Threads of BLAS, and a limit of processor time.

/// Restricts BLAS to the calling thread, if the library supports it (OpenBLAS): its threads would
/// not be counted, and sums would depend on their number.
void keep_blas_on_one_thread();

/// A Watch that is cancelled after `seconds` of processor time of the thread that made it, or when
/// `outer` is cancelled.
class TimeLimit {
 public:
  TimeLimit(double seconds, const Watch& outer);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  const Watch& watch() const { return watch_; }
  Watch& watch() { return watch_; }
  /// Whether the time ran out and `outer` was not cancelled.
  bool ran_out() const { return watch_.cancelled() && !outer_.cancelled(); }

 private:
  Watch watch_;
  const Watch& outer_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace gridshell
