// Everything that one picture is made from.
#pragma once

#include "render/draw/drawing.h"
#include "render/draw/scene.h"

namespace gridshell::render {

struct Shot {
  const Scene& scene;
  const Drawing& drawing;
  const Camera& camera;
  const DrawQuality& quality;
  int width, height;
};

}  // namespace gridshell::render
