// What is made of the program's own tables: JSON, completion, manual page.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/preset_library.h"
#include "app/cli/reference.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/preset/preset_file.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// What bash would offer for the last of these words.
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
  const auto printed = gridshell_program({"list", "--json"}, folder.path());
  REQUIRE(printed.code == 0);
  CHECK(printed.out == app::listing_json().value());
  const auto json = record::parsed(printed.out);
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
  const auto of = [&](const std::vector<std::string>& words) {
    return offered(words, folder.path());
  };
  CHECK(of({"gridshell", "mo"}) == std::set<std::string>{"movie"});
  CHECK(of({"gridshell", "movie", "s1_a"}) == std::set<std::string>{"s1_actuation"});
  CHECK(of({"gridshell", "movie", "s1_actuation", "--con"}) == std::set<std::string>{"--context"});
  CHECK(of({"gridshell", "render", "run", "--context", "o"}) == std::set<std::string>{"osmesa"});
  CHECK(of({"gridshell", "run", "x", "--set", "joints.he"}) ==
        std::set<std::string>{"joints.height_mm="});
  CHECK(of({"gridshell", "render", "s1"}).empty());
  CHECK(of({"gridshell", "movie", "x", "-o", "s1"}).empty());
}

TEST_CASE("the manual page names all commands, options, presets and keys, and roff takes it") {
  const std::string page = app::man_page().value();
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
  std::ofstream(folder.path() / "gridshell.1") << page;
  REQUIRE(std::system(("cd '" + folder.path().string() +
                       "' && groff -man -Kutf8 -Tutf8 -ww gridshell.1 > out 2> faults")
                          .c_str()) == 0);
  CHECK(read_file(folder.path() / "faults").value().empty());
}
