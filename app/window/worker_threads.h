// Work on other threads, so that the window remains responsive: tasks in the background, the
// engine.
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

/// Called with each line of progress: "40 %  rendering, 0:12 left".
using ProgressListener = std::function<void(const std::string& line)>;

/// A task that runs in the background, such as making a movie; one at a time.
class BackgroundTask {
 public:
  using Work = std::function<Result<void>(const ProgressListener& listener, const Watch& watch)>;
  /// How a task ended: the file or folder it made or an error, and its last line of progress.
  struct End {
    std::filesystem::path target;
    Result<void> made;
    std::string last_words;
  };

  BackgroundTask() = default;
  ~BackgroundTask() { stop(); }  ///< waits for the end
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Starts a task. If one is running, waits for its end first.
  void begin(Work work, const std::filesystem::path& target);
  /// Cancels the task; does not wait.
  void stop();
  /// Whether a task is running.
  bool under_way() const;
  /// Whether none is running and the end of the last one was taken.
  bool idle() const { return !ended_.valid(); }
  /// The last line of progress.
  std::string progress_text() const;
  /// The end of the last task, once; nothing while it runs or after it was taken.
  std::optional<End> take_end();
  /// Waits until none is running.
  void wait() const {
    if (ended_.valid()) ended_.wait();
  }

 private:
  mutable std::mutex mutex_;    // guards line_
  std::optional<Watch> watch_;  // of the current task or the last one
  std::filesystem::path target_;
  std::string line_;
  // last, so that its destructor, which waits for the task, runs first
  std::future<Result<void>> ended_;
};

/// The engine on a thread of its own: takes commands and returns views of the shell.
class EngineThread {
 public:
  EngineThread();
  ~EngineThread();  ///< stops the current command
  EngineThread(const EngineThread&) = delete;
  EngineThread& operator=(const EngineThread&) = delete;

  /// Queues a command; it replaces the last waiting one if that is a `passing` one of the same drag
  /// and kind. Stops a refinement.
  void post(Command command);
  /// Stops the current command and discards waiting ones; the last certified state remains.
  void cancel();

  /// The latest view of the shell; never null.
  std::shared_ptr<const ShellView> shell() const;
  /// Whether no command runs or waits, and no refinement is due.
  bool idle() const;
  /// Seconds since the first of the current commands was posted; 0 if there is none.
  double busy_seconds() const;
  /// Waits until the engine is idle.
  void wait();

 private:
  void work();
  template <class Act>
  std::shared_ptr<const ShellView> view_after(const Act& act);

  mutable std::mutex mutex_;
  std::condition_variable wake_, became_idle_;
  std::deque<Command> commands_;
  std::shared_ptr<Watch> watch_;  // of the current command
  std::shared_ptr<const ShellView> shell_;
  bool working_ = false, refining_ = false, unrefined_ = false, over_ = false;
  double busy_since_ = 0;
  EditSession session_;  // used by thread_ only
  std::thread thread_;
};

}  // namespace gridshell::window
