#include "render/movie/movie_style.h"

#include <algorithm>

#include "render/canvas/canvas.h"

namespace gridshell::render {

Appearance paper_appearance() {
  Appearance look;
  look.rod = {0, 0, 0, 1};
  look.joint_mm = 0;
  look.ring = {0, 0, 0, 1};
  look.cells = look.floor = look.shadow = false;
  look.sheen = 0;
  return look;
}

DrawQuality draw_quality(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {.supersample = 1, .shadow = false, .jittered_passes = 1};
    case Quality::movie:
      return {.supersample = 1, .shadow = true, .jittered_passes = 1};
    case Quality::figure:
      return {.supersample = 1, .shadow = true, .jittered_passes = 24};
  }
  return {};
}

DrawQuality draw_quality(const MovieStyle& style) {
  DrawQuality quality = draw_quality(style.quality);
  quality.shadow = quality.shadow && style.look.shadow;
  return quality;
}

namespace {

constexpr Colour ink{0.1f, 0.1f, 0.12f, 1}, pale_ink{0.38f, 0.39f, 0.42f, 1};

std::string in_lines(const Canvas& canvas, const std::string& text, double width,
                     const TextStyle& style) {
  std::string all;
  for (const std::string& line : canvas.wrapped(text, width, style))
    all += (all.empty() ? "" : "\n") + line;
  return all;
}

}  // namespace

Image title_card(const MovieStyle& style) {
  const double w = style.width, h = style.height;
  return draw_picture(w, h, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    TextStyle title{.size = style.font_scale * 0.075 * std::min(h, 0.6 * w),
                    .colour = ink,
                    .bold = true,
                    .align_x = AlignX::centre,
                    .align_y = AlignY::middle};
    std::string text = in_lines(canvas, style.title, 0.84 * w, title);
    for (int k = 0; k < 12; ++k) {
      const Box box = canvas.measure(plain(text), title);
      if (box.width <= 0.9 * w && box.height <= 0.5 * h) break;
      title.size *= 0.9;
      text = in_lines(canvas, style.title, 0.84 * w, title);
    }
    canvas.text(plain(text), {w / 2, 0.45 * h}, title);
    TextStyle source{.size = 0.5 * title.size,
                     .colour = pale_ink,
                     .align_x = AlignX::centre,
                     .align_y = AlignY::middle};
    const double width = canvas.measure(plain(style.source), source).width;
    source.size *= std::min(1.0, 0.9 * w / std::max(1.0, width));
    canvas.text(plain(style.source), {w / 2, 0.8 * h}, source);
  });
}

}  // namespace gridshell::render
