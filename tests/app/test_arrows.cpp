// Dependencies between folders have one direction: a table lists who may include whom.
#include <map>
#include <regex>
#include <set>

#include "tests/app/bench.h"

namespace {

using Folders = std::set<std::string>;

// Folders that a folder may include in addition to itself and engine/core. A folder that is not
// listed may include nothing.
const std::map<std::string, Folders> may_see{
    {"engine/core", {}},
    {"engine/geometry", {}},
    {"engine/footprint", {"engine/geometry"}},
    {"engine/elastic", {"engine/footprint"}},
    {"engine/solve", {"engine/footprint", "engine/elastic"}},
    {"engine/formats", {}},
    {"engine/preset", {"engine/formats"}},
    {"engine/record", {"engine/formats", "engine/footprint"}},
    {"engine/scene", {"engine/geometry", "engine/footprint", "engine/elastic", "engine/preset"}},
    {"engine/simulate",
     {"engine/footprint", "engine/elastic", "engine/solve", "engine/record", "engine/scene",
      "engine/preset"}},
    {"engine/study",
     {"engine/footprint", "engine/elastic", "engine/solve", "engine/simulate", "engine/scene",
      "engine/record", "engine/preset"}},
    {"engine/design",
     {"engine/elastic", "engine/solve", "engine/simulate", "engine/scene", "engine/preset"}},
    // the library in one header, through which programs see it
    {"engine",
     {"engine/footprint", "engine/solve", "engine/formats", "engine/preset", "engine/record",
      "engine/scene", "engine/simulate", "engine/study", "engine/design"}},
    // the renderer reads the record of a run, not how it was computed; canvas uses images of gl
    {"render/gl", {"engine/record"}},
    {"render/canvas", {"render/gl"}},
    {"render/movie", {"render/gl", "render/canvas", "engine/record", "engine/preset"}},
    {"app/cli", {"engine", "render/gl", "render/canvas", "render/movie"}},
    {"app/window", {"engine", "render/gl", "render/canvas", "render/movie", "app/cli"}},
    {"app/python", {"engine", "render/gl", "render/movie", "app/cli"}},
    {"app/examples", {"engine"}},
};
constexpr int most_arrows = 45;

// "engine/preset" for engine/preset/preset_file.h, "engine" for engine/gridshell.h
std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

// "file includes file" for every arrow that is not in the table
std::vector<std::string> forbidden_arrows(const std::string& file, const std::string& text) {
  static const std::regex include("#include \"([^\"]+)\"");
  const auto own = folder_of(file);
  const auto allowed = may_see.contains(own) ? may_see.at(own) : Folders{};
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
    const auto seen = folder_of((*at)[1]);
    if (seen == "engine/core" || seen.starts_with("tests")) continue;
    if (seen != own && !allowed.contains(seen))
      found.push_back(file + " includes " + (*at)[1].str());
  }
  return found;
}

}  // namespace

TEST_CASE("the table of arrows has no cycle") {
  // every folder is above all that it includes, so no two include each other
  std::map<std::string, int> height;
  const auto height_of = [&](const auto& self, const std::string& folder, int depth) -> int {
    REQUIRE(depth < 20);
    int highest = 0;
    for (const auto& seen : may_see.at(folder))
      highest = std::max(highest, 1 + self(self, seen, depth + 1));
    return height[folder] = highest;
  };
  int arrows = 0;
  for (const auto& [folder, seen] : may_see) {
    height_of(height_of, folder, 0);
    // includes of engine/core, and those in and of gridshell.h, are not counted
    if (folder != "engine") arrows += int(seen.size() - seen.count("engine"));
  }
  CHECK(arrows <= most_arrows);
  CHECK(height["app/cli"] > height["engine/simulate"]);
}

TEST_CASE("a forbidden arrow is found") {
  CHECK(forbidden_arrows("engine/core/a.h", "#include \"engine/solve/equilibrium_path.h\"\n")
            .size() == 1);
  CHECK(forbidden_arrows("render/gl/a.cpp", "#include \"engine/solve/equilibrium_path.h\"\n")
            .size() == 1);
  CHECK(forbidden_arrows("render/gl/a.cpp", "#include \"engine/record/trajectory.h\"\n").empty());
  CHECK(forbidden_arrows("engine/new/a.h", "#include \"engine/geometry/spline.h\"\n").size() == 1);
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
      "#include "
      "(<(GL|EGL|GLFW|imgui|cairo|pango)[^>]*>|\"render/gl/(context|opengl)\\.h)");
  for (const char* stem :
       {"command", "shell_view", "edit_session", "apply_command", "worker_threads", "shell_drawing",
        "viewer_state", "save_preset", "input_event", "actions", "picker"}) {
    const auto path = root / "app/window" / (std::string(stem) + ".cpp");
    INFO(path);
    CHECK_FALSE(std::regex_search(text_of(path), forbidden));
  }
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
