#include "app/window/workspace.h"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("a workspace kept and taken again is the same") {
  Desk desk({});
  desk.show.dark = desk.numbers = true;
  desk.plots = false;
  desk.show.colour_by = ColourBy::energy;
  desk.set_range(0, 3.5);
  desk.camera.azimuth_deg = 12.25;
  desk.camera.target = {1, 2, 3};
  const std::string text = workspace_text(desk);
  Desk again({});
  REQUIRE(take_workspace(again, text));
  CHECK(again.show == desk.show);
  CHECK(again.range_of == RangeOf::hand);
  CHECK((again.numbers && !again.plots));
  REQUIRE(again.kept_view);
  CHECK(again.kept_view->camera == desk.camera);
  CHECK(again.kept_view->colour_by == ColourBy::energy);
}

TEST_CASE("what a workspace says wrongly stays as it is") {
  Desk desk({});
  const window::Show before = desk.show;
  CHECK_FALSE(take_workspace(desk, "not JSON"));
  CHECK_FALSE(take_workspace(desk, "[1]"));
  for (const char* text :
       {"{}", R"({"shown": 3, "colour": [], "camera": null})",
        R"({"shown": {"dark": "yes"}, "colour": {"by": "taste", "range": 7}})",
        R"({"preset": "a", "camera": {"azimuth_deg": 1e300, "elevation_deg": 2}})",
        R"({"colour": {"range": "hand", "low": 2, "high": 1}})"}) {
    INFO(text);
    CHECK(take_workspace(desk, text));
    CHECK(desk.show == before);
    CHECK_FALSE(desk.kept_view);
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
