// A framebuffer with a colour texture and, if wanted, a depth texture.
#pragma once

#include "engine/core/result.h"
#include "render/gl/objects.h"

namespace gridshell::render {

/// Allocates anew when asked for another size or format, and keeps its storage while they stay.
class Target {
 public:
  enum class Depth { none, plain, compared };  ///< compared: read by a sampler2DShadow

  /// Of the colour's `levels` (each half the size before) the first is drawn into; several levels
  /// are read with smooth interpolation, a single one texel by texel.
  Target(const Gl& gl, Depth depth, int levels = 1)
      : gl_(&gl), depth_kind_(depth), levels_(levels), frame_(gl), colour_(gl), depth_(gl) {}

  /// Binds it for drawing over width x height pixels of the internal format `format`.
  /// Errors: Fault::io when the context cannot make it.
  Result<void> bind(int width, int height, GLenum format);

  GLuint frame() const { return frame_.id(); }
  GLuint colour() const { return colour_.id(); }
  GLuint depth() const { return depth_.id(); }

 private:
  void allocate();

  const Gl* gl_;
  Depth depth_kind_;
  int levels_;
  Framebuffer frame_;
  Texture colour_, depth_;
  int width_ = 0, height_ = 0;
  GLenum format_ = 0;
};

}  // namespace gridshell::render
