#include "render/movie/page.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace gridshell::render {
namespace {

constexpr double letter_room = 10, caption_room = 12;  // points
constexpr Colour pale{0.75f, 0.75f, 0.77f, 1};

constexpr double margin = 12, line = 22, size = 13;
constexpr Colour empty_ink{0.8f, 0.8f, 0.82f, 1};

double cell_height(const PicturePair& pair, double width) {
  double height = 0;
  for (const auto* image : {&pair.before, &pair.after})
    if (*image) height = std::max(height, width * (*image)->height / (*image)->width);
  return std::min(height, 1.5 * width);
}

// draws a picture as large as the cell allows, at its upper left
void draw_in(Canvas& canvas, const Box& cell, const std::optional<Image>& image) {
  if (!image) {
    canvas.rectangle(cell, {0, 0, 0, 0}, {empty_ink, 1, {4, 3}});
    canvas.text(
        "none", cell.middle(),
        {.size = size, .colour = ink, .align_x = AlignX::centre, .align_y = AlignY::middle});
    return;
  }
  const double scale = std::min(cell.width / image->width, cell.height / image->height);
  const Box box{cell.x, cell.y, scale * image->width, scale * image->height};
  canvas.picture(*image, box);
  canvas.rectangle(box, {0, 0, 0, 0}, {empty_ink, 0.5});
}

void draw_row(Canvas& canvas, double top, double width, const PicturePair& pair, double threshold) {
  const ComparisonVerdict verdict = compare_versions(pair, threshold);
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
              {.size = 8, .colour = ink, .align_x = AlignX::centre, .align_y = AlignY::middle});
}

Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print, bool drawn) {
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
      // after the drawing, since a letter like "B1" may be wider than its room
      if (!panel.letter.empty())
        canvas.text(panel.letter, corner, {.size = 9.5, .bold = true, .align_y = AlignY::top});
    }
  };
  const auto write = [&](const std::filesystem::path& to, bool as_lines) {
    return write_figure(
        to, points_per_mm * width_mm, points_per_mm * height_mm, title,
        [&](Canvas& canvas) { draw(canvas, as_lines); }, print);
  };
  return write(stem, true).and_then([&] {
    return drawn ? write(std::filesystem::path(stem) += "_drawn", false) : Result<void>{};
  });
}

ComparisonVerdict compare_versions(const PicturePair& pair, double threshold) {
  if (!pair.before) return {false, "is new", {}};
  if (!pair.after) return {false, "is missing", {}};
  const auto worst = compare(*pair.before, *pair.after);
  if (!worst) return {false, worst.error().message, {}};
  const bool same = worst->same(threshold);
  return {same,
          fmt::format("{} by {:.2f} of 255 at ({}, {})", same ? "the same, differs" : "differs",
                      worst->difference, worst->x, worst->y),
          *worst};
}

Result<Image> contact_sheet(const std::vector<PicturePair>& pairs, double threshold,
                            double cell_width) {
  double height = margin + line;
  for (const PicturePair& pair : pairs) height += line + cell_height(pair, cell_width) + margin;
  const double width = margin + 3 * (cell_width + margin);
  constexpr double least_scale = 0.3;
  const double scale = std::min(1.0, std::floor(largest_side / height * 1e3) / 1e3);
  if (scale < least_scale)
    return invalid(
        "--difference: a sheet of {} pictures is {:.0f} pixels high, expected at most "
        "{:.0f}: compare fewer at once",
        pairs.size(), height, largest_side / least_scale);
  return draw_picture(width, height, scale, {1, 1, 1, 1}, [&](Canvas& canvas) {
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
