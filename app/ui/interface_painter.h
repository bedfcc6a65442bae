// Draws the lists that the interface library makes, in any context: its own backend loads OpenGL by
// a loader that fails under OSMesa.
#pragma once

#include <imgui.h>

#include "engine/core/result.h"
#include "render/gl/objects.h"
#include "render/gl/program.h"
#include "render/image/image.h"

namespace gridshell::ui {

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

}  // namespace gridshell::ui
