#include "engine/study/time_limit.h"

#include <pthread.h>

#include <chrono>

#include "engine/core/system_info.h"

// there only where OpenBLAS is what is linked
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace gridshell::study {

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

}  // namespace gridshell::study
