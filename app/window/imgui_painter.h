// Draws the lists that the interface library makes, in any context: its own backend loads OpenGL by
// a loader that fails under OSMesa.
#pragma once

#include <imgui.h>
#include <array>

#include "app/window/viewer_state.h"
#include "engine/core/result.h"
#include "render/gl/image.h"
#include "render/gl/opengl.h"
#include "render/gl/renderer.h"

namespace gridshell::window {

/// A texture that the interface shows, by its number.
inline ImTextureID texture_id(GLuint id) { return reinterpret_cast<ImTextureID>(intptr_t(id)); }

/// Puts a picture into a texture, smooth between its pixels.
void fill_texture(const render::Gl& gl, GLuint texture, int width, int height,
                  const std::uint8_t* rgba);

class InterfacePainter {
 public:
  /// `gl` outlives it. Errors: io, as of Program.
  static Result<InterfacePainter> create(const render::Gl& gl);

  /// The letters of the fonts in use, after they changed.
  void take_fonts(ImFontAtlas& atlas);
  /// Draws over the framebuffer that is bound. `upwards`: its first row is the lowest.
  void draw(const ImDrawData& data, bool upwards);

 private:
  InterfacePainter(const render::Gl& gl, render::Program program);

  const render::Gl* gl_;
  render::Program program_;
  render::VertexArray layout_;
  render::Buffer vertices_, indices_;
  render::Texture letters_;
};

// The shell's picture in the window: drawn by the renderer of movies, kept as a texture.

class ShellPicture {
 public:
  ShellPicture(const render::Gl& gl, render::Renderer& renderer)
      : gl_(&gl), renderer_(&renderer), texture_(gl) {}

  /// Draws it in the view's size, at half the resolution while it moves. Errors: those of the
  /// renderer.
  Result<void> draw(const PictureRequest& shown, Resolution sharpness);
  /// One that was drawn elsewhere.
  void show(const render::Image& image);
  GLuint texture() const { return texture_.id(); }
  /// What the last one took in that resolution; 0: none yet.
  double took_s(Resolution sharpness) const { return took_s_[std::size_t(sharpness)]; }

 private:
  const render::Gl* gl_;
  render::Renderer* renderer_;
  std::array<double, 2> took_s_{};  // by resolution
  render::Texture texture_;
};

/// The view's picture. Errors: those of the renderer.
Result<render::Image> view_picture(const PictureRequest& shown, Resolution sharpness,
                                   render::Renderer& renderer);

/// The picture for a file, with the colours' legend if requested.
Result<render::Image> picture_of(const PictureRequest& request, render::Renderer& renderer);

}  // namespace gridshell::window
