// Long work in phases: one progress bar for all of them, with the time left, and a stop within a
// second of Ctrl-C.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/command_line.h"

namespace gridshell::app {

/// A part of the work, with a length in the progress bar that is proportional to its expected time.
struct Phase {
  std::string label;
  double expected_seconds = 1;
  /// whether it draws pictures: drawing one cannot be stopped, so Ctrl-C may end the program in it
  bool draws = false;
};

inline Phase drawing(std::string label, double expected_seconds) {
  return {std::move(label), expected_seconds, true};
}

/// How far the work is, for a bar or a line.
struct ProgressState {
  double fraction = 0;      ///< of all phases
  double seconds_left = 0;  ///< NaN while too little is done for an estimate
};

/// Progress of work in `phases`: `current` is `fraction` done after `elapsed` seconds. Later phases
/// are scaled by the ratio of the actual to the expected time of the current one.
ProgressState progress_of(const std::vector<Phase>& phases, std::size_t current, double fraction,
                          double elapsed);

/// Speed at which a path is followed on its current mesh.
class PathPace {
 public:
  /// Seconds to the end of the path, parameter 1; NaN while too little is done for an estimate. It
  /// starts again on another mesh and where the parameter decreases.
  double seconds_left(const Watch::Position& at, double now);

 private:
  Watch::Position begun_, last_;
  double begun_at_ = 0;
};

/// Minutes and seconds, "0:31", from an hour on with hours, "1:05:10"; rounded up.
std::string time_text(double seconds);

/// "[======>     ]  52 %  rendering, 0:31 left"
std::string bar_text(const ProgressState& state, const std::string& label, int width);

/// Watches phases from a thread of its own: shows progress on stderr (a bar on a terminal, a line a
/// tenth elsewhere), and passes an interrupt on to the current phase's Watch. It ends the program
/// if a phase that draws has not stopped half a second later.
class Progress {
 public:
  enum class Show { nothing, lines, bar };
  /// a bar on a terminal, lines elsewhere, nothing when quiet
  static Show show_for(bool quiet);

  /// `on_forced_exit` runs, on another thread, before the program is ended because it did not stop.
  Progress(std::vector<Phase> phases, Show show, std::function<void()> on_forced_exit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Ends the current phase and begins the next one, of which it returns the Watch; that is valid
  /// as long as this object.
  Watch& next_phase();

 private:
  void loop();
  void show_now();
  void stop_if_interrupted();

  std::vector<Phase> phases_;
  Show show_;
  std::function<void()> on_forced_exit_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool finished_ = false;
  std::vector<std::unique_ptr<Watch>> watches_;
  double phase_began_ = 0, interrupted_at_ = 0;  // seconds_now()
  bool interrupted_ = false;
  int tenth_shown_ = 0;
  double line_shown_at_ = 0;  // seconds_now()
  PathPace pace_;
  bool bar_open_ = false;
  std::thread thread_;
};

// Long work that writes a folder, with a progress bar and stopped by Ctrl-C. The folder is written
// under a temporary name and gets its final name only when it is complete.

/// The work: writes into `partial` and begins each of the announced phases.
using Work = std::function<Result<void>(const std::filesystem::path& partial, Progress& progress)>;

/// What is delivered: the folder, and the command that makes it ("run").
struct Delivery {
  std::filesystem::path folder;
  std::string command;
};

/// Runs `work` in a new staged folder, or continues in `left`, the folder of an unfinished run;
/// then gives the folder its final name. On failure the finished files remain under the partial
/// name. Errors: those of `work` and of StagedFolder; the message names what remains.
Result<void> deliver(const Delivery& made, const std::vector<Phase>& phases, bool quiet,
                     const Work& work, const std::filesystem::path& left = {});

/// Names in a partial folder: the folder with the segments of the path that were followed, and the
/// file in it that names the build (build_id()) that followed them.
inline constexpr const char *segments_name = "segments", *version_name = "version";

}  // namespace gridshell::app
