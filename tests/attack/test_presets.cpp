// Hostile presets through `check` and `run`: these must end in time, with a documented exit code
// and a message that names the file, use little memory and leave nothing behind.
#include <sys/stat.h>

#include <map>

#include "engine/core/file_io.h"
#include "tests/attack/answers.h"
#include "tests/attack/hostile_preset.h"

namespace fs = std::filesystem;
using gridshell::write_file;

namespace {

// a command that takes too long must answer a signal; that it does so within a second is tested in
// tests/app/test_interrupt.cpp
Ended run_and_stop(const std::vector<std::string>& arguments, const fs::path& folder,
                   double seconds) {
  return ended_within(Running(arguments, folder), seconds, SIGINT);
}

constexpr double allowed_MB = 500;

}  // namespace

TEST_CASE("hostile presets are answered", "[standard][presets]") {
  const TemporaryFolder at;
  REQUIRE(mkfifo((at / "fifo").c_str(), 0600) == 0);
  std::map<int, int> checked, ran;
  for (int trial = 0; trial < trials(12); ++trial) {
    Draw draw(trial);
    const auto preset = hostile_preset(draw);
    INFO("trial " << trial);
    REQUIRE(write_file(at / "hostile.toml", preset));
    // saves the presets, so that one that fails can be looked at
    if (const char* keep = std::getenv("GRIDSHELL_KEEP"))
      REQUIRE(write_file(fs::path(keep) / (std::to_string(trial) + ".toml"), preset));
    const auto seen = run_and_stop({"check", "hostile.toml"}, at, 20);
    INFO("check: " << seen.code << " " << seen.err.substr(0, 500));
    ++checked[seen.code];
    CHECK((seen.code == 0 || seen.code == 2 || seen.code == 130));
    CHECK(seen.peak_MB < allowed_MB);
    if (seen.code == 2) {
      check_message(seen);
      CHECK(seen.err.find("hostile") != std::string::npos);
    }
    // runs all presets that `check` accepts, and some that it refuses
    if (seen.code != 0 && !draw.one_in(20)) continue;
    const auto run = run_and_stop({"run", "hostile.toml", "--frames", "2", "--quiet", "-o", "out",
                                   "--set", "accuracy.memory_GB=0.4"},
                                  at, 10);
    INFO("run: " << run.code << " " << run.err.substr(0, 500));
    ++ran[run.code];
    CHECK((run.code == 0 || run.code == 1 || run.code == 2 || run.code == 130));
    CHECK(run.peak_MB < allowed_MB);
    if (run.code != 0) check_message(run);
    // both refuse the same presets, but `run` has less memory
    if (seen.code == 2) CHECK(run.code == 2);
    if (seen.code == 0 && run.code == 2) CHECK(run.err.find("memory_GB") != std::string::npos);
    CHECK((run.code == 0 || run.code == 1 || !fs::exists(at / "out")));
    clear(at, {"fifo", "hostile.toml"},
          [](const auto& name) { return name == "out" || name.starts_with("out.partial-"); });
  }
  print_codes(checked, "check");
  print_codes(ran, "run");
}
