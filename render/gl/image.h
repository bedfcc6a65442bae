// A picture in memory: 8-bit RGBA, rows from the top, not premultiplied.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

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

// sRGB to linear light, where colours are mixed and shaded [IEC 61966-2-1].

/// One sRGB component in [0, 1] to linear light.
inline float to_linear(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// The inverse of it.
inline float to_srgb(float v) {
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

/// Linear r, g, b and the unchanged alpha.
inline Eigen::Vector4f to_linear(const Colour& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b), c.a};
}

// PNG files to pictures and back.

/// The picture as the bytes of an 8-bit PNG: RGB when every pixel is opaque, else RGBA. As fast as
/// keeps rendered frames small.
/// Errors: Fault::bad_input for an empty picture.
/// `dpi` above 0 is written into the file: pixels an inch as printed.
Result<std::string> encode_png(const Image& image, double dpi = 0);

/// Writes a PNG that is whole or absent. Errors: Fault::io naming the path and what the system
/// said; those of encode_png.
Result<void> write_png(const Image& image, const std::filesystem::path& path, double dpi = 0);

/// The picture in the bytes of a PNG of any colour type and bit depth, as 8-bit RGBA. Errors:
/// Fault::bad_input, with `name`, when it is no PNG or is damaged.
Result<Image> decode_png(std::string_view bytes, const std::string& name);

/// Reads a PNG from a file. Errors: Fault::io naming the path and why it cannot be opened;
/// Fault::bad_input as above.
Result<Image> read_png(const std::filesystem::path& path);

// Are two pictures the same to the eye? The worst 8 x 8 block decides, so that a lost rod counts
// and one grey level of noise over the whole picture does not: a mean over the picture misses the
// first.

/// Between harmless differences of another CPU (up to 3.6) and a broken picture (from 9.3).
inline constexpr double default_difference_threshold = 4;

/// Blocks are `block_size` pixels wide and high and `block_step` apart from start to start; the
/// last ones of a row or column are moved back inside the picture.
inline constexpr int block_size = 8, block_step = 4;

/// The block in which two pictures differ most.
struct Comparison {
  double difference = 0;  ///< mean over the block of each pixel's largest channel difference, 0-255
  int x = 0, y = 0;       ///< the block's upper left pixel
  int width = 0, height = 0;  ///< of the block, smaller than block_size only in tiny pictures

  bool same(double threshold = default_difference_threshold) const {
    return difference <= threshold;
  }
};

/// Compares pixel by pixel, alpha included. Errors: Fault::bad_input naming both sizes when they
/// differ, or when a picture is empty.
Result<Comparison> compare(const Image& a, const Image& b);

/// Where a and b (of one size) differ: differences times `gain` in red over a pale grey picture of
/// a, the worst block outlined.
Image difference_picture(const Image& a, const Image& b, const Comparison& worst, double gain = 8);

}  // namespace gridshell::render
