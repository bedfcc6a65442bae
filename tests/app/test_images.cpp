// Movie S1 against pictures of it that were looked at and kept: four frames, small.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "render/image/compare.h"
#include "render/image/png.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using namespace gridshell;

namespace {

constexpr double threshold = 4;  // of 255: above, a rod is lost or a line moved

std::string frame_name(int frame) { return "frame_0000" + std::to_string(frame) + ".png"; }

render::Image picture(const fs::path& path) {
  auto image = render::read_png(path);
  if (!image) FAIL(image.error().message);
  return std::move(*image);
}

double worst(const render::Image& a, const render::Image& b) {
  const auto comparison = render::compare(a, b);
  if (!comparison) FAIL(comparison.error().message);
  return comparison->difference;
}

}  // namespace

TEST_CASE("movie S1 looks as its kept pictures do") {
  TemporaryFolder folder;
  const Ended ended = Running({"movie", "s1_actuation", "--frames", "4", "--size", "480x270", "-o",
                               "s1", "--quiet"},
                              folder.path())
                          .wait();
  REQUIRE(ended.code == 0);
  const fs::path kept = fs::path(GRIDSHELL_SOURCE_DIR) / "tests/images/s1_actuation";
  for (int frame = 0; frame < 4; ++frame) {
    INFO("frame " << frame);
    const render::Image drawn = picture(folder.path() / "s1/frames" / frame_name(frame));
    CHECK(worst(drawn, picture(kept / frame_name(frame))) <= threshold);
    // the threshold tells a frame from its neighbour
    CHECK(worst(drawn, picture(kept / frame_name((frame + 1) % 4))) > threshold);
  }
}
