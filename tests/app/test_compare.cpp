// `gridshell compare`: where it writes the differences.
#include "render/gl/image.h"
#include "tests/app/bench.h"

using namespace gridshell;

TEST_CASE("the picture of differences is written into a folder that is new") {
  const TemporaryFolder at;
  for (const char* folder : {"a", "b"}) {
    fs::create_directories(at / folder);
    render::Image picture(16, 16);
    picture.rgba.assign(picture.rgba.size(), folder[0] == 'a' ? 0 : 255);
    REQUIRE(render::write_png(picture, at / folder / "one.png"));
  }
  CHECK(gridshell_program("compare a/one.png b/one.png --difference new/of/two.png", at).code == 3);
  CHECK(render::read_png(at / "new/of/two.png"));
  CHECK(gridshell_program("compare a b --difference sheets/all.png", at).code == 3);
  CHECK(render::read_png(at / "sheets/all.png"));
}
