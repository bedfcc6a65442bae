// Draws a Drawing into an Image with OpenGL 3.3 core, in whatever context is current.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "render/draw/drawing.h"

namespace gridshell::render {

class Context;

/// Owns programs, buffers and targets of one context; the context outlives it.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(Context& context);
  virtual ~Renderer() = default;

  /// The picture of `drawing`, width x height pixels. Bit-identical from run to run and for any
  /// number of rasteriser threads. Errors: Fault::io when the context cannot provide a target of
  /// that size.
  virtual Result<Image> draw(const Drawing& drawing, const Camera& camera,
                             const DrawQuality& quality, int width, int height) = 0;
};

}  // namespace gridshell::render
