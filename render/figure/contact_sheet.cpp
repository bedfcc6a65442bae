#include "render/figure/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/plot/canvas.h"

namespace gridshell::render {
namespace {

constexpr double margin = 12, line = 22, size = 13;
constexpr Colour ink{0.1f, 0.1f, 0.12f, 1}, empty_ink{0.8f, 0.8f, 0.82f, 1};

double cell_height(const PicturePair& pair, double width) {
  double height = 0;
  for (const auto* image : {&pair.before, &pair.after})
    if (*image) height = std::max(height, width * (*image)->height / (*image)->width);
  return std::min(height, 1.5 * width);
}

// as large as the cell allows, at its upper left
void draw_in(Canvas& canvas, const Box& cell, const std::optional<Image>& image) {
  if (!image) {
    canvas.rectangle(cell, {0, 0, 0, 0}, {empty_ink, 1, {4, 3}});
    canvas.text(
        "none", cell.middle(),
        {.size = size, .colour = empty_ink, .align_x = AlignX::centre, .align_y = AlignY::middle});
    return;
  }
  const double scale = std::min(cell.width / image->width, cell.height / image->height);
  const Box box{cell.x, cell.y, scale * image->width, scale * image->height};
  canvas.picture(*image, box);
  canvas.rectangle(box, {0, 0, 0, 0}, {empty_ink, 0.5});
}

void draw_row(Canvas& canvas, double top, double width, const PicturePair& pair, double threshold) {
  const Verdict verdict = judge(pair, threshold);
  canvas.text(plain(pair.name + ": " + verdict.text), {margin, top + line / 2},
              {.size = size, .colour = ink, .bold = true, .align_y = AlignY::middle});
  std::optional<Image> difference;
  if (verdict.worst) difference = difference_picture(*pair.before, *pair.after, *verdict.worst);
  const double height = cell_height(pair, width);
  int column = 0;
  for (const std::optional<Image>* image :
       {&pair.before, &pair.after, static_cast<const std::optional<Image>*>(&difference)}) {
    draw_in(canvas, {margin + column * (width + margin), top + line, width, height}, *image);
    ++column;
  }
}

}  // namespace

Verdict judge(const PicturePair& pair, double threshold) {
  if (!pair.before) return {false, "is new", {}};
  if (!pair.after) return {false, "is gone", {}};
  const auto worst = compare(*pair.before, *pair.after);
  if (!worst) return {false, worst.error().message, {}};
  const bool same = worst->same(threshold);
  return {same,
          fmt::format("{} by {:.2f} of 255 at ({}, {})", same ? "the same, differs" : "differs",
                      worst->difference, worst->x, worst->y),
          *worst};
}

Image contact_sheet(const std::vector<PicturePair>& pairs, double threshold, double cell_width) {
  double height = margin + line;
  for (const PicturePair& pair : pairs) height += line + cell_height(pair, cell_width) + margin;
  const double width = margin + 3 * (cell_width + margin);
  return draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    int column = 0;
    for (const char* head : {"before", "after", "difference"})
      canvas.text(head, {margin + column++ * (cell_width + margin), margin + line / 4},
                  {.size = size, .colour = ink, .align_y = AlignY::middle});
    double top = margin + line;
    for (const PicturePair& pair : pairs) {
      draw_row(canvas, top, cell_width, pair, threshold);
      top += line + cell_height(pair, cell_width) + margin;
    }
  });
}

}  // namespace gridshell::render
