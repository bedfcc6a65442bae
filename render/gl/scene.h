// A Drawing turned into triangles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/mesh.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

/// The pieces between two depths: the indices from these up to those of the next layer.
struct Layer {
  std::size_t sheets = 0, ribbons = 0, beads = 0;
};

/// The triangles of a frame, seen by one camera: three kinds of pieces, each ordered from far to
/// near and divided into layers by depth. They are painted layer by layer (in each sheets, then
/// ribbons, then beads), so that nearer parts cover farther ones without a depth test.
struct Scene {
  Mesh sheets, ribbons, beads;  ///< cells and laths; rods, rings, ghosts, arrows; joints and marks
  std::vector<Layer> layers;    ///< and one more, the end of the last
  std::vector<std::uint32_t> casters;  ///< triangles of `ribbons` that cast a shadow
  Eigen::Vector3d low = Eigen::Vector3d::Zero(),
                  high = Eigen::Vector3d::Zero();  ///< box around all

  Eigen::Vector3d centre() const { return 0.5 * (low + high); }
  double radius() const;
};

/// Makes the triangles of a drawing. `mm_per_sample` is the size of a sample in the plane through
/// the camera's target; no rod is drawn thinner. Errors: Fault::bad_input if the drawing's arrays
/// do not fit each other or a node is not finite.
Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample,
                         const DrawQuality& quality = {});

/// The input of one picture. The references must outlive it.
struct RenderJob {
  const Scene& scene;
  const Drawing& drawing;
  const Camera& camera;
  const DrawQuality& quality;
  int width, height;
};

/// A part of a large picture, small enough for a context's targets: pixels x .. x + width - 1 and
/// y .. y + height - 1, y down.
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

/// Matrix from the picture's clip coordinates to the tile's, with a displacement by `shift` pixels
/// (y up).
inline Eigen::Matrix4d crop(const Tile& tile, int width, int height, const Eigen::Vector2d& shift) {
  const double sx = double(width) / tile.width, sy = double(height) / tile.height;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 0) = sx;
  m(1, 1) = sy;
  m(0, 3) = sx * (1 - (2.0 * tile.x + tile.width) / width + 2 * shift.x() / width);
  m(1, 3) = sy * ((2.0 * tile.y + tile.height) / height - 1 + 2 * shift.y() / height);
  return m;
}

/// The first inconsistency with which drawing would read past an array or draw NaN, as the end of
/// "the drawing ..."; empty: none.
std::string drawing_error(const Drawing& drawing);

}  // namespace gridshell::render
