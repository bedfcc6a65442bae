// A Drawing turned into triangles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "render/draw/drawing.h"
#include "render/draw/mesh.h"

namespace gridshell::render {

/// Everything to draw of a frame, seen by one camera.
struct Scene {
  Mesh solids;   ///< joints, arrows, marks: opaque
  Mesh painted;  ///< rods, rings, ghosts as ribbons, and cells: blended from far to near
  std::vector<std::uint32_t> casters;  ///< triangles of `painted` that throw a shadow: ribbons
  std::vector<std::uint32_t> sheets;   ///< those that throw part of one: cells
  Eigen::Vector3d low = Eigen::Vector3d::Zero(),
                  high = Eigen::Vector3d::Zero();  ///< box around all

  Eigen::Vector3d centre() const { return 0.5 * (low + high); }
  double radius() const { return 0.5 * (high - low).norm(); }
};

/// `mm_per_sample` is the size of a sample in the plane through the camera's target: what is solid
/// gets as many sides as can be seen, and nothing is thinner than a sample.
/// Errors: Fault::bad_input when the drawing's arrays do not fit each other or a node is not
/// finite.
Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample);

}  // namespace gridshell::render
