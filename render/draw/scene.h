// A Drawing turned into triangles.
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "render/draw/drawing.h"
#include "render/draw/mesh.h"

namespace gridshell::render {

/// Everything to draw of a frame, seen by one camera.
struct Scene {
  Mesh solids;  ///< rods, rings, joints
  Mesh ghosts;  ///< ghost rods
  Mesh cells;   ///< far to near
  Eigen::Vector3d low = Eigen::Vector3d::Zero(),
                  high = Eigen::Vector3d::Zero();  ///< box around all

  Eigen::Vector3d centre() const { return 0.5 * (low + high); }
  double radius() const { return 0.5 * (high - low).norm(); }
};

/// `mm_per_sample` is the size of a sample in the plane through the camera's target: tubes get as
/// many sides as can be seen, and none is thinner than a sample, so that no rod breaks into dots.
/// Errors: Fault::bad_input when the drawing's arrays do not fit each other or a node is not
/// finite.
Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample);

}  // namespace gridshell::render
