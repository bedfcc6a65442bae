#include "render/figure/page.h"

#include <algorithm>

namespace gridshell::render {
namespace {

constexpr double points_per_mm = 72 / 25.4, letter_room = 10, caption_room = 12;  // points
constexpr Colour pale{0.75f, 0.75f, 0.77f, 1};

}  // namespace

Box fitted(const Box& box, double aspect) {
  const double width = std::min(box.width, box.height * aspect), height = width / aspect;
  return {box.middle().x - width / 2, box.middle().y - height / 2, width, height};
}

void draw_fitted(Canvas& canvas, const Box& box, const Image& image) {
  canvas.picture(image, fitted(box, double(image.width) / image.height));
}

void draw_empty_frame(Canvas& canvas, const Box& box, const std::string& of_what) {
  canvas.rectangle(box, {0, 0, 0, 0}, {pale, 0.7, {4, 3}});
  canvas.text(of_what, box.middle(),
              {.size = 8, .colour = pale, .align_x = AlignX::centre, .align_y = AlignY::middle});
}

Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print, bool lines) {
  const auto draw = [&](Canvas& canvas, bool as_lines) {
    for (const PagePanel& panel : panels) {
      const Box& mm = panel.box_mm;
      Box box{points_per_mm * mm.x, points_per_mm * mm.y, points_per_mm * mm.width,
              points_per_mm * mm.height};
      const Point corner{box.x, box.y};
      box.x += letter_room;
      box.width -= letter_room;
      if (!panel.caption.empty()) {
        box.height -= caption_room;
        canvas.text(panel.caption, {box.middle().x, box.bottom() + caption_room / 2},
                    {.size = 7.5, .align_x = AlignX::centre, .align_y = AlignY::middle});
      }
      (as_lines && panel.draw_lines ? panel.draw_lines : panel.draw)(canvas, box);
      // over what was drawn: "B1" is wider than the room beside it
      if (!panel.letter.empty())
        canvas.text(panel.letter, corner, {.size = 9.5, .bold = true, .align_y = AlignY::top});
    }
  };
  const auto write = [&](const std::filesystem::path& to, bool as_lines) {
    return write_figure(
        to, points_per_mm * width_mm, points_per_mm * height_mm, title,
        [&](Canvas& canvas) { draw(canvas, as_lines); }, print);
  };
  return write(stem, false).and_then([&] {
    return lines ? write(std::filesystem::path(stem) += "_lines", true) : Result<void>{};
  });
}

}  // namespace gridshell::render
