#include "app/window/viewer_state.h"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("a workspace kept and taken again is the same") {
  ViewerState viewer({});
  viewer.show.dark = viewer.numbers = true;
  viewer.plots = false;
  viewer.show.colour_by = ColourBy::energy;
  viewer.set_range(0, 3.5);
  viewer.camera.azimuth_deg = 12.25;
  viewer.camera.target = {1, 2, 3};
  const std::string text = workspace_text(viewer);
  ViewerState again({});
  REQUIRE(take_workspace(again, text));
  CHECK(again.show == viewer.show);
  CHECK(again.range_of == RangeOf::hand);
  CHECK((again.numbers && !again.plots));
  REQUIRE(again.saved_camera);
  CHECK(again.saved_camera->camera == viewer.camera);
  CHECK(again.saved_camera->colour_by == ColourBy::energy);
}

TEST_CASE("what a workspace says wrongly stays as it is") {
  ViewerState viewer({});
  const window::Show before = viewer.show;
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
  const char* old = std::getenv("XDG_STATE_HOME");
  const std::string kept = old ? old : "";
  setenv("XDG_STATE_HOME", "/tmp/states", 1);
  CHECK(workspace_file() == "/tmp/states/gridshell/workspace.json");
  setenv("XDG_STATE_HOME", "relative", 1);
  CHECK(workspace_file() != "relative/gridshell/workspace.json");
  if (old)
    setenv("XDG_STATE_HOME", kept.c_str(), 1);
  else
    unsetenv("XDG_STATE_HOME");
}
