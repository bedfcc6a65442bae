#include "render/canvas/panels.h"
#include "render/gl/image.h"
#include "render/movie/stills.h"
#include "tests/render/canvas/ink.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("stills are one picture a frame and one of them all") {
  const TemporaryFolder folder;
  const record::Trajectory run = synthetic::dome(3, 2);
  test::FakeRenderer renderer;
  Watch watch;
  MovieStyle style;
  style.size = {400, 300};
  style.scale_bar_mm = 20;
  style.quality = Quality::figure;
  const auto files = value_of(write_stills(run, style, {}, renderer, folder / "fig1", watch));
  CHECK(files.size() == 4);
  CHECK(folder.entries() ==
        std::vector<std::string>{"fig1.png", "fig1_1.png", "fig1_2.png", "fig1_3.png"});
  CHECK(watch.progress() == 1);
  CHECK(renderer.drawn == 3);
  CHECK(renderer.outside == 0);
  CHECK(renderer.last_quality.jittered_passes > 1);
  const auto still = value_of(read_png(folder / "fig1_2.png"));
  CHECK(still.width == 400);
  const auto whole = value_of(read_png(folder / "fig1.png"));
  CHECK(whole.width > 900);
  CHECK(whole.width < 1400);
  CHECK(test::rim_is_white(whole));
}

TEST_CASE("stills stop on request") {
  const TemporaryFolder folder;
  test::FakeRenderer renderer;
  check_stops([&](Watch& watch) {
    return write_stills(synthetic::dome(3, 2), {}, {}, renderer, folder / "fig1", watch);
  });
  CHECK(folder.entries().empty());
}

TEST_CASE("panels are side by side, pixel by pixel, with their captions under them") {
  PanelFigure figure;
  figure.columns = 2;
  for (int k = 0; k < 3; ++k) {
    Image picture(200, 100);
    for (std::size_t n = 0; n < picture.rgba.size(); ++n)
      picture.rgba[n] = n % 4 == 3 ? 255 : std::uint8_t(60 + 50 * k);
    figure.panels.push_back({picture, "", "caption " + std::to_string(k)});
  }
  const auto image = value_of(draw_panels(figure));
  CHECK(test::rim_is_white(image));
  // pixels of each panel's grey: all of them, none blended
  int counts[3] = {0, 0, 0};
  for (std::size_t n = 0; n < image.rgba.size(); n += 4)
    for (int k = 0; k < 3; ++k)
      counts[k] += image.rgba[n] == 60 + 50 * k && image.rgba[n + 1] == 60 + 50 * k;
  for (int count : counts) CHECK(count >= 200 * 100);
}

TEST_CASE("panels of different size, or none, are refused") {
  PanelFigure figure;
  CHECK_FALSE(draw_panels(figure));
  figure.panels = {{Image(20, 10), "", ""}, {Image(20, 12), "", ""}};
  CHECK(refusal(draw_panels(figure)) ==
        "panels of a figure: expected one size, got 20 x 10 and 20 x 12");
  figure.panels = {{Image(), "", ""}};
  CHECK_THAT(refusal(draw_panels(figure)), Catch::Contains("too small for its panels"));
}
