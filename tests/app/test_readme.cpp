// What the README says is what the program does.
#include <catch2/catch.hpp>
#include <set>

#include "engine/core/atomic_file.h"
#include "engine/preset/writer.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

namespace {

std::string readme() {
  return gridshell::read_whole(std::filesystem::path(GRIDSHELL_SOURCE_DIR) / "README.md").value();
}

}  // namespace

TEST_CASE("the README holds the reference of all keys, word for word") {
  const TemporaryFolder folder;
  const auto printed = gridshell_program({"list", "--keys", "markdown"}, folder.path()).out;
  CHECK(printed == gridshell::preset::reference_markdown());
  // to mend it: paste what 'gridshell list --keys markdown' prints
  CHECK_THAT(readme(), Catch::Contains(printed));
}

TEST_CASE("the README names every command of the program, and no other") {
  const TemporaryFolder folder;
  const auto text = readme();
  const auto help = gridshell_program({"--help"}, folder.path()).out;
  std::set<std::string> in_help, in_readme;
  std::istringstream lines(help.substr(help.find("Subcommands:") + 13));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line[2] != ' ')
      in_help.insert(line.substr(2, line.find(' ', 2) - 2));
  const std::string begin = "| `gridshell ";
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const auto word = at + begin.size();
    in_readme.insert(text.substr(word, text.find_first_of(" `", word) - word));
  }
  CHECK(in_help.size() >= 7);
  CHECK(in_readme == in_help);
}

TEST_CASE("the README's pictures exist") {
  const auto text = readme();
  for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
    const auto target = text.substr(at + 2, text.find(')', at) - at - 2);
    if (target.starts_with("http")) continue;
    INFO(target);
    CHECK(std::filesystem::exists(std::filesystem::path(GRIDSHELL_SOURCE_DIR) / target));
  }
}
