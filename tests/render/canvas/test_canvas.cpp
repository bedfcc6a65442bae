#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/file_io.h"
#include "render/canvas/canvas.h"
#include "render/gl/image.h"
#include "tests/render/canvas/ink.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
using gridshell::test::ink_box;

namespace {

// every tag is closed, in order, and there is one root: elements become a dot, the innermost first
bool well_formed(const std::string& xml) {
  static const std::regex alone("<[?!][^>]*>"), empty("<[^<>]*/>"),
      innermost("<([^\\s<>/]+)[^<>]*>[^<>]*</\\1>");
  std::string left = std::regex_replace(std::regex_replace(xml, alone, ""), empty, "."), before;
  while (left != std::exchange(before, left)) left = std::regex_replace(left, innermost, ".");
  std::erase(left, '\n');
  return left == ".";
}

}  // namespace

TEST_CASE("the ink box of a text is where its ink is, however it is aligned and turned") {
  for (double angle : {0.0, 90.0, -90.0, 30.0})
    for (AlignX x : {AlignX::left, AlignX::centre, AlignX::right})
      for (AlignY y : {AlignY::top, AlignY::middle, AlignY::baseline, AlignY::bottom}) {
        Box said;
        const Image image = *draw_picture(300, 300, 1, white, [&](Canvas& canvas) {
          said = canvas.text("*K*_{□} = 10^{−3} gÅ", {150, 150},
                             {.size = 16, .align_x = x, .align_y = y, .angle_deg = angle});
        });
        const Box seen = ink_box(image);
        INFO("angle " << angle << " align " << int(x) << ' ' << int(y));
        CHECK(said.inset(-1.5).contains(seen));
        // a box turned by 30 degrees is larger than the turned ink
        if (angle != 30) CHECK(seen.inset(-2.5).contains(said));
      }
}

TEST_CASE("text scales with the canvas and not with the pixels") {
  Box small, large;
  (void)draw_picture(200, 50, 1, white, [&](Canvas& c) {
    small = c.text("10^{−3} mm_{a}", {5, 30}, {});
  });
  (void)draw_picture(200, 50, 4, white, [&](Canvas& c) {
    large = c.text("10^{−3} mm_{a}", {5, 30}, {});
  });
  CHECK(large.width == Approx(small.width).epsilon(0.01));
  CHECK(large.height == Approx(small.height).epsilon(0.02));
}

TEST_CASE("sub- and superscripts are smaller, lower and higher") {
  Box base, low, high;
  (void)draw_picture(200, 60, 1, white, [&](Canvas& c) {
    base = c.text("x", {5, 40}, {.size = 20});
    low = c.text("_{x}", {50, 40}, {.size = 20});
    high = c.text("^{x}", {90, 40}, {.size = 20});
  });
  CHECK(low.height < 0.8 * base.height);
  CHECK(low.bottom() > base.bottom() + 2);
  CHECK(high.bottom() < base.bottom() - 4);
}

TEST_CASE("every letter the plots need has a glyph") {
  const auto ink = [](const std::string& letter) {
    const Image image = *draw_picture(120, 120, 1, white, [&](Canvas& c) {
      c.text(letter, {40, 80}, {.size = 40});
    });
    return ink_box(image);
  };
  const auto difference = [](const Box& a, const Box& b) {
    return std::abs(a.width - b.width) + std::abs(a.height - b.height);
  };
  // a missing glyph is drawn as a box with its number: all missing ones have the same size
  const Box missing = ink("\xEE\x80\x81"), other = ink("\xEE\x81\xB8");  // U+E001, U+E078
  REQUIRE(missing.width > 10);
  REQUIRE(difference(missing, other) < 2);
  for (const std::string letter : {"□", "ρ", "δ", "−", "²", "₀", "×", "…", "α"}) {
    const Box drawn = ink(letter);
    INFO(letter);
    CHECK(drawn.width > 3);
    CHECK(difference(drawn, missing) > 2);
  }
}

TEST_CASE("text that is no UTF-8 or empty is no crash") {
  (void)draw_picture(60, 60, 1, white, [](Canvas& c) {
    c.text("\xff\xfe broken", {5, 20}, {});
    c.text("", {5, 40}, {});
    CHECK(c.shortened("\xff\xff\xff\xff\xff\xff", 5, {}).size() <= 6);
  });
}

TEST_CASE("a text is shortened to its room") {
  (void)draw_picture(100, 60, 1, white, [](Canvas& c) {
    const TextStyle style{.size = 12};
    const std::string title = "Actuation of a_circular *gridshell* δδδδ";
    CHECK(c.shortened(title, 1000, style) == title);
    const std::string kept = c.shortened(title, 120, style);
    CHECK(kept.size() < title.size());
    CHECK(kept.substr(kept.size() - 3) == "…");
    CHECK(c.measure(plain(kept), style).width <= 120);
    CHECK(c.measure(plain(kept), style).width > 90);
    CHECK(c.shortened(title, 1, style).empty());
  });
}

TEST_CASE("drawing over a picture changes only what is drawn on") {
  Image image(80, 40);
  for (std::size_t k = 0; k < image.rgba.size(); ++k)
    image.rgba[k] = k % 4 == 3 ? 255 : std::uint8_t(k * 37);
  const Image before = image;
  draw_over(image, [](Canvas& c) { c.rectangle({10, 10, 20, 10}, {1, 0.5f, 0, 1}); });
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 80; ++x) {
      const bool inside = x >= 10 && x < 30 && y >= 10 && y < 20;
      const std::uint8_t* p = image.pixel(x, y);
      if (inside)
        REQUIRE((p[0] == 255 && p[1] == 128 && p[2] == 0));
      else
        REQUIRE(std::equal(p, p + 4, before.pixel(x, y)));
    }
}

TEST_CASE("a picture within a picture keeps its colours") {
  Image inner(10, 10);
  for (std::size_t k = 0; k < inner.rgba.size(); k += 4) {
    inner.rgba[k] = 200, inner.rgba[k + 1] = 100, inner.rgba[k + 2] = 50, inner.rgba[k + 3] = 255;
  }
  const Image image = *draw_picture(30, 30, 1, white, [&](Canvas& c) {
    c.picture(inner, {5, 5, 10, 10});
  });
  CHECK(int(image.pixel(10, 10)[0]) == 200);
  CHECK(int(image.pixel(10, 10)[2]) == 50);
  CHECK(int(image.pixel(20, 20)[0]) == 255);
}

TEST_CASE("a figure is written as PNG, SVG and PDF, whose words stay words") {
  const TemporaryFolder folder;
  const DrawOn draw = [](Canvas& c) {
    c.text("*R*_{a} < 10 & more", {10, 30}, {});
    c.circle({40, 60}, 10, {0.2f, 0.4f, 0.8f, 1});
  };
  REQUIRE(write_figure(folder / "figure", 144, 72, "energy & radius", draw));
  CHECK(folder.entries() == std::vector<std::string>{"figure.pdf", "figure.png", "figure.svg"});
  const auto image = value_of(read_png(folder / "figure.png"));
  CHECK(image.width == 600);
  CHECK(image.height == 300);
  const std::string svg = draw_svg(144, 72, "energy & radius", draw);
  CHECK(well_formed(svg));
  CHECK(svg.find("<title>energy &amp; radius</title>") != std::string::npos);
  CHECK(svg.find("Ra &lt; 10 &amp; more") != std::string::npos);
  CHECK_FALSE(well_formed(svg.substr(0, svg.size() / 2)));
  // text as text: a slanted R, a smaller a below the line
  CHECK(svg.find("<text ") != std::string::npos);
  CHECK(svg.find("font-style=\"oblique\">R</tspan>") != std::string::npos);
  CHECK(svg.find("<glyph") == std::string::npos);
  CHECK(svg.find("<symbol") == std::string::npos);

  // the same bytes again, as large as requested
  CHECK(draw_pdf(144, 72, "energy", {draw}) == draw_pdf(144, 72, "energy", {draw}));
  CHECK(draw_pdf(144, 72, "energy", {draw}).starts_with("%PDF"));
  REQUIRE(write_figure(folder / "wide", 144, 72, "", draw, {85, 300}));
  const auto wide = read_png(folder / "wide.png");
  REQUIRE(wide);
  CHECK(wide->width == 1004);
  const auto bytes = value_of(read_file(folder / "wide.png"));
  // 300 dpi are 11811 pixels a metre
  const std::size_t at = bytes.find("pHYs");
  REQUIRE(at != std::string::npos);
  CHECK(bytes.substr(at + 4, 9) == std::string("\0\0\x2e\x23\0\0\x2e\x23\x01", 9));

  const auto failed = write_figure(folder / "absent" / "figure", 144, 72, "", draw);
  REQUIRE_FALSE(failed);
  CHECK(failed.error().fault == Fault::io);
}

TEST_CASE("characters that XML forbids do not break an SVG") {
  const std::string svg = draw_svg(90, 20, "bell \a", [](Canvas& c) {
    c.text("a\x01 < b", {5, 10}, {});
  });
  CHECK(svg.find_first_of("\a\x01") == std::string::npos);
  CHECK(svg.find("bell ") != std::string::npos);
}

TEST_CASE("the font is chosen by name, and one that is not there is refused") {
  const auto width = [] {
    double wide = 0;
    (void)draw_picture(1, 1, 1, white,
                       [&](Canvas& c) { wide = c.measure("iiii", {.size = 12}).width; });
    return wide;
  };
  const double usual = width();
  CHECK_THAT(refusal(use_font("No Such Font")),
             Catch::Contains("\"No Such Font\": no font of that name"));
  CHECK(width() == usual);
  REQUIRE(use_font("DejaVu Sans Mono"));
  CHECK(width() > 1.5 * usual);
  CHECK(draw_svg(9, 9, "", [](Canvas& c) {
          c.text("a", {1, 8}, {});
        }).find("\"DejaVu Sans Mono,") != std::string::npos);
  REQUIRE(use_font(""));
  CHECK(width() == usual);
}

TEST_CASE("a canvas knows where its words and markers are, however it is enlarged or cut off") {
  std::vector<Box> texts, markers;
  {
    const test::CanvasObserver watch([&](const Canvas& c) {
      texts = c.text_boxes();
      markers = c.marker_boxes();
    });
    (void)draw_picture(100, 100, 1, white, [](Canvas& c) {
      c.enlarged(2, [&] {
        c.text("wide", {10, 20}, {.size = 10});
        c.clipped({20, 20, 20, 20}, [&] {
          for (const double x : {30.0, 90.0})
            c.marker(Marker::circle, {x, 30}, 4, {0, 0, 0, 1}, {{}, 0});
        });
      });
    });
  }
  REQUIRE(texts.size() == 1);
  CHECK(texts[0].x == Approx(20).margin(3));
  CHECK(texts[0].height > 12);
  REQUIRE(markers.size() == 1);
  CHECK(markers[0].x == Approx(56));
  CHECK(markers[0].width == Approx(8));
  (void)draw_picture(9, 9, 1, white, [](Canvas& c) { c.text("unwatched", {1, 8}, {}); });
  CHECK(texts.size() == 1);
}

TEST_CASE("a picture too wide for Cairo is refused, one drawn in another is thinned") {
  const DrawOn nothing = [](Canvas&) {};
  CHECK(refusal(draw_picture(70, 1, 500, white, nothing)) ==
        "size of the picture: got 35000 x 500 pixels, expected 1 to 32767 each");
  const TemporaryFolder folder;
  CHECK(refusal(write_figure(folder / "wide", 100, 1, "", nothing, {3000, 300})) != "none");
  CHECK(folder.entries().empty());
  Image wide(40000, 2);
  for (std::size_t k = 0; k < wide.rgba.size(); ++k)
    wide.rgba[k] = k % 4 == 0 || k % 4 == 3 ? 255 : 0;
  const Image image = *draw_picture(20, 20, 1, white, [&](Canvas& c) {
    c.picture(wide, {0, 0, 20, 20});
  });
  CHECK(int(image.pixel(10, 10)[0]) == 255);
  CHECK(int(image.pixel(10, 10)[1]) < 20);
}

TEST_CASE("text that is not UTF-8 is replaced in all of an SVG") {
  const std::string svg = draw_svg(144, 72, "run \xff", [](Canvas& c) {
    c.text("*a* \xff\xfe*b*", {10, 30}, {});
  });
  CHECK(svg.find('\xff') == std::string::npos);
  CHECK(svg.find("font-style=\"oblique\">b</tspan>") != std::string::npos);
  CHECK(well_formed(svg));
}

TEST_CASE("text with markup is broken by the width of its letters") {
  (void)draw_picture(200, 60, 1, white, [](Canvas& c) {
    const TextStyle style{.size = 10};
    const std::string marked = "*a*_{1} *b*_{2}", plain_text = "*a* _{b} \\c";
    CHECK(c.wrapped_marked(marked, 1.01 * c.measure(marked, style).width, style).size() == 1);
    CHECK(c.wrapped_marked(marked, 0.99 * c.measure(marked, style).width, style).size() == 2);
    CHECK(c.wrapped(plain_text, 1000, style) == std::vector{plain_text});
    CHECK(c.wrapped(plain_text, 1, style).size() == 3);
  });
}
