#include "render/movie/frame_layout.h"

#include <algorithm>

namespace gridshell::render {
namespace {

double bar_width(const ColourBar& bar, double font_size) {
  double width = 0;
  draw_picture(1, 1, 1, {},
               [&](Canvas& canvas) { width = colour_bar_width(canvas, bar, font_size); });
  return width;
}

// the title in at most two lines; what is longer still is shortened
std::vector<std::string> lines_of_title(const MovieStyle& style, double width, double font_size) {
  std::vector<std::string> lines;
  draw_picture(1, 1, 1, {}, [&](Canvas& canvas) {
    const TextStyle font = title_style(style, font_size);
    lines = canvas.wrapped(style.title, width, font);
    for (; lines.size() > 2; lines.pop_back()) lines[lines.size() - 2] += " " + lines.back();
    for (std::string& line : lines) line = canvas.shortened(line, width, font);
  });
  return lines;
}

// cuts a strip off one side of `box` and returns it
Box cut_top(Box& box, double height) {
  const Box strip{box.x, box.y, box.width, height};
  box.y += height;
  box.height -= height;
  return strip;
}
Box cut_bottom(Box& box, double height) {
  box.height -= height;
  return {box.x, box.bottom(), box.width, height};
}
Box cut_right(Box& box, double width) {
  box.width -= width;
  return {box.right(), box.y, width, box.height};
}

}  // namespace

TextStyle title_style(const MovieStyle& style, double font_size) {
  return {.size = (style.captions ? 1.15 : 1) * font_size,
          .colour = {0.1f, 0.1f, 0.12f, 1},
          .bold = true};
}

FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar) {
  FrameLayout layout;
  const double w = style.width, h = style.height;
  // readable down to small pictures, and no wider than a tall one allows
  const double em = layout.font_size =
      style.font_scale * std::max(7.5, 0.024 * std::min(h, 0.72 * w));
  const double margin = std::min(0.9 * em, 0.06 * std::min(w, h)), line = 1.5 * em;
  Box rest = Box{0, 0, w, h}.inset(margin);
  const bool captions = style.captions && rest.height > 10 * line && rest.width > 14 * em;
  const bool wide = w >= 1.15 * h;

  // legends first: a column on the right or a strip below
  const double side = std::min(0.3 * h, 0.28 * w);
  const bool inset = style.inset && side > 4 * em;
  const double bar_wide = bar ? bar_width(*bar, 0.95 * em) : 0;
  const double bar_tall = wide ? std::min(0.42 * h, 20 * em) : side;
  bool with_bar = bar && bar_tall > 5 * line && bar_wide < 0.4 * rest.width;
  if (wide && style.bins && 0.42 * w > 16 * em && rest.height > 16 * em) {
    // a plot above, the small legends beside one another below it
    Box column = cut_right(rest, 0.42 * w);
    cut_right(rest, margin);
    layout.plot = cut_top(column, 0.62 * column.height);
    cut_top(column, margin);
    if (with_bar) {
      layout.colour_bar = cut_right(column, bar_wide);
      cut_right(column, 2 * margin);
    }
    const double square = std::min({side, column.width, column.height});
    if (inset) layout.inset = {column.right() - square, column.y, square, square};
  } else if (wide && (inset || with_bar)) {
    Box column = cut_right(rest, std::max(inset ? side : 0, with_bar ? bar_wide : 0));
    cut_right(rest, margin);
    if (inset) {
      const Box top = cut_top(column, side);
      layout.inset = {top.right() - side, top.y, side, side};
      cut_top(column, margin);
    }
    with_bar = with_bar && column.height > 5 * line;
    if (with_bar) {
      const double tall = std::min(bar_tall, column.height);
      layout.colour_bar = {column.right() - bar_wide, column.bottom() - tall, bar_wide, tall};
    }
  } else if (inset || with_bar) {
    const Box strip = cut_bottom(rest, side);
    cut_bottom(rest, margin / 2);
    if (inset) layout.inset = {strip.x, strip.y, side, side};
    if (with_bar) layout.colour_bar = {strip.right() - bar_wide, strip.y, bar_wide, side};
  }

  if (captions) {
    layout.title_lines = lines_of_title(style, rest.width, em);
    const double lines = std::max(1.0, double(layout.title_lines.size()));
    layout.title = cut_top(rest, 1.15 * line * lines);
    layout.state = cut_top(rest, line);
  }
  if (!captions && style.heading) {
    // over the colour bar too, but not over a plot
    const double right = layout.plot.empty() ? w : rest.right(), x = still_margin * em;
    layout.title_lines = lines_of_title(style, right - 2 * x, em);
    const double lines = std::max(1.0, double(layout.title_lines.size()));
    cut_top(rest, (1.2 + lines) * line);
    layout.heading = {x, x, right - 2 * x, (1 + lines) * line};
  }
  const bool scale_bar = style.scale_bar_mm > 0 && rest.height > 6 * line;
  Box foot = cut_bottom(rest, captions ? 2.8 * line : (scale_bar ? 1.7 * line : 0));
  if (scale_bar) {
    Box place = cut_right(foot, 0.4 * foot.width);
    layout.scale_bar = cut_bottom(place, 1.7 * line);
  }
  if (captions) {
    layout.timeline = cut_bottom(foot, 0.8 * line);
    layout.progress = cut_bottom(foot, line);
    layout.event = foot;
  }
  layout.view = rest.inset(0.5 * margin);
  return layout;
}

}  // namespace gridshell::render
