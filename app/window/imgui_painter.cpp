#include "app/window/imgui_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/canvas/canvas.h"
#include "render/canvas/legend.h"
#include "render/movie/frame_overlay.h"

#include "engine/core/system_info.h"
#include "engine/core/try.h"

namespace gridshell::window {

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
  TRY(program, render::Program::create(gl, {"interface.vert"}, {"interface.frag"}));
  return InterfacePainter(gl, std::move(*program));
}

void InterfacePainter::take_fonts(ImFontAtlas& atlas) {
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsRGBA32(&rgba, &width, &height);
  fill_texture(*gl_, letters_.id(), width, height, rgba);
  // letters are at whole pixels and areas have one colour, so nothing is interpolated
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
      // pictures, which have no letters, are opaque
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

namespace {

constexpr double least_px = 1.5;  // least width of a rod

/// Draws the shell, or two shells side by side, each of this width.
Result<render::Image> draw_shells(render::Renderer& renderer, const PictureRequest& request,
                                  const render::DrawQuality& quality, int width, int height,
                                  double rod_px) {
  const double thin = rod_px * mm_per_pixel(request.camera, {double(width), double(height)});
  const auto draw = [&](const ShellView& shell, const Show& show) {
    return renderer.draw(drawing_of(shell, show, thin), request.camera, quality, width, height);
  };
  auto image = draw(*request.shell, request.show);
  if (!image || request.show.shells() < 2) return image;
  // so that colours by distance are those of the distance from one another in both
  Show theirs = request.show;
  theirs.mode_mm = 0;
  theirs.other = std::make_shared<const OtherShell>(OtherShell{"", request.shell});
  TRY(other, draw(*request.show.other->seen, theirs));
  render::Image both(2 * width, height);
  for (int y = 0; y < height; ++y) {
    std::copy_n(image->pixel(0, y), 4 * width, both.pixel(0, y));
    std::copy_n(other->pixel(0, y), 4 * width, both.pixel(width, y));
  }
  return both;
}

}  // namespace

Result<render::Image> view_picture(const PictureRequest& shown, Resolution sharpness,
                                   render::Renderer& renderer) {
  const bool moving = sharpness == Resolution::moving;
  const double scale = moving ? 0.5 : 1;
  const int width = std::max(16, int(scale * shown.view.width)),
            height = std::max(16, int(scale * shown.view.height));
  const render::DrawQuality quality{
      .supersample = 1, .shadow = !moving, .jittered_passes = 1, .coarse = moving};
  return draw_shells(renderer, shown, quality, width, height,
                     moving ? 0.75 * least_px : least_px * std::max(1.0, height / 720.0));
}

Result<void> ShellPicture::draw(const PictureRequest& shown, Resolution sharpness) {
  const double begin = seconds_now();
  TRY(image, view_picture(shown, sharpness, *renderer_));
  show(*image);
  took_s_[std::size_t(sharpness)] = seconds_now() - begin;
  return {};
}

void ShellPicture::show(const render::Image& image) {
  fill_texture(*gl_, texture_.id(), image.width, image.height, image.rgba.data());
}

Result<render::Image> picture_of(const PictureRequest& requested, render::Renderer& renderer) {
  PictureRequest request = requested;
  request.show.dark = false;
  const bool sized = request.format.width > 0;
  const int width =
                sized ? request.format.width / request.show.shells() : 2 * int(request.view.width),
            height = sized ? request.format.height : 2 * int(request.view.height);
  // the picture shows at least the width that the view shows
  const double wide = request.view.width / request.view.height, now = double(width) / height;
  request.camera.half_extent_mm *= std::max(1.0, wide / now);
  auto image = draw_shells(renderer, request, render::draw_quality(request.format.quality), width,
                           height, least_px * std::max(1.0, height / 720.0));
  if (!image || !request.format.legend) return image;
  const double font = std::max(9.0, height / 45.0);
  const std::string loads =
      request.show.loads ? render::load_caption(request.shell->frame) : std::string();
  if (!loads.empty()) {
    const auto key = arrow_key_of(*request.shell, request.show);
    const double per_mm = 1 / mm_per_pixel(request.camera, {double(width), double(height)});
    render::draw_over(*image, [&](render::Canvas& canvas) {
      if (key)
        draw_arrow_key(canvas,
                       {font, height - 3.5 * font, key->length_mm * per_mm + 6 * font, 3 * font},
                       *key, per_mm, font);
      else
        canvas.text(loads, {font, height - font}, {.size = font});
    });
  }
  if (request.show.colour_by == ColourBy::none ||
      values_of(*request.shell, request.show).size() == 0)
    return image;
  const render::ColourBar bar = bar_of(*request.shell, request.show);
  render::draw_over(*image, [&](render::Canvas& canvas) {
    const double room = render::colour_bar_width(canvas, bar, font);
    draw_colour_bar(canvas, {image->width - room - 1.5 * font, 1.5 * font, room, 0.4 * height}, bar,
                    font);
  });
  return image;
}

}  // namespace gridshell::window
