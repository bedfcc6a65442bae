// A thread beside the one that draws.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "engine/core/result.h"

namespace gridshell::render {

/// Does one job after the other on one thread of its own, which keeps what libraries remember of a
/// thread; where no thread is to be had, on the one that asks.
class Worker {
 public:
  using Job = std::function<Result<void>()>;

  Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Waits for the job under way.
  ~Worker();

  /// Begins a job; the one before has been waited for.
  void begin(Job job);
  /// How the job under way ended, once it has; nothing was to be done: well. What it threw is
  /// thrown here.
  Result<void> wait();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  Job job_;                    // null: none under way
  Result<void> ended_;         // how the last one did
  std::exception_ptr thrown_;  // by it
  bool over_ = false;          // no more will come
  std::thread thread_;
};

}  // namespace gridshell::render
