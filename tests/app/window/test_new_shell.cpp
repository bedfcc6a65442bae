// The preset that the form of a new shell writes.
#include "app/window/new_shell.h"
#include "tests/presets.h"

using namespace gridshell;

TEST_CASE("the path of a drawing may have any letter") {
  window::NewShell shell;
  shell.boundary = 3;
  for (const char* file : {"it's.dxf", "C:\\plan.svg", "a \"b\".obj", "Straße.dxf"}) {
    shell.file = file;
    // the preset is read as far as the file, which does not exist
    const std::string why = preset::errors_of(shell.preset());
    INFO(why);
    CHECK_THAT(why, Catch::Contains(std::string("cannot read '") + file + "'"));
  }
}
