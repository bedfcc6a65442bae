#include "engine/core/team.h"

#include <pthread.h>
#include <chrono>
#include <utility>

#include "engine/core/system_info.h"

// null unless OpenBLAS is linked
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace gridshell {
namespace {

constexpr int spins = 3000;  // about 100 microseconds: rounds follow one another closely

/// Lets the other thread of a core work for a moment.
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
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Team::work() {
  try {
    for (int k = next_++; k < tasks_; k = next_++) (*task_)(k);
  } catch (...) {
    // tasks that are not started yet are left out
    next_.store(tasks_);
    const std::lock_guard lock(guard_);
    if (!thrown_) thrown_ = std::current_exception();
  }
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

void keep_blas_on_one_thread() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

TimeLimit::TimeLimit(double seconds, const Watch& outer) : outer_(outer) {
  clockid_t clock = CLOCK_THREAD_CPUTIME_ID;
  pthread_getcpuclockid(pthread_self(), &clock);
  const double end = cpu_seconds_now(clock) + seconds;
  thread_ = std::thread([this, clock, end] {
    std::unique_lock lock(mutex_);
    while (!finished_) {
      if (outer_.cancelled() || cpu_seconds_now(clock) > end) watch_.cancel();
      wake_.wait_for(lock, std::chrono::milliseconds(20));
    }
  });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

}  // namespace gridshell
