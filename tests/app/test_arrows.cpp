// Arrows between folders go one way: who may include whom stands in one table.
#include <map>
#include <regex>
#include <set>

#include "tests/app/bench.h"

namespace {

using Folders = std::set<std::string>;

// What a folder may see beside itself. A folder that is not here may see nothing; `render/` and
// `app/` stand for every folder in them, but for `app/window`, `app/python` and `app/examples`.
const std::map<std::string, Folders> may_see{
    {"engine/core", {}},
    {"engine/geometry", {"engine/core"}},
    {"engine/footprint", {"engine/core", "engine/geometry"}},
    {"engine/rod", {"engine/core"}},
    {"engine/gridshell", {"engine/core", "engine/footprint", "engine/rod"}},
    {"engine/solve", {"engine/core", "engine/footprint", "engine/rod", "engine/gridshell"}},
    {"engine/measure", {"engine/core", "engine/geometry", "engine/footprint"}},
    {"engine/preset", {"engine/core"}},
    {"engine/record", {"engine/core", "engine/rod"}},
    // scans against the joints of runs
    {"engine/scan", {"engine/core", "engine/geometry", "engine/record"}},
    // runs and footprints as files of other programs
    {"engine/export", {"engine/core", "engine/record"}},
    // what will be formed, and no solver
    {"engine/scene",
     {"engine/core", "engine/geometry", "engine/footprint", "engine/rod", "engine/gridshell",
      "engine/preset"}},
    // a shell in hand
    {"engine/session",
     {"engine/core", "engine/footprint", "engine/rod", "engine/gridshell", "engine/solve",
      "engine/scene", "engine/preset"}},
    // the one entry point of the engine joins the rest
    {"engine/experiment",
     {"engine/core", "engine/geometry", "engine/footprint", "engine/rod", "engine/gridshell",
      "engine/solve", "engine/measure", "engine/preset", "engine/record", "engine/export",
      "engine/scene", "engine/session"}},
    // what is moved so that a shell meets its surface, from the states that experiments reach
    {"engine/design",
     {"engine/core", "engine/geometry", "engine/footprint", "engine/rod", "engine/gridshell",
      "engine/solve", "engine/preset", "engine/scene", "engine/session", "engine/experiment"}},
    // methods compared, the engine's own among them, on the scenes of experiments
    {"engine/study",
     {"engine/core", "engine/footprint", "engine/rod", "engine/gridshell", "engine/solve",
      "engine/measure", "engine/preset", "engine/record", "engine/scene", "engine/session",
      "engine/experiment"}},
    // the library in one header, and what others write with it
    {"engine/gridshell.h",
     {"engine/core", "engine/measure", "engine/preset", "engine/record", "engine/scan",
      "engine/scene", "engine/session", "engine/experiment", "engine/design"}},
    {"app/examples", {"engine/gridshell.h"}},
    // the renderer knows pictures of a run, not how it came to be
    {"render", {"engine/core", "engine/record", "engine/export"}},
    // what the desktop window knows and does, with a shell in hand
    {"app/window",
     {"engine/core", "engine/footprint", "engine/solve", "engine/measure", "engine/preset",
      "engine/record", "engine/scene", "engine/session", "engine/experiment", "engine/design",
      "render"}},
    {"app",
     {"engine/core", "engine/preset", "engine/record", "engine/export", "engine/experiment",
      "engine/design", "engine/study", "engine/scan", "render", "app/window"}},
    // a session in Python's hand, with the program's presets, runs and pictures
    {"app/python",
     {"engine/core", "engine/preset", "engine/record", "engine/session", "engine/experiment",
      "render", "app"}},
};

// "engine/preset" for engine/preset/reader.h, "render" and "app" for all below them
std::string folder_of(const std::string& path) {
  for (const char* own : {"app/window", "app/python", "app/examples"})
    if (path.starts_with(std::string(own) + "/")) return own;
  if (!path.starts_with("engine/")) return path.substr(0, path.find('/'));
  return path.substr(0, path.find('/', 7));
}

// "file includes file" for every arrow that is not in the table
std::vector<std::string> forbidden_arrows(const std::string& file, const std::string& text) {
  static const std::regex include("#include \"([^\"]+)\"");
  const auto own = folder_of(file);
  const auto allowed = may_see.contains(own) ? may_see.at(own) : Folders{};
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
    const auto seen = folder_of((*at)[1]);
    if (seen != own && !allowed.contains(seen))
      found.push_back(file + " includes " + (*at)[1].str());
  }
  return found;
}

}  // namespace

TEST_CASE("the table of arrows has no way round") {
  // every folder stands above all it sees, so no two see each other
  std::map<std::string, int> height;
  const auto height_of = [&](const auto& self, const std::string& folder, int depth) -> int {
    REQUIRE(depth < 20);
    int highest = 0;
    for (const auto& seen : may_see.at(folder))
      highest = std::max(highest, 1 + self(self, seen, depth + 1));
    return height[folder] = highest;
  };
  for (const auto& [folder, seen] : may_see) height_of(height_of, folder, 0);
  CHECK(height["engine/core"] == 0);
  CHECK(height["app"] > height["engine/experiment"]);
}

TEST_CASE("a forbidden arrow is found") {
  CHECK(forbidden_arrows("engine/core/a.h", "#include \"engine/solve/path.h\"\n").size() == 1);
  CHECK(forbidden_arrows("render/draw/a.cpp", "#include \"engine/solve/path.h\"\n").size() == 1);
  CHECK(forbidden_arrows("render/draw/a.cpp", "#include \"engine/record/snapshot.h\"\n").empty());
  CHECK(forbidden_arrows("engine/new/a.h", "#include \"engine/core/result.h\"\n").size() == 1);
}

TEST_CASE("every include follows the arrows") {
  const fs::path root = GRIDSHELL_SOURCE_DIR;
  std::vector<std::string> found;
  int files = 0;
  for (const char* top : {"engine", "render", "app"})
    for (const char* ending : {".h", ".cpp"})
      for (const auto& path : files_under(root / top, ending)) {
        const auto more =
            forbidden_arrows(fs::relative(path, root).generic_string(), text_of(path));
        found.insert(found.end(), more.begin(), more.end());
        ++files;
      }
  CHECK(files > 50);
  CHECK(found == std::vector<std::string>{});
}

TEST_CASE("what the window knows has no OpenGL and no interface library in it") {
  const fs::path root = GRIDSHELL_SOURCE_DIR;
  static const std::regex forbidden(
      "#include (<(GL|EGL|GLFW|imgui|cairo|pango)[^>]*>|\"render/(gl|context)/)");
  int files = 0;
  for (const char* ending : {".h", ".cpp"})
    for (const auto& path : files_under(root / "app/window", ending)) {
      INFO(path);
      CHECK_FALSE(std::regex_search(text_of(path), forbidden));
      ++files;
    }
  CHECK(files > 10);
}

TEST_CASE("the engine knows no OpenGL, no window and does not print") {
  const fs::path root = GRIDSHELL_SOURCE_DIR;
  static const std::regex forbidden(
      "#include "
      "<(GL|EGL|GLFW|imgui|iostream|cairo|pango)[^>]*>|\\bprintf\\(|fmt::print\\(|std::cout|std::"
      "cerr|\\bputs\\(");
  for (const char* ending : {".h", ".cpp"})
    for (const auto& path : files_under(root / "engine", ending)) {
      INFO(path);
      CHECK_FALSE(std::regex_search(text_of(path), forbidden));
    }
}
