// The dialog that asks for a file, by keyboard.
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
