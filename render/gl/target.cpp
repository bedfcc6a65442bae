#include "render/gl/target.h"

#include <fmt/format.h>

namespace gridshell::render {
namespace {

void filter(const Gl& gl, GLint smaller, GLint larger) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, larger);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

void Target::allocate() {
  gl_->BindTexture(GL_TEXTURE_2D, colour_.id());
  for (int level = 0; level < levels_; ++level)
    gl_->TexImage2D(GL_TEXTURE_2D, level, GLint(format_), width_ >> level, height_ >> level, 0,
                    GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  filter(*gl_, levels_ > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST,
         levels_ > 1 ? GL_LINEAR : GL_NEAREST);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, frame_.id());
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
  if (depth_kind_ == Depth::none) return;

  gl_->BindTexture(GL_TEXTURE_2D, depth_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width_, height_, 0, GL_DEPTH_COMPONENT,
                  GL_FLOAT, nullptr);
  const bool compared = depth_kind_ == Depth::compared;
  filter(*gl_, compared ? GL_LINEAR : GL_NEAREST, compared ? GL_LINEAR : GL_NEAREST);
  if (compared) {
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
}

Result<void> Target::bind(int width, int height, GLenum format) {
  const bool fits = width == width_ && height == height_ && format == format_;
  if (!fits) {
    width_ = width;
    height_ = height;
    format_ = format;
    allocate();
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, frame_.id());
  gl_->Viewport(0, 0, width, height);
  if (fits || gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return {};
  width_ = height_ = 0;
  return fail(Fault::io, fmt::format("OpenGL cannot draw into {} x {} samples", width, height));
}

}  // namespace gridshell::render
