// The pages agree with the program, and their links lead to something.
#include <set>

#include "engine/preset/preset_file.h"
#include "tests/app/bench.h"

namespace {

const fs::path root = GRIDSHELL_SOURCE_DIR;

// Paths of all pages, relative to the top folder.
std::vector<fs::path> documents() {
  std::vector<fs::path> found{"README.md", "CONTRIBUTING.md", "CHANGELOG.md"};
  for (const char* folder : {"app", "engine", "presets", "render"})
    for (const auto& page : files_under(root / folder, ".md"))
      found.push_back(fs::relative(page, root));
  return found;
}

// The anchor that GitHub gives to a section of that title.
std::string anchor_of(const std::string& title) {
  std::string anchor;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80))
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ' || c == '-')
      anchor += '-';
  return anchor;
}

// Whether a page has a section of that anchor.
bool has_section(const std::string& text, const std::string& anchor) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#") && anchor_of(line.substr(line.find(' ') + 1)) == anchor) return true;
  return false;
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

TEST_CASE("presets/README.md contains the reference of all keys, word for word") {
  const TemporaryFolder folder;
  const auto printed = gridshell_program("list --keys markdown", folder).out;
  CHECK(printed == gridshell::preset::reference_markdown());
  // to mend it: paste what 'gridshell list --keys markdown' prints
  CHECK_THAT(text_of(root / "presets/README.md"), Contains(printed));
}

TEST_CASE("app/README.md names every command of the program, and no other") {
  const TemporaryFolder folder;
  const auto help = gridshell_program("--help", folder).out;
  std::set<std::string> in_help;
  std::istringstream lines(help.substr(help.find("Subcommands:") + 13));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line[2] != ' ')
      in_help.insert(line.substr(2, line.find(' ', 2) - 2));
  CHECK(in_help.size() >= 7);
  CHECK(commands_in(text_of(root / "app/README.md")) == in_help);
}

TEST_CASE("the gallery of the manual names every preset and shows its picture") {
  const auto text = text_of(root / "app/manual/gallery.md");
  for (const auto& file : files_under(root / "presets", ".toml")) {
    const auto name = file.stem().string();
    CHECK_THAT(text, Contains("`" + name + "`"));
    CHECK_THAT(text, Contains("(../../presets/pictures/cards/" + name + ".png)"));
  }
}

TEST_CASE("pictures, pages and sections that the pages point to exist") {
  for (const auto& document : documents()) {
    const auto text = text_of(root / document);
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const auto link = text.substr(at + 2, text.find(')', at) - at - 2);
      if (link.starts_with("http")) continue;
      const auto target = link.substr(0, link.find('#'));
      INFO(document << " points to " << link);
      const auto page = target.empty() ? root / document : (root / document).parent_path() / target;
      REQUIRE(fs::exists(page));
      if (link.size() > target.size())
        CHECK(has_section(text_of(page), link.substr(target.size() + 1)));
    }
  }
}

TEST_CASE("every picture made for the pages is shown by one") {
  std::string all;
  for (const auto& document : documents()) all += text_of(root / document);
  for (const auto& file : fs::directory_iterator(root / "presets/pictures"))
    if (file.path().extension() == ".png" || file.path().extension() == ".svg")
      CHECK_THAT(all, Contains("pictures/" + file.path().filename().string()));
}

TEST_CASE("every preset has its picture for the window, and every picture its preset") {
  const auto stems = [](const fs::path& folder, const char* ending) {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(root / folder))
      if (file.path().extension() == ending) names.insert(file.path().stem().string());
    return names;
  };
  // drawn by presets/pictures/draw.sh
  CHECK(stems("presets/pictures/cards", ".png") == stems("presets", ".toml"));
}
