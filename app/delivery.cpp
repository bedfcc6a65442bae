#include "app/delivery.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "app/console.h"
#include "app/interrupt.h"
#include "app/staging.h"
#include "engine/record/journal.h"
#include "render/movie/encode.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// what is whole in a folder that was not finished
struct Left {
  int pictures = 0, runs = 0;
  std::size_t frames = 0;  // of runs cut short
};

Left left_in(const fs::path& folder) {
  Left left;
  std::error_code error;
  left.frames = record::frames_in_journal(folder);
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    left.pictures += at->path().extension() == ".png";
    left.runs += at->path().filename() == "summary.json";
    if (at->is_directory(error)) left.frames += record::frames_in_journal(at->path());
  }
  return left;
}

std::string count(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string near_name(const fs::path& folder) {
  std::error_code error;
  return fs::proximate(folder, error).string();
}

// what others left beside the folder to be written, and what may be done with it
void name_left_behind(const fs::path& final_folder) {
  for (const auto& folder : left_behind(final_folder)) {
    const auto name = near_name(folder);
    const auto left = left_in(folder);
    const auto removes = render::shell_line({"rm", "-r", name});
    const bool old = folder.filename().string().find(".old-") != std::string::npos;
    std::string draws;
    if (!old && left.runs + left.frames > 0)
      draws = fmt::format("\n  {}    draws it", render::shell_line({"gridshell", "render", name}));
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

}  // namespace

std::string leave_finished(const fs::path& partial) {
  remove_unfinished(partial);
  const auto left = left_in(partial);
  const auto name = near_name(partial);
  if (left.pictures + left.runs + left.frames == 0) {
    std::error_code error;
    fs::remove_all(partial, error);
    return "nothing was finished, so nothing is left behind";
  }
  if (left.frames == 0)
    return fmt::format("{} and {}, each whole, are in '{}'", count(left.runs, "run"),
                       count(left.pictures, "picture"), name);
  const auto others =
      left.runs + left.pictures == 0
          ? ""
          : fmt::format(", {} and {}", count(left.runs, "run"), count(left.pictures, "picture"));
  return fmt::format("{} of an unfinished run{}, each whole, are in '{}'; this draws them:\n  {}",
                     count(left.frames, "frame"), others, name,
                     render::shell_line({"gridshell", "render", name}));
}

int deliver(const fs::path& final_folder, const std::vector<Phase>& phases, bool quiet,
            const Work& work) {
  const Guarded guarded;
  auto staged = StagedFolder::create(final_folder);
  if (!staged) return report(staged.error());
  if (!quiet) name_left_behind(final_folder);
  const auto last_words = [&] {
    std::fprintf(stderr, "stopped\n%s\n", leave_finished(staged->path()).c_str());
  };
  Result<void> outcome;
  {
    Progress progress(phases, Progress::show_for(quiet), last_words);
    outcome = attempt(work, staged->path(), progress);
  }
  std::string note;
  if (outcome)
    outcome = staged->commit().map([&](std::string stayed) { note = std::move(stayed); });
  if (!note.empty()) std::fprintf(stderr, "%s\n", note.c_str());
  if (outcome) return ExitCode::done;
  const auto left = leave_finished(staged->path());
  // an empty staged folder is gone already; its parents go with it
  if (fs::exists(staged->path())) staged->keep();
  auto error = outcome.error();
  if (error.fault == Fault::cancelled) error.message = "stopped";
  error.message += "\n" + left;
  return report(error);
}

}  // namespace gridshell::app
