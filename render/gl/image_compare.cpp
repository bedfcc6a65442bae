#include "render/gl/image.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace gridshell::render {
namespace {

std::uint8_t largest_channel_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(int(a[c]) - int(b[c])));
  return static_cast<std::uint8_t>(largest);
}

// 0, step, 2 step, ... and the last start at which a block still fits
std::vector<int> block_starts(int length, int block) {
  std::vector<int> starts;
  for (int start = 0; start + block < length; start += block_step) starts.push_back(start);
  starts.push_back(length - block);
  return starts;
}

void paint(Image& image, int x, int y, std::array<std::uint8_t, 3> rgb) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* p = image.pixel(x, y);
  std::copy(rgb.begin(), rgb.end(), p);
  p[3] = 255;
}

// a frame around the block, `thickness` pixels wide, outside of it so that the block stays visible
void outline(Image& image, const Comparison& block, int thickness) {
  const int x0 = block.x - thickness, x1 = block.x + block.width + thickness;
  const int y0 = block.y - thickness, y1 = block.y + block.height + thickness;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (x < block.x || x >= block.x + block.width || y < block.y || y >= block.y + block.height)
        paint(image, x, y, {0, 90, 255});
}

}  // namespace

Result<Comparison> compare(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    return fail(Fault::bad_input,
                "pictures of different size cannot be compared: {} x {} and {} x {}", a.width,
                a.height, b.width, b.height);
  if (a.width < 1 || a.height < 1)
    return fail(Fault::bad_input, "empty pictures (0 x 0) cannot be compared");

  std::vector<std::uint8_t> difference(std::size_t(a.width) * a.height);
  for (std::size_t k = 0; k < difference.size(); ++k)
    difference[k] = largest_channel_difference(&a.rgba[4 * k], &b.rgba[4 * k]);

  Comparison worst{.width = std::min(block_size, a.width),
                   .height = std::min(block_size, a.height)};
  int worst_sum = 0;
  for (int y : block_starts(a.height, worst.height))
    for (int x : block_starts(a.width, worst.width)) {
      int sum = 0;
      for (int row = 0; row < worst.height; ++row)
        for (int column = 0; column < worst.width; ++column)
          sum += difference[std::size_t(y + row) * a.width + x + column];
      if (sum <= worst_sum) continue;
      worst_sum = sum;
      worst.x = x;
      worst.y = y;
    }
  worst.difference = double(worst_sum) / (worst.width * worst.height);
  return worst;
}

Image difference_picture(const Image& a, const Image& b, const Comparison& worst, double gain) {
  Image picture(a.width, a.height);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::uint8_t* p = a.pixel(x, y);
      const double grey = 192 + 0.25 * (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]);
      const double red = std::min(1.0, gain * largest_channel_difference(p, b.pixel(x, y)) / 255);
      const auto mix = [&](double from, double to) {
        return static_cast<std::uint8_t>(std::min(255.0, from + (to - from) * red + 0.5));
      };
      paint(picture, x, y, {mix(grey, 220), mix(grey, 0), mix(grey, 0)});
    }
  if (worst.difference > 0) outline(picture, worst, 2);
  return picture;
}

}  // namespace gridshell::render
