// Work beside the window, on a thread of its own: the shell and its picture stay free.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/window/edit_session.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::window {

/// Takes each line that is said on the way: "40 %  rendering, 0:12 left".
using ProgressListener = std::function<void(const std::string& line)>;

/// A movie or a picture in the making; one at a time.
class BackgroundTask {
 public:
  using Work = std::function<Result<void>(const ProgressListener& listener, const Watch& watch)>;
  /// How it ended: what it made, and the last that was said.
  struct End {
    std::filesystem::path target;
    Result<void> made;
    std::string last_words;
  };

  BackgroundTask() = default;
  ~BackgroundTask() { stop(); }  ///< waits for the end
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Where none is under way.
  void begin(Work work, const std::filesystem::path& target);
  void stop();
  bool under_way() const;
  /// Whether none is under way and the end of the last one was taken.
  bool idle() const { return !ended_.valid(); }
  /// The last that was said.
  std::string standing() const;
  /// The end of the last one, once.
  std::optional<End> take_end();
  /// Waits until none is under way.
  void wait() const {
    if (ended_.valid()) ended_.wait();
  }

 private:
  mutable std::mutex mutex_;    // of what was said
  std::optional<Watch> watch_;  // of what is under way or has just ended
  std::filesystem::path target_;
  std::string said_;
  std::future<Result<void>> ended_;  // goes first: its end waits for the work
};

// The engine on a thread of its own: commands go in, views come out, and it can be stopped.

class EngineThread {
 public:
  EngineThread();
  ~EngineThread();  ///< stops what is under way
  EngineThread(const EngineThread&) = delete;
  EngineThread& operator=(const EngineThread&) = delete;

  /// Comes after those before it, but takes the place of a passing one of its own drag that has
  /// not begun, and breaks off a refinement.
  void post(Command command);
  /// Stops what is under way and forgets what waits; the last certified state stays.
  void cancel();

  /// The latest; never null.
  std::shared_ptr<const ShellView> shell() const;
  /// Whether there is nothing to do.
  bool idle() const;
  /// Seconds since it was idle; 0 while it is.
  double busy_seconds() const;
  /// Waits until it is idle.
  void wait();

 private:
  void work();
  template <class Act>
  std::shared_ptr<const ShellView> view_after(const Act& act);

  mutable std::mutex mutex_;
  std::condition_variable wake_, rested_;
  std::deque<Command> commands_;
  std::shared_ptr<Watch> watch_;  // of what is under way
  std::shared_ptr<const ShellView> shell_;
  bool working_ = false, refining_ = false, unrefined_ = false, over_ = false;
  double busy_since_ = 0;
  EditSession session_;  // the thread's alone
  std::thread thread_;
};

}  // namespace gridshell::window
