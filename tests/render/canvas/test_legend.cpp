#include <algorithm>

#include "render/canvas/legend.h"
#include "tests/render/canvas/ink.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("a colour bar stays in its box and shows its scale from end to end") {
  const ColourBar bar{"*K*_{□} (rad)", {diverging, -0.08, 0.08}, true, true};
  for (double font : {8.0, 14.0, 30.0}) {
    const Box box{10, 10, 0, 16 * font};
    std::vector<std::string> texts;
    Box room = box;
    const Image image = *draw_picture(12 * font, 20 * font, 1, white, [&](Canvas& c) {
      room.width = colour_bar_width(c, bar, font);
      draw_colour_bar(c, room, bar, font);
      texts = c.texts();
    });
    INFO("font " << font);
    CHECK(room.inset(-1).contains(test::ink_box(image)));
    REQUIRE(texts.size() >= 4);
    CHECK(texts[0] == "K□ (rad)");
    CHECK(texts[1] == "−0.05");
    CHECK(texts.back() == "0.05");
    // colours down the middle of the bar
    const int x = int(box.x + 0.45 * font);
    std::vector<int> red, blue;
    for (int y = int(box.y + 4 * font); y < int(room.bottom() - 2 * font); ++y) {
      red.push_back(image.pixel(x, y)[0]);
      blue.push_back(image.pixel(x, y)[2]);
    }
    // red above, blue below, and never back
    CHECK(blue.front() < red.front());
    CHECK(red.back() < blue.back());
    for (std::size_t k = 1; k < red.size(); ++k)
      CHECK(red[k] - blue[k] <= red[k - 1] - blue[k - 1] + 2);
  }
}

TEST_CASE("the ends of a scale that are not round have ticks where requested") {
  ColourBar bar{"*F* (N)", {diverging, -0.83, 0.83}};
  bar.ends = true;
  (void)draw_picture(200, 300, 1, white, [&](Canvas& c) {
    draw_colour_bar(c, {10, 10, 100, 250}, bar, 14);
    for (const std::string text : {"0.83", "−0.83", "0.5", "0.0"})
      CHECK(std::ranges::count(c.texts(), text) == 1);
  });
}

TEST_CASE("sign, ticks and words of a colour bar do not overlap, on any scale and at any height") {
  for (const double end : {0.0006, 0.02, 0.5, 0.8, 1.0, 2.0, 12.0, 250.0})
    for (const double low : {-end, 0.0})
      for (const double font : {7.1, 16.4})
        for (const double lines : {9.0, 12.0, 18.0, 24.0}) {
          const bool ends = end != 0.5;
          const ColourBar bar{
              "*K*_{□} (rad)", {diverging, low, end}, true, true, "Gauss curvature", ends};
          INFO(low << " to " << end << ", font " << font << ", " << lines << " lines");
          (void)draw_picture(20 * font, lines * font + 20, 1, white, [&](Canvas& c) {
            const Box box{10, 10, colour_bar_width(c, bar, font), lines * font};
            draw_colour_bar(c, box, bar, font);
            const std::vector<Box>& words = c.text_boxes();
            for (std::size_t a = 0; a < words.size(); ++a) {
              CHECK((words[a].empty() || box.inset(-1).contains(words[a])));
              for (std::size_t b = a + 1; b < words.size(); ++b)
                CHECK_FALSE(words[a].inset(-0.05 * font).overlaps(words[b]));
            }
          });
        }
}

TEST_CASE("a scale bar is as long as it says") {
  const Image image = *draw_picture(200, 40, 1, white, [](Canvas& c) {
    CHECK(draw_scale_bar(c, {0, 0, 200, 40}, 20, 4.5, 12));
    CHECK(c.texts().at(0) == "20 mm");
  });
  const Box ink = test::ink_box(image);
  CHECK(ink.width == Approx(90).margin(1));
  CHECK(ink.middle().x == Approx(100).margin(1));
}

TEST_CASE("a scale bar that does not fit is not drawn at all") {
  const Image image = *draw_picture(60, 40, 1, white, [](Canvas& c) {
    CHECK_FALSE(draw_scale_bar(c, {0, 0, 60, 40}, 20, 4.5, 12));
    CHECK_FALSE(draw_scale_bar(c, {0, 0, 60, 4}, 2, 4.5, 12));
    CHECK_FALSE(draw_scale_bar(c, {0, 0, 60, 40}, 20, 0, 12));
  });
  CHECK(test::ink_box(image).empty());
}

TEST_CASE("colour keys are in the middle of their row, all of them, smaller where room is short") {
  const std::vector<ColourKey> keys{{{0.8f, 0.1f, 0.1f, 1}, "shell at rest"},
                                    {{0.1f, 0.2f, 0.8f, 1}, "its net"}};
  for (const double width : {300.0, 120.0}) {
    const Image image = *draw_picture(width, 40, 1, white, [&](Canvas& c) {
      draw_colour_keys(c, {4, 4, width - 8, 32}, keys, 14);
      CHECK(c.texts() == std::vector<std::string>{"shell at rest", "its net"});
    });
    const Box ink = test::ink_box(image);
    INFO("room of " << width << ", ink of " << ink.width);
    CHECK(Box{4, 4, width - 8, 32}.inset(-1).contains(ink));
    CHECK(ink.middle().x == Approx(width / 2).margin(2));
    // each dash has its colour, the first one on the left
    int red = 0, blue = 0;
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.pixel(x, 20);
      red += pixel[0] > 150 && pixel[2] < 80 && blue == 0;
      blue += pixel[2] > 150 && pixel[0] < 80;
    }
    CHECK(red > 8);
    CHECK(blue > 8);
  }
}

TEST_CASE("the length of a scale bar is in mm or m") {
  CHECK(scale_bar_text(20) == "20 mm");
  CHECK(scale_bar_text(2.5) == "2.5 mm");
  CHECK(scale_bar_text(20000) == "20 m");
  CHECK(scale_bar_text(1500) == "1.5 m");
}
