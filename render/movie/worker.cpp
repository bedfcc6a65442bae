#include "render/movie/worker.h"

#include <system_error>
#include <utility>

namespace gridshell::render {

Worker::Worker() {
  try {
    thread_ = std::thread([this] { loop(); });
  } catch (const std::system_error&) {
    // whoever begins a job does it
  }
}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Worker::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return job_ || over_; });
    if (!job_) return;
    lock.unlock();
    Result<void> ended;
    std::exception_ptr thrown;
    try {
      ended = job_();
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    ended_ = std::move(ended);
    thrown_ = thrown;
    job_ = nullptr;
    changed_.notify_all();
  }
}

void Worker::begin(Job job) {
  if (!thread_.joinable()) {
    ended_ = job();
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  changed_.notify_all();
}

Result<void> Worker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !job_; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  return std::exchange(ended_, Result<void>{});
}

}  // namespace gridshell::render
