// One task applied to many items, distributed over threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell {

/// The requested number of threads; 0: as many as there are cores.
inline int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, int(std::thread::hardware_concurrency()));
}

/// Calls `make()`, a Result, once per thread and on that thread, and `task(worker, k)` with its
/// value for every k from 0 to `count`, each once; `done(fraction)`, one call at a time, gets the
/// completed fraction. Results should be stored by k, so that they do not depend on the number of
/// threads. A failure (of `make`, or of a task that returns a Result) or an exception cancels the
/// remaining tasks. Errors: the first of those; cancelled. Exceptions are thrown again by the
/// caller's thread.
template <class Make, class Task, class Done>
Result<void> parallel_for(int count, int threads, Watch& watch, const Make& make, const Task& task,
                          const Done& done) {
  std::atomic<int> next{0};
  int finished = 0;
  std::mutex guard;
  std::optional<Error> fault;
  std::exception_ptr thrown;
  const auto fails = [&](const Error& error) {
    const std::lock_guard lock(guard);
    // others that were cancelled for it may come first
    if (!fault || fault->fault == Fault::cancelled) fault = error;
    watch.cancel();
  };
  const auto work = [&] {
    auto worker = make();
    if (!worker) return fails(worker.error());
    for (int k = next++; k < count && !watch.cancelled(); k = next++) {
      if constexpr (std::is_void_v<decltype(task(*worker, k))>)
        task(*worker, k);
      else if (auto ended = task(*worker, k); !ended)
        return fails(ended.error());
      const std::lock_guard lock(guard);
      done(double(++finished) / count);
    }
  };
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!thrown) thrown = std::current_exception();
      watch.cancel();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int k = 1; k < std::min(threads, count); ++k) helpers.emplace_back(guarded);
    guarded();
  }
  if (thrown) std::rethrow_exception(thrown);
  if (fault) return tl::unexpected<Error>(*fault);
  if (watch.cancelled()) return stopped();
  return {};
}

/// Overload for threads that need no data of their own: `task(k)`.
template <class Task, class Done>
Result<void> parallel_for(int count, int threads, Watch& watch, const Task& task,
                          const Done& done) {
  return parallel_for(
      count, threads, watch, [] { return Result<bool>(true); },
      [&](bool, int k) { return task(k); }, done);
}

/// A `done` that reports to a watch: the completed fraction, mapped to a range of its progress.
inline auto reporting(Watch& watch, double from = 0, double to = 1) {
  return [&watch, from, to](double fraction) { watch.report(from + (to - from) * fraction); };
}

}  // namespace gridshell
