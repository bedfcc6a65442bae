// A large picture cut into tiles that a context can hold.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace gridshell::render {

/// Pixels x .. x + width - 1 and y .. y + height - 1 of a picture, y down.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Tiles of at most `side` x `side` pixels that cover width x height, row by row.
inline std::vector<Tile> tiles(int width, int height, int side) {
  std::vector<Tile> result;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side)
      result.push_back({x, y, std::min(side, width - x), std::min(side, height - y)});
  return result;
}

/// From the picture's clip coordinates to the tile's; everything moves by `shift` pixels (y up).
inline Eigen::Matrix4d crop(const Tile& tile, int width, int height, const Eigen::Vector2d& shift) {
  const double sx = double(width) / tile.width, sy = double(height) / tile.height;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 0) = sx;
  m(1, 1) = sy;
  m(0, 3) = sx * (1 - (2.0 * tile.x + tile.width) / width + 2 * shift.x() / width);
  m(1, 3) = sy * ((2.0 * tile.y + tile.height) / height - 1 + 2 * shift.y() / height);
  return m;
}

}  // namespace gridshell::render
