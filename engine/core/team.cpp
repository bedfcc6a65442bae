#include "engine/core/team.h"

#include <algorithm>

namespace gridshell {
namespace {

constexpr int spins = 3000;  // some 100 microseconds: rounds follow one another closely

/// Lets the other thread of a core work meanwhile.
inline void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Waits while `value` is `old`: awake at first, then asleep.
template <class Value>
void wait_while(const std::atomic<Value>& value, Value old) {
  for (int k = 0; k < spins; ++k, pause())
    if (value.load(std::memory_order_acquire) != old) return;
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Team::Team(int threads) {
  for (int k = 1; k < threads; ++k)
    helpers_.emplace_back([this](const std::stop_token& stop) { help(stop); });
}

Team::~Team() {
  for (auto& helper : helpers_) helper.request_stop();
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
}

void Team::run(int tasks, const std::function<void(int)>& task) {
  task_ = &task;
  tasks_ = tasks;
  next_.store(0, std::memory_order_relaxed);
  const int helpers = tasks > 1 ? int(helpers_.size()) : 0;
  if (helpers > 0) {
    busy_.store(helpers, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  }
  work();
  for (int left = busy_.load(std::memory_order_acquire); left > 0;
       left = busy_.load(std::memory_order_acquire))
    wait_while(busy_, left);
}

void Team::work() {
  for (int k = next_++; k < tasks_; k = next_++) (*task_)(k);
}

void Team::help(const std::stop_token& stop) {
  for (std::uint32_t seen = 0;;) {
    wait_while(round_, seen);
    seen = round_.load(std::memory_order_acquire);
    if (stop.stop_requested()) return;
    work();
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_all();
  }
}

}  // namespace gridshell
