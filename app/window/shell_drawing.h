// The shell in sight as the renderer of movies draws it.
#pragma once

#include "app/window/camera_hand.h"
#include "app/window/colouring.h"
#include "render/draw/drawing.h"

namespace gridshell::window {

/// What is shown, and how.
struct Show {
  ColourBy colour_by = ColourBy::K;
  render::ColourScale scale;  ///< of the colours
  bool joints = true, rings = true, ground = true, net = false, footprint = false, dark = false;
  double mode_mm = 0;  ///< how far along the soft mode it is drawn
  bool operator==(const Show&) const = default;
};

/// Of a sight that has a shell; `thin_mm`: what is as wide as a pixel and a half.
render::Drawing drawing_of(const Sight& sight, const Show& show, double thin_mm);

/// Where a node is drawn.
Eigen::Vector3d place_of(const Sight& sight, const Show& show, int node);

}  // namespace gridshell::window
