// Watch: an object through which long work reports progress and receives a cancel.
#pragma once

#include <atomic>

namespace gridshell {

/// Used by long work (one writer) and its observers (any thread, also a signal handler). Progress
/// only increases; a cancel is permanent: once requested, the work ends with Fault::cancelled.
class Watch {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

  /// Reports the fraction of the work that is done, in [0, 1]; smaller values than before are
  /// ignored.
  void report(double fraction) noexcept {
    if (fraction > progress_.load(std::memory_order_relaxed))
      progress_.store(fraction, std::memory_order_relaxed);
  }
  double progress() const noexcept { return progress_.load(std::memory_order_relaxed); }

  /// The current path parameter, and the edges per segment of the mesh that is solved.
  struct Position {
    double t = 0;
    int edges = 0;  ///< 0: on no path yet
  };
  void set_position(double t, int edges) const noexcept {
    t_.store(t, std::memory_order_relaxed);
    edges_.store(edges, std::memory_order_relaxed);
  }
  Position position() const noexcept {
    return {t_.load(std::memory_order_relaxed), edges_.load(std::memory_order_relaxed)};
  }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free);
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
  // mutable, as work that has a const Watch reports them, too
  mutable std::atomic<double> t_{0.0};
  mutable std::atomic<int> edges_{0};
};

/// A Watch for work that is never cancelled.
inline const Watch unwatched;

}  // namespace gridshell
