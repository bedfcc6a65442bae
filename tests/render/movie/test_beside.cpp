#include <catch2/catch.hpp>

#include "render/gl/image.h"
#include "render/movie/movie_writer.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

MovieStyle small() {
  MovieStyle style;
  style.size = {480, 270};
  style.title = "two shells";
  return style;
}

}  // namespace

TEST_CASE("cases stand beside one another in frames of the size asked, the longest run decides") {
  const TemporaryFolder folder;
  const record::Trajectory longer = synthetic::dome(3, 2), shorter = synthetic::dome(2, 2);
  test::FakeRenderer renderer;
  Watch watch;
  const auto report = write_side_by_side({{&longer, "a"}, {&shorter, "b"}}, small(), renderer,
                                         folder.path() / "frames", watch);
  REQUIRE(report);
  CHECK(report->frames == 3);
  CHECK(watch.progress() == 1);
  for (int k = 0; k < 3; ++k) {
    const auto picture = read_png(folder.path() / "frames" / frame_name(k));
    REQUIRE(picture);
    CHECK(picture->width == 480);
    CHECK(picture->height == 270);
  }
  CHECK(renderer.outside == 0);
}

TEST_CASE("nothing to show beside one another is refused, a stopped movie keeps whole frames") {
  const TemporaryFolder folder;
  test::FakeRenderer renderer;
  Watch watch;
  CHECK(write_side_by_side({}, small(), renderer, folder.path(), watch).error().fault ==
        Fault::bad_input);
  const record::Trajectory run = synthetic::dome(3, 2);
  watch.cancel();
  CHECK(write_side_by_side({{&run, "a"}}, small(), renderer, folder.path(), watch).error().fault ==
        Fault::cancelled);
}
