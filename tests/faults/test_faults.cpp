// Every write, rename, mkdir and solve of a small run fails once, and a thousand allocations: then
// the old run is unchanged or the new one is complete, and so is whatever else is left.
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "app/cli/console.h"
#include "app/cli/produce.h"
#include "app/cli/staged_folder.h"
#include "app/window/worker_threads.h"
#include "engine/core/file_io.h"
#include "engine/record/journal.h"
#include "engine/record/summary.h"
#include "engine/record/sweep_results.h"
#include "engine/record/trajectory_file.h"
#include "render/gl/image.h"
#include "tests/faults/faults.h"
#include "tests/presets.h"
#include "tests/small_preset.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using namespace gridshell;

namespace {

const std::string small = small_preset(
    {.rods = 2, .radius_mm = 25, .actuated_mm = 22, .frames = 2, .width = 48, .height = 32});

/// result of the program in a process of its own: its exit code, or 128 + the signal that ended it,
/// and the number of calls that it made
struct Outcome {
  int code = 0;
  long calls = 0;
};

Outcome produce_failing(const fs::path& folder, app::Pictures pictures, Call kind, long k) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  std::fflush(stdout);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr) ||
        chdir(folder.c_str()) != 0)
      _exit(99);
    app::Options options;
    options.input = "small.toml";
    options.output = "run";
    options.threads = 1;
    int code = 99;
    // the program does this first, too
    app::install_terminate_handler();
    fail_call(kind, k);
    try {
      code = app::report(app::produce(options, pictures));
    } catch (const std::exception& error) {
      code = app::report_exception(error);
    }
    const long calls = calls_counted();
    fail_call(kind, 0);
    if (::write(ends[1], &calls, sizeof calls) < 0) code = 99;
    _exit(code);
  }
  close(ends[1]);
  Outcome outcome;
  if (read(ends[0], &outcome.calls, sizeof outcome.calls) != sizeof outcome.calls)
    outcome.calls = 0;
  close(ends[0]);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

/// checks that no file with a final name is half-written
void check_whole(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto& path = entry.path();
    INFO(path);
    if (path.filename().string().starts_with('.')) continue;
    if (path.extension() == ".png") CHECK(render::read_png(path));
    if (path.extension() == ".h5") CHECK(record::read_trajectory(path, {.trial = false}));
    if (path.filename() == "summary.json") CHECK(record::read_summary(path));
    if (path.extension() == ".csv") CHECK(read_file(path).value().ends_with('\n'));
  }
}

class FailingRun {
 public:
  explicit FailingRun(app::Pictures pictures, const std::string& preset = small)
      : pictures_(pictures) {
    REQUIRE(write_file(at_ / "small.toml", preset));
    const auto first = produce_failing(at_, pictures, Call::mkdir, 0);
    REQUIRE(first.code == 0);
    before_ = contents(at_ / "run");
    state_ = record::read_summary(at_ / "run/summary.json").value();
  }

  /// how many calls of a kind a run makes
  long count(Call kind) const {
    const auto all = produce_failing(at_, pictures_, kind, 0);
    REQUIRE(all.code == 0);
    return all.calls;
  }

  /// makes the k-th call fail, and checks the files that are left
  void try_out(Call kind, long k) const {
    INFO("kind " << int(kind) << ", call " << k);
    // the old run has another title, which distinguishes the two
    REQUIRE(write_file(at_ / "run/preset.toml", "old"));
    const auto old = contents(at_ / "run");
    const auto outcome = produce_failing(at_, pictures_, kind, k);
    CHECK(outcome.code <= 2);
    const auto now = contents(at_ / "run");
    CHECK(app::why_not_a_run(at_ / "run").empty());
    if (outcome.code == 0)
      CHECK(now.at("preset.toml") == before_.at("preset.toml"));
    else
      CHECK((now == old || now.at("preset.toml") == before_.at("preset.toml")));
    check_whole(at_ / "run");
    if (outcome.code == 0) check_state();
    for (const auto& entry : fs::directory_iterator(at_)) {
      const auto name = entry.path().filename().string();
      if (name == "run" || name == "small.toml") continue;
      INFO(name);
      REQUIRE((name.starts_with("run.partial-") || name.starts_with("run.old-")));
      if (name.starts_with("run.partial-")) check_whole(entry.path());
      fs::remove_all(entry.path());
    }
  }

  /// every call of these kinds fails once, of more than so many each
  void try_out_all(std::initializer_list<Call> kinds, long more_than) const {
    for (const Call kind : kinds) {
      const long calls = count(kind);
      CHECK(calls > more_than);
      for (long k = 1; k <= calls; ++k) try_out(kind, k);
    }
  }

 private:
  /// a run that reports success reaches the same equilibrium as an undisturbed one
  void check_state() const {
    const auto state = record::read_summary(at_ / "run/summary.json").value();
    CHECK(state.finished);
    CHECK(state.stable);
    // the last corrections, which remove round-off alone, may have failed
    CHECK(state.residual_N < 1e-5);
    CHECK(state.energies.total() == Approx(state_.energies.total()).epsilon(1e-9));
  }

  TemporaryFolder folder_;
  fs::path at_ = folder_.path();
  app::Pictures pictures_;
  std::map<std::string, std::string> before_;
  record::Summary state_;
};

}  // namespace

TEST_CASE("every write, rename and mkdir of a run fails once, and nothing is lost", "[standard]") {
  FailingRun(app::Pictures::none).try_out_all({Call::write, Call::rename, Call::mkdir}, 0);
}

TEST_CASE("a point of a sweep that cannot be synchronised with the disk is not in its log") {
  const TemporaryFolder folder;
  const fs::path file = folder / "sweep.jsonl";
  auto log = record::SweepLog::open(file, {"a preset", 1, 2}, {},
                                    [](std::size_t) { return record::PointKeys{}; });
  REQUIRE(log);
  record::PointResult point;
  REQUIRE(log->append(point));
  const std::string before = read_file(file).value();
  point.point = 1;
  fail_call(Call::sync, 1);
  const auto failed = log->append(point);
  fail_call(Call::sync, 0);
  CHECK_FALSE(failed);
  CHECK(read_file(file).value() == before);
  REQUIRE(log->append(point));
  CHECK(record::read_sweep_log(file)->found.size() == 2);
}

TEST_CASE("every call and solve of a movie fails once, and nothing is lost or false", "[full]") {
  const FailingRun run(app::Pictures::movie);
  run.try_out_all({Call::write, Call::rename, Call::mkdir}, 0);
  run.try_out_all({Call::factorisation, Call::solve}, 20);
}

TEST_CASE("every solve of a push and on the twist model fails once, and nothing false is written",
          "[full]") {
  for (const char* more : {"[indentation]\nat = \"highest\"\ndepth_mm = 0.5\n",
                           "[ends]\nkind = \"clamped\"\n[rod]\nshear_GPa = 31.0\n"})
    FailingRun(app::Pictures::none, small + more)
        .try_out_all({Call::factorisation, Call::solve}, 20);
}

TEST_CASE("allocations of a run fail, and nothing is lost", "[full]") {
  const FailingRun run(app::Pictures::none);
  const long calls = run.count(Call::allocation);
  CHECK(calls > 1000);
  for (long k = 1; k <= 500; ++k) run.try_out(Call::allocation, k);
  std::mt19937 random(13);
  std::uniform_int_distribution<long> beyond(501, calls);
  for (int trial = 0; trial < 500; ++trial) run.try_out(Call::allocation, beyond(random));
}

TEST_CASE("an allocation that fails on the window's engine thread ends no window", "[standard]") {
  window::EngineThread engine;
  const auto act = [&](const window::Edit& edit) {
    engine.post({edit});
    engine.wait();
    REQUIRE(engine.shell());
    return engine.shell()->error;
  };
  REQUIRE(act(window::Open{small_shell()}) == "");
  const auto failing = [&](long k) {
    fail_call(Call::allocation, k);
    try {
      engine.post({window::Move{0.9}});
    } catch (const std::bad_alloc&) {
    }
    engine.wait();
    const long calls = calls_counted();
    fail_call(Call::allocation, 0);
    return calls;
  };
  const long calls = failing(0);
  CHECK(calls > 200);
  // the last ones copy what there is to see, outside of all that the session itself catches
  for (long back = 0; back < 60; ++back) {
    REQUIRE(act(window::Move{1}) == "");
    failing(back < 30 ? calls - back : calls * (60 - back) / 31);
  }
  CHECK(act(window::Move{0.95}) == "");
}
