// What is stored until the next start.
#include "app/window/workspace.h"

#include <catch2/catch.hpp>

#include "tests/environment.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;
namespace fs = std::filesystem;

TEST_CASE("a workspace kept and taken again is the same") {
  ViewerState viewer({});
  viewer.show.dark = viewer.numbers = true;
  viewer.plots = false;
  viewer.show.colour_by = ColourBy::energy;
  viewer.set_range(0, 3.5);
  viewer.camera.azimuth_deg = 12.25;
  viewer.camera.target = {1, 2, 3};
  viewer.recent = {"s1_actuation", "/tmp/a b.toml"};
  viewer.last_folders[0] = "/tmp/saved", viewer.last_folders[1] = "/tmp/opened";
  const std::string text = workspace_text(viewer);
  ViewerState again({});
  REQUIRE(take_workspace(again, text));
  CHECK(again.show == viewer.show);
  CHECK(again.range_of == RangeOf::hand);
  CHECK((again.numbers && !again.plots));
  CHECK(again.recent == viewer.recent);
  CHECK((again.last_folders[0] == "/tmp/saved" && again.last_folders[1] == "/tmp/opened"));
  REQUIRE(again.saved_camera);
  CHECK(again.saved_camera->camera == viewer.camera);
  CHECK(again.saved_camera->colour_by == ColourBy::energy);
}

TEST_CASE("what a workspace says wrongly stays as it is") {
  ViewerState viewer({});
  const Show before = viewer.show;
  CHECK_FALSE(take_workspace(viewer, "not JSON"));
  CHECK_FALSE(take_workspace(viewer, "[1]"));
  for (const char* text :
       {"{}", R"({"shown": 3, "colour": [], "camera": null})",
        R"({"shown": {"dark": "yes"}, "colour": {"by": "taste", "range": 7}})",
        R"({"preset": "a", "camera": {"azimuth_deg": 1e300, "elevation_deg": 2}})",
        R"({"colour": {"range": "hand", "low": 2, "high": 1}})"}) {
    INFO(text);
    CHECK(take_workspace(viewer, text));
    CHECK(viewer.show == before);
    CHECK_FALSE(viewer.saved_camera);
  }
}

TEST_CASE("the workspace's file is below the folder of states") {
  for (const auto& [states, below] : {std::pair("/tmp/states", true), {"relative", false}}) {
    const Environment home("XDG_STATE_HOME", states);
    CHECK((workspace_file() == fs::path(states) / "gridshell/workspace.json") == below);
  }
}
