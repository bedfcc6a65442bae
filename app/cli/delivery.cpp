#include "app/cli/delivery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>

#include "app/cli/console.h"
#include "app/cli/staged_folder.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/encode.h"

namespace gridshell::app {
namespace fs = std::filesystem;

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

namespace {

std::string left_text(const ProgressState& at) {
  return std::isnan(at.seconds_left) || at.fraction >= 1
             ? ""
             : fmt::format(", {} left", time_text(at.seconds_left));
}

// seconds between the lines about the path that is followed, and before the first of them
constexpr double line_every_s = 5, first_line_s = 1;

/// Text with the parameter of the path that is being followed, and the time left on these meshes;
/// empty if none is followed.
std::string path_text(const Watch& watch, PathPace& pace) {
  const Watch::Position position = watch.position();
  if (position.edges == 0 || watch.progress() >= 0.5) return "";
  const double left = pace.seconds_left(position, seconds_now());
  return fmt::format(": the path at {:.3f}, on {} edges per segment, remaining time there {}",
                     position.t, position.edges, std::isnan(left) ? "unknown" : time_text(left));
}

// complete files in a folder that was not finished
struct Left {
  std::size_t pictures = 0, runs = 0, frames = 0;  // frames: those of interrupted runs
  bool path = false;                               // whether segments of a path were saved
};

constexpr const char* continue_text = "the same command with --resume continues from there";

Left left_in(const fs::path& folder) {
  Left left;
  std::error_code error;
  left.frames = record::frames_in_journals(folder);
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    left.pictures += at->path().extension() == ".png";
    left.runs += at->path().filename() == "summary.json";
    left.path |= at->path().filename().string().starts_with("segment_");
    if (at->is_directory(error)) left.frames += record::frames_in_journals(at->path());
  }
  return left;
}

std::string near_name(const fs::path& folder) {
  std::error_code error;
  return fs::proximate(folder, error).string();
}

// reports temporary folders that other runs left, and the commands that draw or remove them
void report_left_behind(const fs::path& final_folder) {
  for (const auto& folder : left_behind(final_folder)) {
    const auto name = near_name(folder);
    const auto left = left_in(folder);
    const auto removes = render::shell_line({"rm", "-r", name});
    const bool old = folder.filename().string().find(".old-") != std::string::npos;
    std::string draws;
    if (!old && left.runs + left.frames > 0)
      draws = fmt::format("\n  {}    draws it", render::shell_line({"gridshell", "render", name}));
    if (!old && left.path) draws += fmt::format("\n  {}", continue_text);
    std::fprintf(
        stderr, "'%s' is %s:%s\n  %s    removes it\n", name.c_str(),
        old ? "what is left of a run that was replaced" : "left of a run that was not finished",
        draws.c_str(), removes.c_str());
  }
}

Result<void> attempt(const Work& work, const fs::path& partial, Progress& progress) {
  try {
    return work(partial, progress);
  } catch (const std::exception& error) {
    return tl::unexpected(error_of(error));
  }
}

/// A text that lists the complete files of a folder.
std::string whole_files(const Left& left, const std::string& name) {
  std::vector<std::string> found;
  if (left.frames > 0) found.push_back(counted(left.frames, "frame") + " of an unfinished run");
  if (left.runs > 0) found.push_back(counted(left.runs, "finished run"));
  if (left.pictures > 0) found.push_back(counted(left.pictures, "picture"));
  auto text = fmt::format("complete in '{}': {}", name, fmt::join(found, ", "));
  if (left.runs + left.frames > 0)
    text += "; this draws all frames:\n  " + render::shell_line({"gridshell", "render", name});
  return text;
}

/// Cleans a folder that will not be finished: removes half-written files, and the folder itself if
/// it has no complete picture, run, frame or segment of a path. Returns a text about what is left.
std::string remove_unfinished_files(const fs::path& partial) {
  remove_unfinished(partial);
  const auto left = left_in(partial);
  const auto name = near_name(partial);
  std::string text = left.pictures + left.runs + left.frames > 0 ? whole_files(left, name) : "";
  if (left.path) {
    text += text.empty() ? fmt::format("its path so far is in '{}'; ", name) : "\n";
    return text + continue_text;
  }
  if (!text.empty()) return text;
  std::error_code error;
  fs::remove_all(partial, error);
  return "nothing was finished, so nothing is left behind";
}

}  // namespace

ProgressState progress_of(const std::vector<Phase>& phases, std::size_t current, double fraction,
                          double elapsed) {
  double all = 0, before = 0, after = 0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    all += phases[k].expected_seconds;
    if (k < current) before += phases[k].expected_seconds;
    if (k > current) after += phases[k].expected_seconds;
  }
  const double own = phases[current].expected_seconds;
  // a motion in time adds frames that were not planned
  fraction = std::min(fraction, 1.0);
  ProgressState at{all > 0 ? (before + own * fraction) / all : 0,
                   std::numeric_limits<double>::quiet_NaN()};
  // too early to estimate the speed of this phase
  if (fraction < 0.02 || elapsed < 0.5) return at;
  const double whole = elapsed / fraction;
  at.seconds_left = whole - elapsed + (own > 0 ? after * whole / own : after);
  return at;
}

double PathPace::seconds_left(const Watch::Position& at, double now) {
  constexpr double least_advance = 0.02, least_s = 2;
  // another mesh, or the same on another path
  if (at.edges != last_.edges || at.t < last_.t) begun_ = at, begun_at_ = now;
  last_ = at;
  const double advance = at.t - begun_.t, elapsed = now - begun_at_;
  if (!(advance >= least_advance && elapsed >= least_s))
    return std::numeric_limits<double>::quiet_NaN();
  return std::max(0.0, 1 - at.t) * elapsed / advance;
}

std::string bar_text(const ProgressState& at, const std::string& label, int width) {
  const int full = std::clamp(int(at.fraction * width), 0, width);
  std::string bar(std::size_t(full), '=');
  if (full < width) bar += '>';
  bar.resize(std::size_t(width), ' ');
  return fmt::format("[{}] {:3d} %  {}{}", bar, int(at.fraction * 100), label, left_text(at));
}

Progress::Show Progress::show_for(bool quiet) {
  return quiet ? Show::nothing : isatty(STDERR_FILENO) ? Show::bar : Show::lines;
}

Progress::Progress(std::vector<Phase> phases, Show show, std::function<void()> on_forced_exit)
    : phases_(std::move(phases)), show_(show), on_forced_exit_(std::move(on_forced_exit)) {
  thread_ = std::thread([this] { loop(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  wake_.notify_all();
  thread_.join();
  // clears the line of the bar
  if (bar_open_) std::fputs("\r\033[K", stderr);
}

Watch& Progress::next_phase() {
  const std::lock_guard lock(mutex_);
  watches_.push_back(std::make_unique<Watch>());
  // a phase that was not announced counts as another one like the last
  if (watches_.size() > phases_.size())
    phases_.push_back(phases_.empty() ? Phase{"working"} : phases_.back());
  phase_began_ = seconds_now();
  line_shown_at_ = phase_began_ - line_every_s + first_line_s;
  if (interrupted_) watches_.back()->cancel();
  return *watches_.back();
}

void Progress::loop() {
  std::unique_lock lock(mutex_);
  while (!finished_) {
    stop_if_interrupted();
    try {
      if (!watches_.empty() && !interrupted_) show_now();
    } catch (const std::exception&) {
      // no memory for this line: the work continues without it
    }
    wake_.wait_for(lock, std::chrono::milliseconds(50));
  }
}

void Progress::stop_if_interrupted() {
  if (!interrupted_ && interrupted_by_signal()) {
    interrupted_ = true;
    interrupted_at_ = seconds_now();
    if (!watches_.empty()) watches_.back()->cancel();
  }
  // every finished file is complete, so the program may end
  const bool draws = !watches_.empty() && phases_[watches_.size() - 1].draws;
  if (interrupted_ && draws && seconds_now() - interrupted_at_ > 0.5) {
    if (bar_open_) std::fputs("\r\033[K", stderr);
    try {
      on_forced_exit_();
    } catch (const std::exception&) {
      // no memory for the message: the folder shows what is left
    }
    _exit(ExitCode::interrupted);
  }
}

void Progress::show_now() {
  const auto current = watches_.size() - 1;
  const auto at =
      progress_of(phases_, current, watches_.back()->progress(), seconds_now() - phase_began_);
  const std::string label = phases_[current].label + path_text(*watches_.back(), pace_);
  if (show_ == Show::bar) {
    // a line longer than the terminal must not wrap, as "\r" returns to its last row alone
    std::fprintf(stderr, "\r\033[K\033[?7l%s\033[?7h", bar_text(at, label, 40).c_str());
    bar_open_ = true;
  }
  const int tenth = int(at.fraction * 10);
  if (show_ == Show::lines && tenth > tenth_shown_) {
    std::fprintf(stderr, "%d %%  %s%s\n", tenth * 10, label.c_str(), left_text(at).c_str());
    tenth_shown_ = tenth;
  } else if (show_ == Show::lines && label != phases_[current].label &&
             seconds_now() - line_shown_at_ > line_every_s) {
    std::fprintf(stderr, "%s\n", label.c_str());
    line_shown_at_ = seconds_now();
  }
}

Result<void> deliver(const Delivery& made, const std::vector<Phase>& phases, bool quiet,
                     const Work& work, const fs::path& left_there) {
  const InterruptGuard guarded;
  TRY(staged, left_there.empty() ? StagedFolder::create(made.folder, made.command)
                                 : StagedFolder::resume(made.folder, made.command, left_there));
  if (!quiet) report_left_behind(made.folder);
  const auto on_forced_exit = [&] {
    std::fprintf(stderr, "stopped\n%s\n", remove_unfinished_files(staged->path()).c_str());
  };
  Result<void> outcome;
  {
    Progress progress(phases, Progress::show_for(quiet), on_forced_exit);
    outcome = attempt(work, staged->path(), progress);
  }
  if (outcome)
    outcome = staged->commit().map([](const std::string& stayed) {
      if (!stayed.empty()) std::fprintf(stderr, "%s\n", stayed.c_str());
    });
  if (outcome) return {};
  const auto left = remove_unfinished_files(staged->path());
  // an empty staged folder was removed above; without keep() its new parents are removed, too
  if (fs::exists(staged->path())) staged->keep();
  Error& error = outcome.error();
  if (error.fault == Fault::cancelled) error.message = "stopped";
  error.message += "\n" + left;
  return outcome;
}

}  // namespace gridshell::app
