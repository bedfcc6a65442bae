// A Drawing turned into triangles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/mesh.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

/// What is painted between two depths: indices from these up to the next layer's.
struct Layer {
  std::size_t sheets = 0, ribbons = 0, beads = 0;
};

/// Everything to draw of a frame, seen by one camera: three kinds of pieces, each kind's triangles
/// from far to near and cut into layers. Painted layer by layer, in each sheets, then ribbons, then
/// beads, what is nearer lies over what is farther without any test of depth.
struct Scene {
  Mesh sheets, ribbons, beads;         ///< cells; rods, rings, ghosts, arrows; joints and marks
  std::vector<Layer> layers;           ///< one more than there are, for the end
  std::vector<std::uint32_t> casters;  ///< triangles of `ribbons` that throw a shadow
  Eigen::Vector3d low = Eigen::Vector3d::Zero(),
                  high = Eigen::Vector3d::Zero();  ///< box around all

  Eigen::Vector3d centre() const { return 0.5 * (low + high); }
  double radius() const;
};

/// `mm_per_sample` is the size of a sample in the plane through the camera's target: nothing is
/// thinner than a sample.
/// Errors: Fault::bad_input when the drawing's arrays do not fit each other or a node is not
/// finite.
Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample,
                         const DrawQuality& quality = {});

// Everything that one picture is made from.

struct RenderJob {
  const Scene& scene;
  const Drawing& drawing;
  const Camera& camera;
  const DrawQuality& quality;
  int width, height;
};

// A large picture cut into tiles that a context can store.

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
