// The same work on many things, shared by threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell {

/// Calls `make()`, a Result, once a thread and on that thread, and `task(worker, k)` with what it
/// returned for every k from 0 to `count`, each once; `done(share)`, one call at a time, with the
/// share of all that is done. Results are to be kept by k, so that they do not hang on the number
/// of threads. Errors: the first of `make`; cancelled.
template <class Make, class Task, class Done>
Result<void> share_work(int count, int threads, const Watch& watch, const Make& make,
                        const Task& task, const Done& done) {
  std::atomic<int> next{0};
  int finished = 0;
  std::mutex guard;
  std::optional<Error> fault;
  const auto work = [&] {
    auto worker = make();
    if (!worker) {
      const std::lock_guard lock(guard);
      if (!fault) fault = worker.error();
      return;
    }
    for (int k = next++; k < count && !watch.cancelled(); k = next++) {
      task(*worker, k);
      const std::lock_guard lock(guard);
      done(double(++finished) / count);
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int k = 1; k < std::min(threads, count); ++k) helpers.emplace_back(work);
    work();
  }
  if (fault) return tl::unexpected<Error>(*fault);
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped");
  return {};
}

}  // namespace gridshell
