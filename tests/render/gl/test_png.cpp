#include <fmt/format.h>
#include <png.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "render/gl/image.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
namespace fs = std::filesystem;

namespace {

Image colourful(int width, int height, bool transparent) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(x * 7);
      p[1] = static_cast<std::uint8_t>(y * 5);
      p[2] = static_cast<std::uint8_t>(x * y);
      p[3] = static_cast<std::uint8_t>(transparent ? x + y : 255);
    }
  return image;
}

// a 4 x 2 file of another colour type and depth
void write_raw(const fs::path& path, int colour_type, int depth, const std::string& row) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 4, 2, depth, colour_type, PNG_INTERLACE_NONE, 0, 0);
  const png_color palette[] = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}, {255, 0, 1}};
  if (colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 4);
  png_write_info(png, info);
  for (int y = 0; y < 2; ++y) png_write_row(png, reinterpret_cast<png_const_bytep>(row.data()));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

}  // namespace

TEST_CASE("a picture survives being a PNG, with and without transparency") {
  const TemporaryFolder folder;
  for (bool transparent : {false, true}) {
    const Image image = colourful(37, 21, transparent);
    const fs::path path = folder / "a.png";
    REQUIRE(write_png(image, path));
    const auto back = value_of(read_png(path));
    CHECK(back.width == 37);
    CHECK(back.height == 21);
    CHECK(back.rgba == image.rgba);
  }
  // nothing but the final name is left
  CHECK(folder.entries() == std::vector<std::string>{"a.png"});
}

TEST_CASE("any colour type and bit depth is read as 8-bit RGBA") {
  const TemporaryFolder folder;
  const fs::path path = folder / "b.png";
  const auto pixel = [&](int x) {
    const auto image = value_of(read_png(path));
    REQUIRE(image.width == 4);
    const std::uint8_t* p = image.pixel(x, 1);
    return std::vector<int>{p[0], p[1], p[2], p[3]};
  };
  write_raw(path, PNG_COLOR_TYPE_GRAY, 1, std::string("\xA0", 1));
  CHECK(pixel(0) == std::vector<int>{255, 255, 255, 255});
  CHECK(pixel(1) == std::vector<int>{0, 0, 0, 255});
  write_raw(path, PNG_COLOR_TYPE_PALETTE, 2, std::string("\x1B", 1));
  CHECK(pixel(1) == std::vector<int>{40, 50, 60, 255});
  CHECK(pixel(3) == std::vector<int>{255, 0, 1, 255});
  write_raw(path, PNG_COLOR_TYPE_GRAY_ALPHA, 8, std::string("\x10\x20\x30\x40\x50\x60\x70\x80"));
  CHECK(pixel(1) == std::vector<int>{0x30, 0x30, 0x30, 0x40});
  write_raw(path, PNG_COLOR_TYPE_RGB, 16, std::string(24, '\xFF'));
  CHECK(pixel(2) == std::vector<int>{255, 255, 255, 255});
}

TEST_CASE("what cannot be written or read says so, with its path and the reason") {
  const TemporaryFolder folder;
  const fs::path absent = folder / "absent" / "a.png";
  CHECK(refusal(write_png(colourful(4, 4, false), absent), Fault::io) ==
        "cannot write '" + absent.string() + "': No such file or directory");

  const auto read = read_png(absent);
  REQUIRE_FALSE(read);
  CHECK(read.error().fault == Fault::io);
  CHECK(read.error().message == "cannot read '" + absent.string() + "': No such file or directory");

  CHECK_FALSE(write_png(Image(), folder / "empty.png"));
  CHECK(folder.entries().empty());
}

TEST_CASE("a damaged file is bad input, not a crash") {
  const TemporaryFolder folder;
  const fs::path path = folder / "c.png";
  const auto bytes = value_of(encode_png(colourful(64, 64, false)));
  std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  CHECK(refusal(read_png(path))
            .rfind(fmt::format("'{}' is not a readable PNG: ", path.string()), 0) == 0);
  std::ofstream(path, std::ios::binary) << "GIF89a and so on";
  CHECK_FALSE(read_png(path));
  std::ofstream(path, std::ios::binary | std::ios::trunc);
  CHECK_FALSE(read_png(path));
}

TEST_CASE("a picture that would not be read back is not written") {
  Image image;
  image.width = image.height = 20000;
  CHECK(refusal(encode_png(image)) ==
        "size of the picture: got 20000 x 20000 pixels, expected at most 268 million");
}
