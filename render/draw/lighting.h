// A key light (a small disc in the sky, to the left of the camera), an even sky and the light that
// the ground returns. A surface that faces up, unshadowed, receives exactly 1: it shows the colour
// it was given.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/draw/drawing.h"

namespace gridshell::render {

/// What lights one pass. Irradiance on a surface of normal n:
/// key max(n.l, 0) + sky (1 + n_z) / 2 + bounce (1 - n_z) / 2.
struct Lighting {
  Eigen::Vector3d direction;  ///< unit vector l towards the shadow-casting light
  double key = 0, sky = 0, bounce = 0;
  double spread = 0;  ///< width of a shadow's edge over the height of what casts it
  Eigen::Vector2d pixel_shift = Eigen::Vector2d::Zero();  ///< in samples, within +-1/2
};

/// One pass has the sky without shadow. More passes sample the light's disc and the sky (even over
/// the half sphere) by a fixed low-discrepancy sequence [Roberts 2018], each pass with one
/// direction that casts a shadow; their mean tends to the same light, with the sky shadowed too.
std::vector<Lighting> lighting_passes(const Camera& camera, int passes);

}  // namespace gridshell::render
