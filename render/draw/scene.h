// A Drawing turned into triangles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "render/draw/drawing.h"
#include "render/draw/mesh.h"

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
  double radius() const { return 0.5 * (high - low).norm(); }
};

/// `mm_per_sample` is the size of a sample in the plane through the camera's target: nothing is
/// thinner than a sample.
/// Errors: Fault::bad_input when the drawing's arrays do not fit each other or a node is not
/// finite.
Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample);

}  // namespace gridshell::render
