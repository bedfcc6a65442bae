#include "render/movie/frame_writer.h"

#include <fmt/format.h>
#include <system_error>

#include "engine/core/try.h"
#include "render/canvas/canvas.h"

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

std::string frame_name(int index) { return fmt::format("frame_{:05d}.png", index); }

Result<void> FrameWriter::put(Image picture, DrawOverPicture over) {
  return finish().and_then([&] { return check(); }).map([&] {
    picture_ = std::move(picture);
    worker_.begin([this, over = std::move(over), index = begun_++] {
      if (over) over(picture_);
      return write_png(picture_, folder_ / frame_name(index)).map([&] {
        watch_.report(double(index + 1) / count_);
        if (on_frame_) on_frame_(index, picture_);
      });
    });
  });
}

Result<void> FrameWriter::finish() {
  TRY_DO(worker_.wait());
  written_ = begun_;
  return {};
}

Result<void> FrameWriter::check() {
  if (!watch_.cancelled()) return {};
  TRY_DO(finish());
  return fail(Fault::cancelled, fmt::format("stopped after {} of {} frames", written_, count_));
}

}  // namespace gridshell::render
