// Are two pictures the same to the eye? The worst 8 x 8 block decides, so that a lost rod counts
// and one grey level of noise over the whole picture does not: a mean over the picture misses the
// first.
#pragma once

#include "engine/core/result.h"
#include "render/image/image.h"

namespace gridshell::render {

/// Between harmless differences of another CPU (up to 3.6) and a broken picture (from 9.3).
inline constexpr double default_difference_threshold = 4;

/// Blocks are `block_size` pixels wide and high and stand `block_step` apart; the last ones of a
/// row or column are moved back inside the picture.
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
