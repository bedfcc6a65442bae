// A framebuffer with a colour texture and, if wanted, a depth texture.
#pragma once

#include "engine/core/result.h"
#include "render/gl/objects.h"

namespace gridshell::render {

/// Grows when asked for another size, and keeps its storage while the size stays.
class Target {
 public:
  enum class Depth { none, plain, compared };  ///< compared: read by a sampler2DShadow

  Target(const Gl& gl, Depth depth) : gl_(&gl), depth_kind_(depth), frame_(gl), colour_(gl), depth_(gl) {}

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
  Framebuffer frame_;
  Texture colour_, depth_;
  int width_ = 0, height_ = 0;
  GLenum format_ = 0;
};

}  // namespace gridshell::render
