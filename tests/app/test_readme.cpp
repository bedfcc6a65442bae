// What the READMEs say is what the program does.
#include <set>

#include "engine/preset/preset_file.h"
#include "tests/app/bench.h"

namespace {

const fs::path root = GRIDSHELL_SOURCE_DIR;

// those at the top and one a folder that has one
std::vector<fs::path> documents() {
  std::vector<fs::path> found{"README.md", "CONTRIBUTING.md", "CHANGELOG.md"};
  for (const auto& entry : fs::directory_iterator(root))
    if (fs::exists(entry.path() / "README.md"))
      found.push_back(entry.path().filename() / "README.md");
  return found;
}

// the commands in the rows of a table, "| `gridshell COMMAND"
std::set<std::string> commands_in(const std::string& text) {
  std::set<std::string> found;
  const std::string begin = "| `gridshell ";
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const auto word = at + begin.size();
    found.insert(text.substr(word, text.find_first_of(" `", word) - word));
  }
  return found;
}

}  // namespace

TEST_CASE("presets/README.md holds the reference of all keys, word for word") {
  const TemporaryFolder folder;
  const auto printed = gridshell_program("list --keys markdown", folder).out;
  CHECK(printed == gridshell::preset::reference_markdown());
  // to mend it: paste what 'gridshell list --keys markdown' prints
  CHECK_THAT(text_of(root / "presets/README.md"), Contains(printed));
}

TEST_CASE("the READMEs name every command of the program, and no other") {
  const TemporaryFolder folder;
  const auto help = gridshell_program("--help", folder).out;
  std::set<std::string> in_help;
  std::istringstream lines(help.substr(help.find("Subcommands:") + 13));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line[2] != ' ')
      in_help.insert(line.substr(2, line.find(' ', 2) - 2));
  CHECK(in_help.size() >= 7);
  CHECK(commands_in(text_of(root / "README.md")) == in_help);
  CHECK(commands_in(text_of(root / "app/README.md")) == in_help);
}

TEST_CASE("the README names every preset, and is short") {
  const auto text = text_of(root / "README.md");
  for (const auto& file : files_under(root / "presets", ".toml")) {
    std::string quoted = "`";
    quoted.append(file.stem().string()).append("`");
    CHECK_THAT(text, Contains(quoted));
  }
  CHECK(std::count(text.begin(), text.end(), '\n') < 200);
}

TEST_CASE("the presets shown in the READMEs run", "[standard]") {
  for (const char* document : {"README.md", "presets/README.md"}) {
    const TemporaryFolder folder;
    const auto text = text_of(root / document);
    // an indented block from its title to the first line that is not indented
    std::istringstream lines(text.substr(text.find("    title = ")));
    std::string preset;
    for (std::string line; std::getline(lines, line) && (line.empty() || line[0] == ' ');)
      preset += line.empty() ? "\n" : line.substr(4) + "\n";
    REQUIRE(write_file(folder / "shown.toml", preset));
    const auto ended = gridshell_program("run shown.toml --quiet", folder);
    INFO(document << ":\n" << preset << ended.err);
    CHECK(ended.code == 0);
  }
}

TEST_CASE("pictures and pages that the READMEs point to exist") {
  for (const auto& document : documents()) {
    const auto text = text_of(root / document);
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const auto target = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (target.starts_with("http")) continue;
      INFO(document << " points to " << target);
      CHECK(fs::exists((root / document).parent_path() / target));
    }
  }
}

TEST_CASE("every preset has its picture for the window, and no picture stands without one") {
  const auto stems = [](const fs::path& folder, const char* ending) {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(root / folder))
      if (file.path().extension() == ending) names.insert(file.path().stem().string());
    return names;
  };
  // drawn by presets/pictures/cards.sh
  CHECK(stems("presets/pictures/cards", ".png") == stems("presets", ".toml"));
}
