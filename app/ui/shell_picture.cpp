#include "app/ui/shell_picture.h"

#include <algorithm>
#include <cmath>

#include "app/ui/interface_painter.h"
#include "render/plot/legend.h"
#include "render/plot/pixels.h"

namespace gridshell::ui {
namespace {

constexpr double least_px = 1.5;  // width of a rod

Result<render::Image> draw_shell(render::Renderer& renderer, const window::Desk& desk,
                                 const window::Show& show, const render::DrawQuality& quality,
                                 int width, int height, double rod_px) {
  const double thin = rod_px * window::mm_per_pixel(desk.camera, {double(width), double(height)});
  return renderer.draw(drawing_of(*desk.sight, show, thin), desk.camera, quality, width, height);
}

}  // namespace

Result<void> ShellPicture::draw(const window::Desk& desk, window::Sharpness sharpness) {
  const bool moving = sharpness == window::Sharpness::moving;
  const double scale = moving ? 0.5 : 1;
  const int width = std::max(16, int(scale * desk.view.width)),
            height = std::max(16, int(scale * desk.view.height));
  const render::DrawQuality quality{.supersample = 1, .shadow = !moving, .jittered_passes = 1};
  auto image = draw_shell(*renderer_, desk, desk.show, quality, width, height,
                          moving ? 0.75 * least_px : least_px * std::max(1.0, height / 720.0));
  if (!image) return tl::unexpected<Error>(image.error());
  fill_texture(*gl_, texture_.id(), width, height, image->rgba.data());
  return {};
}

Result<render::Image> ShellPicture::for_file(const window::Desk& desk) const {
  window::Show show = desk.show;
  show.dark = false;
  const int width = 2 * int(desk.view.width), height = 2 * int(desk.view.height);
  auto image = draw_shell(*renderer_, desk, show, {.supersample = 1, .shadow = true}, width, height,
                          2 * least_px);
  if (!image || show.colour_by == window::ColourBy::none ||
      !window::values_of(*desk.sight, show.colour_by).any())
    return image;
  const double font = height / 45.0;
  const render::ColourBar bar{window::label_of(show.colour_by), show.scale};
  render::draw_over(*image, [&](render::Canvas& canvas) {
    const double wide = render::colour_bar_width(canvas, bar, font);
    draw_colour_bar(canvas, {width - wide - 1.5 * font, 1.5 * font, wide, 0.4 * height}, bar, font);
  });
  return image;
}

}  // namespace gridshell::ui
