#include "render/movie/timeline.h"

#include <algorithm>
#include <string>

namespace gridshell::render {
namespace {

constexpr Colour way{0.84f, 0.84f, 0.86f, 1}, done{0.45f, 0.47f, 0.5f, 1},
    ink{0.38f, 0.39f, 0.42f, 1};

struct Sign {
  MarkKind kind;
  const char* word;
  Marker marker;
  Colour colour;
};
constexpr Sign signs[] = {
    {MarkKind::unstable, "unstable", Marker::square, {0.80f, 0.12f, 0.10f, 1}},
    {MarkKind::motion, "in motion", Marker::square, {0.93f, 0.60f, 0.15f, 1}},
    {MarkKind::snap, "snap", Marker::diamond, {0.10f, 0.32f, 0.62f, 1}},
    {MarkKind::lock, "locked", Marker::triangle, {0.30f, 0.16f, 0.45f, 1}}};

bool reached(const std::vector<Mark>& marks, MarkKind kind, int at) {
  return std::any_of(marks.begin(), marks.end(),
                     [&](const Mark& mark) { return mark.kind == kind && mark.at <= at; });
}

// a coloured length for a state that lasts, a sign for a moment
void draw_marks(Canvas& canvas, const Box& bar, const std::vector<Mark>& marks, int at, int frames,
                double size) {
  const double step = bar.width / std::max(1, frames - 1);
  const auto place = [&](double frame) {
    return std::clamp(bar.x + frame * step, bar.x, bar.right());
  };
  for (const Sign& sign : signs)
    for (const Mark& mark : marks) {
      if (mark.kind != sign.kind || mark.at > at) continue;
      if (sign.marker == Marker::square) {
        const double from = place(mark.at - 0.5), to = place(std::min(mark.at + 0.5, double(at)));
        const double width = std::max(to - from, 0.12 * size);
        canvas.rectangle({std::min(from, bar.right() - width), bar.y, width, bar.height},
                         sign.colour);
      } else {
        canvas.marker(sign.marker, {place(mark.at), bar.middle().y}, 0.7 * size, sign.colour,
                      {{1, 1, 1, 1}, 0.08 * size});
      }
    }
}

}  // namespace

void draw_timeline(Canvas& canvas, const Box& box, const std::vector<Mark>& marks, int at,
                   int frames, double font_size) {
  // what stands beside the bar over the whole run decides its length, so that it does not move
  const double size = 0.8 * font_size, gap = 0.5 * size;
  double words = 0;
  for (const Sign& sign : signs)
    if (reached(marks, sign.kind, frames))
      words += size + gap + canvas.measure(sign.word, {.size = size}).width + 2 * gap;
  const double length = std::min(box.width - words, std::max(0.3 * box.width, 16 * font_size));
  if (length < 4 * font_size || frames < 2) return;
  const Box bar{box.x, box.middle().y - 0.16 * font_size, length, 0.32 * font_size};
  canvas.rectangle(bar, way);
  canvas.rectangle({bar.x, bar.y, bar.width * at / (frames - 1), bar.height}, done);
  draw_marks(canvas, bar, marks, at, frames, font_size);
  double x = bar.right() + 2 * gap;
  for (const Sign& sign : signs) {
    if (!reached(marks, sign.kind, at)) continue;
    canvas.marker(sign.marker, {x + size / 2, box.middle().y}, 0.8 * size, sign.colour, {{}, 0});
    x += size + gap;
    x = canvas
            .text(sign.word, {x, box.middle().y},
                  {.size = size, .colour = ink, .align_y = AlignY::middle})
            .right() +
        2 * gap;
  }
}

}  // namespace gridshell::render
