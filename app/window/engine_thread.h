// The engine on a thread of its own: wishes go in, sights come out, and it can be stopped.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "app/window/shell_in_hand.h"

namespace gridshell::window {

class EngineThread {
 public:
  EngineThread();
  ~EngineThread();  ///< stops what is under way
  EngineThread(const EngineThread&) = delete;
  EngineThread& operator=(const EngineThread&) = delete;

  /// Comes after those before it, but takes the place of a passing one of its own stroke that has
  /// not begun, and breaks off a refinement.
  void post(Wish wish);
  /// Stops what is under way and forgets what waits; the last certified state stays.
  void cancel();

  /// The latest; never null.
  std::shared_ptr<const Sight> sight() const;
  /// Whether there is nothing to do.
  bool idle() const;
  /// Seconds since it was idle; 0 while it is.
  double busy_seconds() const;
  /// Waits until it is idle.
  void wait();

 private:
  void work();

  mutable std::mutex mutex_;
  std::condition_variable wake_, rested_;
  std::deque<Wish> wishes_;
  std::shared_ptr<Watch> watch_;  // of what is under way
  std::shared_ptr<const Sight> sight_;
  bool working_ = false, refining_ = false, unrefined_ = false, over_ = false;
  double busy_since_ = 0;
  ShellInHand hand_;  // the thread's alone
  std::thread thread_;
};

}  // namespace gridshell::window
