// Descriptions of the program by itself: JSON, completion, manual page; the bar of its progress.
#include <cmath>
#include <set>

#include "app/cli/commands.h"
#include "app/cli/delivery.h"
#include "app/cli/preset_library.h"
#include "app/window/manual.h"
#include "engine/core/json.h"
#include "engine/preset/preset_file.h"
#include "tests/app/bench.h"

using namespace gridshell;

namespace {

/// Completions that bash offers for the last of these words.
std::set<std::string> offered(const std::vector<std::string>& words, const fs::path& at) {
  std::ofstream(at / "completion") << app::bash_completion();
  std::ofstream script(at / "try.sh");
  script << "source ./completion\nCOMP_WORDS=(";
  for (const auto& word : words) script << "'" << word << "' ";
  script << ")\nCOMP_CWORD=" << words.size() - 1
         << "\n_gridshell\nprintf '%s\\n' \"${COMPREPLY[@]}\" > offered\n";
  script.close();
  REQUIRE(std::system(("cd '" + at.string() + "' && bash try.sh 2> /dev/null").c_str()) == 0);
  std::ifstream lines(at / "offered");
  std::set<std::string> all;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) all.insert(line);
  return all;
}

}  // namespace

TEST_CASE("list --json has every command, preset and key") {
  const TemporaryFolder folder;
  const auto printed = good("list --json", folder);
  CHECK(printed.out == app::listing_json().value());
  const auto json = parsed(printed.out);
  REQUIRE(json.is_object());
  CHECK(json["presets"].size() == app::embedded_presets().size());
  CHECK(json["keys"].size() == preset::key_texts().size());
  CHECK(json["commands"].size() == app::command_table().size());
  const auto movie = std::ranges::find_if(
      json["commands"], [](const auto& command) { return command["name"] == "movie"; });
  REQUIRE(movie != json["commands"].end());
  const auto option = [&](const std::string& name) {
    const auto& all = (*movie)["options"];
    const auto found =
        std::ranges::find_if(all, [&](const auto& one) { return one["name"] == name; });
    REQUIRE(found != all.end());
    return *found;
  };
  CHECK(option("PRESET")["argument"] == true);
  CHECK(option("PRESET")["required"] == true);
  CHECK(option("--output")["short"] == "-o");
  CHECK(option("--quiet")["flag"] == true);
  CHECK(option("--context")["words"].size() == 4);
  CHECK(option("--set")["many"] == true);
}

TEST_CASE("bash completes commands, options, their words, presets and keys") {
  const TemporaryFolder folder;
  const auto of = [&](const std::vector<std::string>& words) { return offered(words, folder); };
  CHECK(of({"gridshell", "mo"}) == std::set<std::string>{"modes", "movie"});
  CHECK(of({"gridshell", "movie", "s1_a"}) == std::set<std::string>{"s1_actuation"});
  CHECK(of({"gridshell", "movie", "s1_actuation", "--con"}) == std::set<std::string>{"--context"});
  CHECK(of({"gridshell", "render", "run", "--context", "o"}) == std::set<std::string>{"osmesa"});
  CHECK(of({"gridshell", "run", "x", "--set", "joints.he"}) ==
        std::set<std::string>{"joints.height_mm="});
  CHECK(of({"gridshell", "render", "s1"}).empty());
  CHECK(of({"gridshell", "movie", "x", "-o", "s1"}).empty());
}

TEST_CASE("the manual page names all commands, options, presets and keys, and roff takes it") {
  const std::string page = window::man_page().value();
  for (const auto& command : app::command_table()) {
    CHECK_THAT(page, Contains(".SS \"gridshell " + command.name));
    for (const auto& option : command.options)
      if (!option.argument)
        CHECK_THAT(page, Contains("\\-\\-" + option.name.substr(2, option.name.find('-', 2) - 2)));
  }
  for (const auto& preset : app::embedded_presets())
    CHECK_THAT(page, Contains("\\fB" + preset.name + "\\fR"));
  for (const auto& key : preset::key_texts()) CHECK_THAT(page, Contains("\\fB" + key.key + "\\fR"));
  if (std::system("command -v groff > /dev/null") != 0) return;
  const TemporaryFolder folder;
  std::ofstream(folder / "gridshell.1") << page;
  REQUIRE(std::system(("cd '" + folder.path().string() +
                       "' && groff -man -Kutf8 -Tutf8 -ww gridshell.1 > out 2> faults")
                          .c_str()) == 0);
  CHECK(text_of(folder / "faults").empty());
}

TEST_CASE("the bar counts evenly over phases by their expected time") {
  const std::vector<app::Phase> phases{{"simulating", 10}, {"drawing", 90}};
  CHECK(app::progress_of(phases, 0, 0.0, 0).fraction == 0.0);
  CHECK(app::progress_of(phases, 0, 0.5, 5).fraction == Approx(0.05));
  CHECK(app::progress_of(phases, 1, 0.0, 0).fraction == Approx(0.10));
  CHECK(app::progress_of(phases, 1, 0.5, 45).fraction == Approx(0.55));
  CHECK(app::progress_of(phases, 1, 1.0, 90).fraction == Approx(1.0));
}

TEST_CASE("the time left follows how fast the work turns out") {
  const std::vector<app::Phase> phases{{"simulating", 10}, {"drawing", 90}};
  // as expected: 5 s of this phase and 90 s of the next
  CHECK(app::progress_of(phases, 0, 0.5, 5).seconds_left == Approx(95));
  // twice as slow
  CHECK(app::progress_of(phases, 0, 0.5, 10).seconds_left == Approx(190));
  CHECK(app::progress_of(phases, 1, 0.25, 20).seconds_left == Approx(60));
  // too early for an estimate
  CHECK(std::isnan(app::progress_of(phases, 1, 0.01, 1).seconds_left));
  CHECK(std::isnan(app::progress_of(phases, 1, 0.5, 0.1).seconds_left));
}

TEST_CASE("a phase that was not announced is one more of the last") {
  const TemporaryFolder folder;
  const int kept = dup(STDERR_FILENO),
            file = open((folder / "err").c_str(), O_CREAT | O_WRONLY, 0600);
  REQUIRE((kept >= 0 && file >= 0 && dup2(file, STDERR_FILENO) >= 0));
  bool shown = true, cancelled = false;
  {
    app::Progress progress({{"simulating", 1}}, app::Progress::Show::lines, [] {});
    for (const auto& [fraction, lines] : {std::pair{0.4, 1}, {0.3, 2}, {0.6, 3}}) {
      Watch& watch = progress.next_phase();
      watch.report(fraction);
      shown &= wait_until([&] {
        const auto text = text_of(folder / "err");
        return std::ranges::count(text, '\n') == lines;
      });
      cancelled |= watch.cancelled();
    }
  }
  std::fflush(stderr);
  dup2(kept, STDERR_FILENO);
  close(kept), close(file);
  const auto text = text_of(folder / "err");
  CAPTURE(text);
  CHECK(shown);
  CHECK_FALSE(cancelled);
  // 0.4 of one phase, 1.3 of two, 2.6 of three
  for (const char* line : {"40 %  simulating", "\n60 %  simulating", "\n80 %  simulating"})
    CHECK_THAT(text, Contains(line));
}

TEST_CASE("the time left on a path follows the pace of its mesh, and is not known at first") {
  app::PathPace pace;
  CHECK(std::isnan(pace.seconds_left({0.1, 4}, 10)));
  CHECK(std::isnan(pace.seconds_left({0.11, 4}, 20)));
  CHECK(pace.seconds_left({0.6, 4}, 20) == Approx(8));
  // on a finer mesh, and on another path of it
  CHECK(std::isnan(pace.seconds_left({0.2, 8}, 30)));
  CHECK(pace.seconds_left({0.4, 8}, 40) == Approx(30));
  CHECK(std::isnan(pace.seconds_left({0.1, 8}, 50)));
}

TEST_CASE("the bar shows share, work and time left") {
  CHECK(app::bar_text({0.5, 125}, "drawing", 10) == "[=====>    ]  50 %  drawing, 2:05 left");
  CHECK(app::bar_text({0, NAN}, "simulating", 4) == "[>   ]   0 %  simulating");
  CHECK(app::bar_text({1, 0}, "drawing", 4) == "[====] 100 %  drawing");
  CHECK(app::bar_text({0.25, 4000}, "drawing", 4) == "[=>  ]  25 %  drawing, 1:06:40 left");
}
