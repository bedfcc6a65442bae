// Pictures in memory, colours, PNG files, and the comparison of two pictures.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::render {

/// A picture of 8-bit sRGB colours with alpha, rows from the top, not premultiplied.
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

/// The opaque colour 0xRRGGBB.
constexpr Colour hex_colour(long rgb) {
  return {float(rgb >> 16 & 255) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, 1};
}

// Colours are mixed and shaded in linear light [IEC 61966-2-1].

/// An sRGB component in [0, 1] in linear light.
inline float to_linear(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// A component in linear light, in [0, 1], as sRGB.
template <std::floating_point T>
T to_srgb(T v) {
  return v <= T(0.0031308) ? T(12.92) * v : T(1.055) * std::pow(v, 1 / T(2.4)) - T(0.055);
}

/// r, g and b in linear light, and the unchanged alpha.
inline Eigen::Vector4f to_linear(const Colour& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b), c.a};
}

/// The largest picture that is written and read (16384 x 16384).
inline constexpr std::size_t most_pixels = std::size_t(1) << 28;

/// The picture as the bytes of an 8-bit PNG: RGB if every pixel is opaque, else RGBA. A `dpi` above
/// 0 is written into the file: pixels per inch as printed. Errors: Fault::bad_input for an empty
/// picture and one with more than `most_pixels`; Fault::io without memory.
Result<std::string> encode_png(const Image& image, double dpi = 0);

/// Writes a PNG file, or leaves none if it fails. Errors: Fault::io with the path and the system's
/// message; those of encode_png.
Result<void> write_png(const Image& image, const std::filesystem::path& path, double dpi = 0);

/// The picture in the bytes of a PNG of any colour type and bit depth, as 8-bit RGBA. Errors:
/// Fault::bad_input, with `name`, if it is no PNG, is damaged or has more than `most_pixels`.
Result<Image> decode_png(std::string_view bytes, const std::string& name);

/// Reads a PNG from a file. Errors: Fault::io with the path and why it cannot be read; those of
/// decode_png.
Result<Image> read_png(const std::filesystem::path& path);

// Comparison of two pictures as the eye sees them. The 8 x 8 block with the largest difference
// decides, so that a missing rod counts, which a mean over the picture would miss, and noise of one
// grey level everywhere does not.

/// The threshold is between differences by another CPU (up to 3.6) and broken pictures (from 9.3).
inline constexpr double default_difference_threshold = 4;

/// Blocks are `block_size` pixels wide and high and begin every `block_step` pixels; the last ones
/// of a row or column are moved back inside the picture.
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

/// The block in which a and b differ most, pixel by pixel, including alpha. Errors:
/// Fault::bad_input if their sizes differ or they are empty.
Result<Comparison> compare(const Image& a, const Image& b);

/// A picture of the differences of a and b, which are of one size: differences times `gain` in red
/// over a pale grey picture of a, with the worst block outlined.
Image difference_picture(const Image& a, const Image& b, const Comparison& worst, double gain = 8);

}  // namespace gridshell::render
