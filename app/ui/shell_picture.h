// The shell's picture in the window: drawn by the renderer of movies, kept as a texture.
#pragma once

#include <memory>

#include "app/window/desk.h"
#include "render/draw/renderer.h"
#include "render/gl/objects.h"

namespace gridshell::ui {

class ShellPicture {
 public:
  ShellPicture(const render::Gl& gl, render::Renderer& renderer)
      : gl_(&gl), renderer_(&renderer), texture_(gl) {}

  /// Draws what the desk shows, in its view's size, at half the resolution while it moves. Errors:
  /// those of the renderer.
  Result<void> draw(const window::Desk& desk, window::Sharpness sharpness);
  GLuint texture() const { return texture_.id(); }

 private:
  const render::Gl* gl_;
  render::Renderer* renderer_;
  render::Texture texture_;
};

/// The picture for a file, with the colours' legend where it is wanted.
Result<render::Image> picture_of(const window::PictureOrder& order, render::Renderer& renderer);

}  // namespace gridshell::ui
