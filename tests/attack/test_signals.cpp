// Signals at any moment of every command: it must end with a documented exit code and lose nothing.
#include <algorithm>
#include <map>

#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "engine/record/journal.h"
#include "render/gl/image.h"
#include "tests/attack/answers.h"
#include "tests/attack/trials.h"
#include "tests/small_preset.h"

namespace fs = std::filesystem;
using gridshell::write_file;

namespace {

const std::string small =
    small_preset({.edges = 0, .frames = 24, .width = 320, .height = 180, .quality = "movie"});

// checks that files with final names are complete
void check_left(const fs::path& folder, bool killed) {
  for (const auto& file : files_under(folder, "")) {
    INFO(file);
    const bool hidden = file.filename().string().starts_with('.');
    if (!killed) CHECK_FALSE(hidden);
    if (file.extension() == ".png" && !hidden) CHECK(gridshell::render::read_png(file));
    if (file.filename() == gridshell::record::journal_name)
      CHECK(gridshell::record::read_journal_of(file.parent_path()));
  }
}

}  // namespace

TEST_CASE("signals at any moment are answered, and nothing is lost", "[standard][signals]") {
  const TemporaryFolder at;
  REQUIRE(write_file(at / "small.toml", small));
  REQUIRE(gridshell_program({"movie", "small.toml", "-o", "old", "--quiet"}, at).code == 0);
  const std::vector<std::vector<std::string>> commands{
      {"run", "small.toml", "-o", "new"},        {"movie", "small.toml", "-o", "old"},
      {"figure", "small.toml", "-o", "new"},     {"render", "old"},
      {"check", "small.toml", "-o", "old"},      {"run", "s1_actuation", "-o", "new"},
      {"figure", "fig1_actuation", "-o", "new"}, {"run", "model_clamped", "-o", "new"},
      {"run", "s3_pole_inward", "-o", "new"},    {"render", "old", "-o", "new"}};
  std::map<int, int> codes;
  double slowest = 0;
  for (int trial = 0; trial < trials(8); ++trial) {
    Draw draw(trial);
    const auto command = draw.of(commands);
    const int number = draw.of(std::vector<int>{SIGINT, SIGTERM, SIGHUP, SIGINT, SIGKILL});
    INFO("trial " << trial << ": " << command[0] << " " << command[1] << ", signal " << number);
    const auto before = contents(at / "old");
    const Running running(command, at);
    running.until_it_listens();
    static const std::vector<double> longest{0.01, 0.1, 0.5, 2};
    std::this_thread::sleep_for(std::chrono::duration<double>(draw.fraction() * draw.of(longest)));
    running.signal(number);
    const auto requested = std::chrono::steady_clock::now();
    const bool answered = running.ends_within(20);
    CHECK(answered);
    slowest = std::max(
        slowest,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - requested).count());
    if (!answered) running.signal(SIGKILL);
    const auto ended = running.wait();
    INFO(ended.code << ": " << ended.err.substr(0, 1000));
    ++codes[ended.code];
    const bool killed = number == SIGKILL;
    CHECK((ended.code == 0 || ended.code == (killed ? 128 + SIGKILL : 130)));
    // the old folder is replaced by a complete one, or unchanged
    CHECK(gridshell::app::why_not_a_run(at / "old").empty());
    if (ended.code != 0 && !killed) CHECK(contents(at / "old") == before);
    check_left(at, killed);
    clear(at, {"small.toml", "old"}, [](const auto& name) {
      return name == "new" || name.find(".partial-") != name.npos ||
             name.find(".old-") != name.npos;
    });
  }
  print_codes(codes, "slowest answer " + std::to_string(slowest) + " s; codes");
}
