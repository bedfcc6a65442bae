// Draws the draw lists of Dear ImGui with OpenGL. ImGui's own backend is not used, since its loader
// of OpenGL fails under OSMesa.
#pragma once

#include <imgui.h>
#include <array>

#include "app/window/viewer_state.h"
#include "engine/core/result.h"
#include "render/gl/image.h"
#include "render/gl/opengl.h"
#include "render/gl/renderer.h"

namespace gridshell::window {

/// The identifier of a texture for ImGui.
inline ImTextureID texture_id(GLuint id) { return reinterpret_cast<ImTextureID>(intptr_t(id)); }

/// Fills a texture with a picture, interpolated linearly between its pixels.
void fill_texture(const render::Gl& gl, GLuint texture, int width, int height,
                  const std::uint8_t* rgba);

/// Draws the interface.
class InterfacePainter {
 public:
  /// `gl` must outlive it. Errors: io, as for Program.
  static Result<InterfacePainter> create(const render::Gl& gl);

  /// Takes the letters of the fonts; to be called after fonts were loaded.
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

/// The shell's picture in the window: a texture that the renderer of movies draws.
class ShellPicture {
 public:
  ShellPicture(const render::Gl& gl, render::Renderer& renderer)
      : gl_(&gl), renderer_(&renderer), texture_(gl) {}

  /// Draws the shell in the size of the view, at half the resolution if `sharpness` is `moving`.
  /// Errors: those of the renderer.
  Result<void> draw(const PictureRequest& shown, Resolution sharpness);
  /// Takes a picture that was drawn elsewhere.
  void show(const render::Image& image);
  GLuint texture() const { return texture_.id(); }
  /// Seconds that the last picture in this resolution took; 0: none was drawn yet.
  double took_s(Resolution sharpness) const { return took_s_[std::size_t(sharpness)]; }

 private:
  const render::Gl* gl_;
  render::Renderer* renderer_;
  std::array<double, 2> took_s_{};  // by resolution
  render::Texture texture_;
};

/// Draws the view. Errors: those of the renderer.
Result<render::Image> view_picture(const PictureRequest& shown, Resolution sharpness,
                                   render::Renderer& renderer);

/// Draws the picture for a file, with a legend if requested. Errors: those of the renderer.
Result<render::Image> picture_of(const PictureRequest& request, render::Renderer& renderer);

}  // namespace gridshell::window
