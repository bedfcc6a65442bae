#include "app/ui/interface_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gridshell::ui {

void fill_texture(const render::Gl& gl, GLuint texture, int width, int height,
                  const std::uint8_t* rgba) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

InterfacePainter::InterfacePainter(const render::Gl& gl, render::Program program)
    : gl_(&gl),
      program_(std::move(program)),
      layout_(gl),
      vertices_(gl),
      indices_(gl),
      letters_(gl) {
  gl.BindVertexArray(layout_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  const auto attribute = [&gl](GLuint index, GLint size, GLenum type, bool unit, std::size_t at) {
    render::describe_attribute(gl, index, size, type, unit, sizeof(ImDrawVert), at);
  };
  attribute(0, 2, GL_FLOAT, false, offsetof(ImDrawVert, pos));
  attribute(1, 2, GL_FLOAT, false, offsetof(ImDrawVert, uv));
  attribute(2, 4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col));
}

Result<InterfacePainter> InterfacePainter::create(const render::Gl& gl) {
  auto program = render::Program::create(gl, {"interface.vert"}, {"interface.frag"});
  if (!program) return tl::unexpected<Error>(program.error());
  return InterfacePainter(gl, std::move(*program));
}

void InterfacePainter::take_fonts(ImFontAtlas& atlas) {
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsRGBA32(&rgba, &width, &height);
  fill_texture(*gl_, letters_.id(), width, height, rgba);
  // letters stand on whole pixels, and areas have one colour: no pixel needs its neighbours
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  atlas.SetTexID(texture_id(letters_.id()));
}

void InterfacePainter::draw(const ImDrawData& data, bool upwards) {
  const int width = int(data.DisplaySize.x), height = int(data.DisplaySize.y);
  gl_->Disable(GL_FRAMEBUFFER_SRGB);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->Viewport(0, 0, width, height);
  program_.use();
  program_.set("size", Eigen::Vector2f(float(width), float(height)));
  program_.set("upwards", upwards ? 1.f : -1.f);
  program_.set("picture", 0);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindVertexArray(layout_.id());
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    gl_->BufferData(GL_ARRAY_BUFFER, GLsizeiptr(list.VtxBuffer.size_in_bytes()),
                    list.VtxBuffer.Data, GL_STREAM_DRAW);
    gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(list.IdxBuffer.size_in_bytes()),
                    list.IdxBuffer.Data, GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      const int x = std::max(0, int(clip.x)), y = std::max(0, int(clip.y));
      const int right = std::min(width, int(std::ceil(clip.z))),
                bottom = std::min(height, int(std::ceil(clip.w)));
      if (right <= x || bottom <= y || command.UserCallback) continue;
      gl_->Scissor(x, upwards ? height - bottom : y, right - x, bottom - y);
      const auto texture = GLuint(reinterpret_cast<intptr_t>(command.GetTexID()));
      gl_->BindTexture(GL_TEXTURE_2D, texture);
      // the view of the shell hides what is behind it
      if (texture == letters_.id())
        gl_->Enable(GL_BLEND);
      else
        gl_->Disable(GL_BLEND);
      gl_->DrawElements(GL_TRIANGLES, GLsizei(command.ElemCount),
                        sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                        reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)));
    }
  }
  gl_->Disable(GL_SCISSOR_TEST);
}

}  // namespace gridshell::ui
