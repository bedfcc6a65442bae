#include "app/delivery.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/console.h"
#include "app/staging.h"

namespace gridshell::app {
namespace fs = std::filesystem;

std::string leave_finished(const fs::path& partial) {
  remove_unfinished(partial);
  int pictures = 0, runs = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator at(partial, error), end; !error && at != end;
       at.increment(error)) {
    pictures += at->path().extension() == ".png";
    runs += at->path().filename() == "summary.json";
  }
  if (pictures + runs == 0) {
    fs::remove_all(partial, error);
    return "nothing was finished, so nothing is left behind";
  }
  const auto count = [](int n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{} and {}, each whole, are in '{}'", count(runs, "run"),
                     count(pictures, "picture"), fs::proximate(partial).string());
}

int deliver(const fs::path& final_folder, const std::vector<Phase>& phases, bool quiet,
            const Work& work) {
  auto staged = StagedFolder::create(final_folder);
  if (!staged) return report(staged.error());
  const auto last_words = [&] {
    std::fprintf(stderr, "stopped\n%s\n", leave_finished(staged->path()).c_str());
  };
  Result<void> outcome;
  {
    Progress progress(phases, Progress::show_for(quiet), last_words);
    outcome = work(staged->path(), progress);
  }
  if (outcome) outcome = staged->commit();
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
