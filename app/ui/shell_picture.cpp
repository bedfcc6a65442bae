#include "app/ui/shell_picture.h"

#include <algorithm>
#include <cmath>

#include "app/ui/interface_painter.h"
#include "render/plot/legend.h"
#include "render/plot/pixels.h"

namespace gridshell::ui {
namespace {

using window::ColourBy;

constexpr double least_px = 1.5;  // width of a rod

Result<render::Image> draw_shell(render::Renderer& renderer, const window::PictureOrder& order,
                                 const render::DrawQuality& quality, int width, int height,
                                 double rod_px) {
  const double thin = rod_px * window::mm_per_pixel(order.camera, {double(width), double(height)});
  return renderer.draw(drawing_of(*order.sight, order.show, thin), order.camera, quality, width,
                       height);
}

}  // namespace

Result<void> ShellPicture::draw(const window::Desk& desk, window::Sharpness sharpness) {
  const bool moving = sharpness == window::Sharpness::moving;
  const double scale = moving ? 0.5 : 1;
  const int width = std::max(16, int(scale * desk.view.width)),
            height = std::max(16, int(scale * desk.view.height));
  const render::DrawQuality quality{.supersample = 1, .shadow = !moving, .jittered_passes = 1};
  auto image = draw_shell(*renderer_, desk.picture_order(), quality, width, height,
                          moving ? 0.75 * least_px : least_px * std::max(1.0, height / 720.0));
  if (!image) return tl::unexpected<Error>(image.error());
  fill_texture(*gl_, texture_.id(), width, height, image->rgba.data());
  return {};
}

Result<render::Image> picture_of(const window::PictureOrder& asked, render::Renderer& renderer) {
  window::PictureOrder order = asked;
  order.show.dark = false;
  const bool sized = order.kept.width > 0;
  const int width = sized ? order.kept.width : 2 * int(order.view.width),
            height = sized ? order.kept.height : 2 * int(order.view.height);
  // what the view shows from side to side is in the picture too
  const double wide = order.view.width / order.view.height, now = double(width) / height;
  order.camera.half_extent_mm *= std::max(1.0, wide / now);
  auto image = draw_shell(renderer, order, render::draw_quality(order.kept.quality), width, height,
                          least_px * std::max(1.0, height / 720.0));
  const ColourBy by = order.show.colour_by;
  if (!image || !order.kept.legend || by == ColourBy::none ||
      !window::values_of(*order.sight, by).any())
    return image;
  const double font = std::max(9.0, height / 45.0);
  const render::ColourBar bar{window::label_of(*order.sight, by), order.show.scale};
  render::draw_over(*image, [&](render::Canvas& canvas) {
    const double room = render::colour_bar_width(canvas, bar, font);
    draw_colour_bar(canvas, {width - room - 1.5 * font, 1.5 * font, room, 0.4 * height}, bar, font);
  });
  return image;
}

}  // namespace gridshell::ui
