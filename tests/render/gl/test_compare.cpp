#include "render/gl/image.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

// a shaded background with a fan of dark lines, one of which can be left out
Image fan(int width, int height, int lost = -1) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t grey = static_cast<std::uint8_t>(200 + 40 * y / height);
      std::uint8_t* p = image.pixel(x, y);
      p[0] = p[1] = p[2] = grey;
      p[3] = 255;
      for (int k = 0; k < 8; ++k)
        if (k != lost && x == 10 + 14 * k + (y * (k - 4)) / 24) p[0] = p[1] = p[2] = 40;
    }
  return image;
}

}  // namespace

TEST_CASE("a picture does not differ from itself") {
  const Image a = fan(130, 90);
  const auto c = value_of(compare(a, a));
  CHECK(c.difference == 0);
  CHECK(c.same(0));
}

TEST_CASE("one level of noise everywhere stays below the threshold") {
  const Image a = fan(130, 90);
  Image b = a;
  for (std::size_t k = 0; k < b.rgba.size(); k += 4) b.rgba[k + k / 4 % 3] += 1;
  const auto c = value_of(compare(a, b));
  CHECK(c.difference == Approx(1));
  CHECK(c.same());
  CHECK_FALSE(c.same(0.5));
}

TEST_CASE("a lost one-pixel rod is found where it was") {
  const auto c = value_of(compare(fan(130, 90), fan(130, 90, 4)));
  CHECK_FALSE(c.same());
  // the rod is vertical at x = 66: one column of eight differs by its contrast of 160 to 200
  CHECK(c.difference > 160.0 / 8);
  CHECK(c.difference < 200.0 / 8);
  CHECK(c.x <= 66);
  CHECK(c.x + c.width > 66);
  // the mean over the whole picture would have missed it
  CHECK(180.0 / 130 < default_difference_threshold);
}

TEST_CASE("a difference in the last pixel of an odd size counts") {
  const Image a = fan(131, 93);
  Image b = a;
  b.pixel(130, 92)[2] = 0;
  const auto c = value_of(compare(a, b));
  CHECK(c.difference == Approx(a.pixel(130, 92)[2] / 64.0));
  CHECK(c.x == 131 - 8);
  CHECK(c.y == 93 - 8);
}

TEST_CASE("a difference in alpha counts, a tiny picture is one block") {
  Image a(3, 2), b(3, 2);
  b.pixel(1, 1)[3] = 60;
  const auto c = value_of(compare(a, b));
  CHECK(c.difference == Approx(10));
  CHECK(c.width == 3);
  CHECK(c.height == 2);
}

TEST_CASE("pictures of different size are refused with both sizes") {
  CHECK(refusal(compare(Image(640, 480), Image(640, 360))) ==
        "pictures of different size cannot be compared: 640 x 480 and 640 x 360");
  CHECK_FALSE(compare(Image(), Image()));
}

TEST_CASE("the difference picture is red where pictures differ and outlines the worst block") {
  const Image a = fan(130, 90), b = fan(130, 90, 4);
  const auto c = value_of(compare(a, b));
  const Image d = difference_picture(a, b, c);
  REQUIRE(d.width == 130);
  REQUIRE(d.height == 90);
  const std::uint8_t* differs = d.pixel(66, 40);
  CHECK(differs[0] == 220);
  CHECK(differs[1] == 0);
  const std::uint8_t* agrees = d.pixel(5, 40);
  CHECK(agrees[0] == agrees[1]);
  const std::uint8_t* frame = d.pixel(c.x - 1, c.y + 4);
  CHECK(frame[2] == 255);
  CHECK(frame[0] == 0);
}
