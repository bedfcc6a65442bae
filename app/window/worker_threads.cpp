#include "app/window/worker_threads.h"

#include <chrono>
#include <exception>
#include <utility>

#include "engine/core/system_info.h"

namespace gridshell::window {

void BackgroundTask::begin(Work work, const std::filesystem::path& target) {
  wait();
  watch_.emplace();
  target_ = target;
  line_.clear();
  ended_ = std::async(std::launch::async, [this, work = std::move(work)] {
    const auto listener = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      line_ = line;
    };
    return work(listener, *watch_);
  });
}

void BackgroundTask::stop() {
  if (watch_) watch_->cancel();
}

bool BackgroundTask::under_way() const {
  return ended_.valid() && ended_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

std::string BackgroundTask::progress_text() const {
  const std::lock_guard lock(mutex_);
  return line_;
}

std::optional<BackgroundTask::End> BackgroundTask::take_end() {
  if (idle() || under_way()) return std::nullopt;
  return End{target_, ended_.get(), progress_text()};
}

EngineThread::EngineThread() : shell_(std::make_shared<ShellView>()) {
  session_.set_listener([this](const ShellView& shell) {
    auto seen = std::make_shared<const ShellView>(shell);
    const std::lock_guard lock(mutex_);
    shell_ = std::move(seen);
  });
  thread_ = std::thread([this] { work(); });
}

EngineThread::~EngineThread() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    commands_.clear();
    if (watch_) watch_->cancel();
  }
  wake_.notify_all();
  thread_.join();
}

void EngineThread::post(Command command) {
  {
    const std::lock_guard lock(mutex_);
    if (commands_.empty() && !working_) busy_since_ = seconds_now();
    const bool newer = !commands_.empty() && command.drag != 0 && commands_.back().passing &&
                       commands_.back().drag == command.drag &&
                       commands_.back().edit.index() == command.edit.index();
    if (newer)
      commands_.back() = std::move(command);
    else
      commands_.push_back(std::move(command));
    if (refining_) watch_->cancel();
  }
  wake_.notify_all();
}

void EngineThread::cancel() {
  const std::lock_guard lock(mutex_);
  commands_.clear();
  unrefined_ = false;
  if (watch_) watch_->cancel();
  if (!working_) became_idle_.notify_all();
}

std::shared_ptr<const ShellView> EngineThread::shell() const {
  const std::lock_guard lock(mutex_);
  return shell_;
}

bool EngineThread::idle() const {
  const std::lock_guard lock(mutex_);
  return commands_.empty() && !working_ && !unrefined_;
}

double EngineThread::busy_seconds() const {
  const std::lock_guard lock(mutex_);
  return commands_.empty() && !working_ ? 0 : seconds_now() - busy_since_;
}

void EngineThread::wait() {
  std::unique_lock lock(mutex_);
  became_idle_.wait(lock, [this] { return commands_.empty() && !working_ && !unrefined_; });
}

/// The view of the shell after `act`; null, so that the last view remains, if memory runs out.
template <class Act>
std::shared_ptr<const ShellView> EngineThread::view_after(const Act& act) {
  try {
    act();
    return std::make_shared<const ShellView>(session_.shell());
  } catch (const std::exception&) {
    return nullptr;
  }
}

/// Executes commands one after the other; refines the meshes after one that is not `passing`, when
/// no other waits.
void EngineThread::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return over_ || !commands_.empty() || unrefined_; });
    if (over_) return;
    working_ = true;
    watch_ = std::make_shared<Watch>();
    const std::shared_ptr<Watch> watch = watch_;
    if (!commands_.empty()) {
      const Command command = std::move(commands_.front());
      commands_.pop_front();
      unrefined_ = !command.passing;
      lock.unlock();
      auto seen = view_after([&] { session_.execute(command, *watch); });
      lock.lock();
      if (seen) shell_ = std::move(seen);
      // no refinement after a cancel, except of a design, whose last step remains and is certified
      if (watch->cancelled()) unrefined_ = std::holds_alternative<Design>(command.edit);
    } else {
      refining_ = true;
      lock.unlock();
      auto seen = view_after([&] { session_.refine(*watch); });
      lock.lock();
      if (seen) shell_ = std::move(seen);
      refining_ = unrefined_ = false;
    }
    working_ = false;
    watch_.reset();
    if (commands_.empty() && !unrefined_) became_idle_.notify_all();
  }
}

}  // namespace gridshell::window
