// Where a picture has ink, for tests of what is drawn.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <utility>

#include "render/canvas/plot.h"
#include "render/gl/image.h"

namespace gridshell::test {

/// While it exists, `reported` gets every finished canvas.
struct CanvasObserver {
  explicit CanvasObserver(std::function<void(const render::Canvas&)> reported) {
    render::Canvas::on_finished = std::move(reported);
  }
  ~CanvasObserver() { render::Canvas::on_finished = nullptr; }
  CanvasObserver(const CanvasObserver&) = delete;
  CanvasObserver& operator=(const CanvasObserver&) = delete;
};

/// Checks that all texts are on the canvas and that none overlaps another, nor, with
/// `off_markers`, a marker.
inline void check_apart(const render::Canvas& canvas, bool off_markers = false) {
  const std::vector<render::Box>& boxes = canvas.text_boxes();
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    INFO(canvas.texts()[a]);
    CHECK((boxes[a].empty() ||
           render::Box{0, 0, canvas.width(), canvas.height()}.contains(boxes[a])));
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      INFO(canvas.texts()[b]);
      CHECK_FALSE(boxes[a].overlaps(boxes[b]));
    }
    if (off_markers)
      for (const render::Box& marker : canvas.marker_boxes())
        CHECK_FALSE(boxes[a].overlaps(marker));
  }
}

inline bool has(const std::vector<std::string>& texts, const std::string& text) {
  return std::ranges::find(texts, text) != texts.end();
}

/// The series of that name; null: there is none.
inline const render::Series* series_named(const render::Plot& plot, const std::string& name) {
  const auto found = std::ranges::find(plot.series, name, &render::Series::name);
  return found == plot.series.end() ? nullptr : &*found;
}

/// The smallest box around all pixels that differ from white by more than `level` in any channel.
inline render::Box ink_box(const render::Image& image, int level = 24) {
  int x0 = image.width, y0 = image.height, x1 = -1, y1 = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      if (255 - std::min({p[0], p[1], p[2]}) <= level) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  if (x1 < 0) return {};
  return {double(x0), double(y0), double(x1 - x0 + 1), double(y1 - y0 + 1)};
}

/// Whether the outermost pixels are all white: nothing drawn has been cut off.
inline bool rim_is_white(const render::Image& image) {
  const render::Box ink = ink_box(image, 0);
  return ink.empty() ||
         (ink.x > 0 && ink.y > 0 && ink.right() < image.width && ink.bottom() < image.height);
}

}  // namespace gridshell::test
