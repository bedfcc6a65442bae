// Work in the background, on a thread of its own: the shell and its picture stay responsive.
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

/// Takes each line of progress: "40 %  rendering, 0:12 left".
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

  /// Starts a task if none is running.
  void begin(Work work, const std::filesystem::path& target);
  void stop();
  bool under_way() const;
  /// Whether none is running and the end of the last one was taken.
  bool idle() const { return !ended_.valid(); }
  /// The last that was said.
  std::string standing() const;
  /// The end of the last one, once.
  std::optional<End> take_end();
  /// Waits until none is running.
  void wait() const {
    if (ended_.valid()) ended_.wait();
  }

 private:
  mutable std::mutex mutex_;    // of what was said
  std::optional<Watch> watch_;  // of the current task or the last one
  std::filesystem::path target_;
  std::string said_;
  std::future<Result<void>> ended_;  // goes first: its end waits for the work
};

// The engine on a thread of its own: it takes commands and returns views, and can be stopped.

class EngineThread {
 public:
  EngineThread();
  ~EngineThread();  ///< stops the current command
  EngineThread(const EngineThread&) = delete;
  EngineThread& operator=(const EngineThread&) = delete;

  /// Queues a command, but replaces a waiting `passing` one of the same drag, and stops a
  /// refinement.
  void post(Command command);
  /// Stops the current command and discards waiting ones; the last certified state remains.
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
  std::shared_ptr<Watch> watch_;  // of the current command
  std::shared_ptr<const ShellView> shell_;
  bool working_ = false, refining_ = false, unrefined_ = false, over_ = false;
  double busy_since_ = 0;
  EditSession session_;  // the thread's alone
  std::thread thread_;
};

}  // namespace gridshell::window
