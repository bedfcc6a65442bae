#include "app/window/engine_thread.h"

#include "engine/core/clock.h"

namespace gridshell::window {

EngineThread::EngineThread() : sight_(std::make_shared<Sight>()) {
  hand_.tell([this](const Sight& sight) {
    auto seen = std::make_shared<const Sight>(sight);
    const std::lock_guard lock(mutex_);
    sight_ = std::move(seen);
  });
  thread_ = std::thread([this] { work(); });
}

EngineThread::~EngineThread() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    wishes_.clear();
    if (watch_) watch_->cancel();
  }
  wake_.notify_all();
  thread_.join();
}

void EngineThread::post(Wish wish) {
  {
    const std::lock_guard lock(mutex_);
    if (wishes_.empty() && !working_) busy_since_ = seconds_now();
    const bool newer = !wishes_.empty() && wish.stroke != 0 && wishes_.back().passing &&
                       wishes_.back().stroke == wish.stroke &&
                       wishes_.back().deed.index() == wish.deed.index();
    if (newer)
      wishes_.back() = std::move(wish);
    else
      wishes_.push_back(std::move(wish));
    if (refining_) watch_->cancel();
  }
  wake_.notify_all();
}

void EngineThread::cancel() {
  const std::lock_guard lock(mutex_);
  wishes_.clear();
  unrefined_ = false;
  if (watch_) watch_->cancel();
  if (!working_) rested_.notify_all();
}

std::shared_ptr<const Sight> EngineThread::sight() const {
  const std::lock_guard lock(mutex_);
  return sight_;
}

bool EngineThread::idle() const {
  const std::lock_guard lock(mutex_);
  return wishes_.empty() && !working_ && !unrefined_;
}

double EngineThread::busy_seconds() const {
  const std::lock_guard lock(mutex_);
  return wishes_.empty() && !working_ ? 0 : seconds_now() - busy_since_;
}

void EngineThread::wait() {
  std::unique_lock lock(mutex_);
  rested_.wait(lock, [this] { return wishes_.empty() && !working_ && !unrefined_; });
}

/// One wish, or the refinement after the last of a stroke, at a time.
void EngineThread::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return over_ || !wishes_.empty() || unrefined_; });
    if (over_) return;
    working_ = true;
    watch_ = std::make_shared<Watch>();
    const std::shared_ptr<Watch> watch = watch_;
    if (!wishes_.empty()) {
      const Wish wish = std::move(wishes_.front());
      wishes_.pop_front();
      unrefined_ = !wish.passing;
      lock.unlock();
      hand_.fulfil(wish, *watch);
      lock.lock();
      // of a design that is stopped the last step stands, and is to be certified as any other
      if (watch->cancelled()) unrefined_ = std::holds_alternative<Design>(wish.deed);
    } else {
      refining_ = true;
      lock.unlock();
      hand_.refine(*watch);
      lock.lock();
      refining_ = unrefined_ = false;
    }
    sight_ = std::make_shared<Sight>(hand_.sight());
    working_ = false;
    watch_.reset();
    if (wishes_.empty() && !unrefined_) rested_.notify_all();
  }
}

}  // namespace gridshell::window
