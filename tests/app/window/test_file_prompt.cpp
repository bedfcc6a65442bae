// The dialog that asks for a file, by keyboard, and the groups of the page of presets.
#include "app/window/viewer_state.h"
#include "tests/app/visit.h"

TEST_CASE("letters of a name open the first that has them, and Enter goes into a folder") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "deep");
  for (const char* file : {"deep/mine.toml", "another.toml"})
    REQUIRE(write_file(folder / file, shell));
  const std::string open = "do open_file\nwait 0.1\n";
  CHECK(played(folder, open + "type NOTH\n" + enter)["preset"] == "another");
  const json inside =
      played(folder, open + "type deep\n" + enter + "wait 0.1\ntype mine\n" + enter);
  CHECK(inside["preset"] == "mine");
}

TEST_CASE("presets of the literature and of timber have headings of their own") {
  using gridshell::window::group_of;
  CHECK(group_of("lit_cap") == std::string("Literature"));
  CHECK(group_of("page_literature") == std::string("Literature"));
  CHECK(group_of("page_fig1") == std::string("Pages of the paper"));
  CHECK(group_of("timber_dome") == std::string("Timber"));
  CHECK(group_of("model_snap") == std::string("Models, limits, loads, steps"));
}
