// A picture in memory: 8-bit RGBA, rows from the top, not premultiplied.
#pragma once

#include <cstdint>
#include <vector>

namespace gridshell::render {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(std::size_t(4) * w * h, 0) {}
  std::uint8_t* pixel(int x, int y) { return rgba.data() + 4 * (std::size_t(y) * width + x); }
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + 4 * (std::size_t(y) * width + x);
  }
};

/// A colour in sRGB, components in [0, 1].
struct Colour {
  float r = 0, g = 0, b = 0, a = 1;

  bool operator==(const Colour&) const = default;
};

/// 0xRRGGBB.
constexpr Colour hex_colour(long rgb) {
  return {float(rgb >> 16 & 255) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, 1};
}

}  // namespace gridshell::render
