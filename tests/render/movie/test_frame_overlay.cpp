#include "render/movie/frame_overlay.h"

#include <vector>

#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("parts of a frame lie inside it and never overlap, at any size and aspect") {
  const ColourBar bar{"*K*_{□} (rad)", {diverging, -0.08, 0.08}, true, true};
  const std::vector<std::pair<int, int>> sizes = {
      {320, 240},  {640, 360}, {640, 480}, {1280, 720},  {1920, 1080}, {3840, 2160},
      {720, 1280}, {500, 500}, {800, 700}, {3840, 240},  {320, 2160},  {1000, 100},
      {100, 1000}, {64, 48},   {16, 16},   {1150, 1000}, {1149, 1000}};
  for (const auto& [width, height] : sizes)
    for (int options = 0; options < 32; ++options) {
      MovieStyle style;
      style.size = {width, height};
      style.captions = options & 1;
      style.inset = options & 2;
      style.scale_bar_mm = options & 4 ? 20 : 0;
      const FrameLayout layout =
          lay_out_frame(style, options & 8 ? &bar : nullptr,
                        {(options & 16) != 0, (options & 16) != 0, (options & 16) != 0});
      INFO(width << " x " << height << " options " << options);
      const std::vector<Box> parts = layout.parts();
      for (std::size_t a = 0; a < parts.size(); ++a) {
        if (parts[a].empty()) continue;
        CHECK(Box{0, 0, double(width), double(height)}.contains(parts[a]));
        for (std::size_t b = a + 1; b < parts.size(); ++b) CHECK_FALSE(parts[a].overlaps(parts[b]));
      }
      // most of the picture is the shell's
      if (width >= 320 && height >= 240)
        CHECK(layout.view.width * layout.view.height > 0.3 * width * height);
      else
        CHECK_FALSE(layout.view.empty());
    }
}

TEST_CASE("at the usual sizes nothing is left out, and text grows with the picture") {
  const ColourBar bar{"*K*_{□} (rad)", {diverging, -0.08, 0.08}};
  double before = 0;
  for (const auto& [width, height] :
       {std::pair{320, 240}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}}) {
    MovieStyle style;
    style.size = {width, height};
    style.scale_bar_mm = 20;
    const FrameLayout layout = lay_out_frame(style, &bar);
    INFO(width << " x " << height);
    for (const Box& part : {layout.title, layout.state, layout.event, layout.timeline,
                            layout.colour_bar, layout.inset, layout.scale_bar, layout.view})
      CHECK_FALSE(part.empty());
    CHECK(layout.plot.empty());  // not requested
    CHECK(layout.font_size > before);
    before = layout.font_size;
  }
}

TEST_CASE("what is switched off takes no room") {
  MovieStyle style;
  style.captions = style.inset = false;
  const FrameLayout layout = lay_out_frame(style, nullptr);
  CHECK(layout.view.width > 0.95 * 1280);
  CHECK(layout.view.height > 0.9 * 720);
}
