#include "render/canvas/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

double bar_thickness(double font_size) { return 0.9 * font_size; }
double tick_length(double font_size) { return 0.3 * font_size; }
// width of the column of the quantity's name next to the ticks
double words_column(const ColourBar& bar, double font_size) {
  return bar.words.empty() ? 0 : 1.35 * font_size;
}

constexpr int fewest_ticks = 2, most_ticks = 6;

std::vector<Tick> bar_ticks(const ColourBar& bar, double height, double font_size) {
  const ColourScale& scale = bar.scale;
  const int count = std::clamp(int(height / (2.2 * font_size)), fewest_ticks, most_ticks);
  std::vector<Tick> ticks = linear_ticks(scale.low, scale.high, count);
  if (!bar.ends) return ticks;
  // ticks whose labels would overlap that of an end are removed
  const double room = 1.3 * font_size / height * (scale.high - scale.low);
  for (const double end : {scale.low, scale.high}) {
    std::erase_if(ticks, [&](const Tick& tick) { return std::abs(tick.value - end) < room; });
    std::string label = fmt::format("{:.3g}", end);
    // a minus sign as wide as those of other ticks
    if (label.starts_with('-')) label.replace(0, 1, "−");
    ticks.push_back({end, label, true});
  }
  return ticks;
}

// width of the widest label on bars of any height, since taller ones have more ticks and digits
double widest_label(const Canvas& canvas, const ColourBar& bar, const TextStyle& style) {
  const ColourScale& scale = bar.scale;
  double width = 0;
  for (const double end : {scale.low, scale.high})
    if (bar.ends) width = std::max(width, canvas.measure(fmt::format("{:.3g}", end), style).width);
  for (int count = fewest_ticks; count <= most_ticks; ++count)
    for (const Tick& tick : linear_ticks(scale.low, scale.high, count))
      if (tick.major) width = std::max(width, canvas.measure(tick.label, style).width);
  return width;
}

// each colour is drawn down to the end of the bar and covered by the next, so that there are no
// seams
void draw_colours(Canvas& canvas, const Box& bar, const ColourScale& scale) {
  const int steps = 128;
  for (int k = 0; k < steps; ++k) {
    const double value = scale.high + (scale.low - scale.high) * (k + 0.5) / steps;
    const double y = bar.y + bar.height * k / steps;
    canvas.rectangle({bar.x, y, bar.width, bar.bottom() - y}, scale(value));
  }
}

// the quantity's name along the right edge, smaller if the bar is short; none if there is no room
void draw_words(Canvas& canvas, const Box& box, const ColourBar& bar, double font_size) {
  if (bar.words.empty() || box.width < colour_bar_width(canvas, bar, font_size) - 0.3 * font_size)
    return;
  constexpr double smallest = 0.955;  // with the 0.9 of its size, 7 points of a page become 6
  TextStyle style{.size = 0.9 * font_size, .align_x = AlignX::centre, .align_y = AlignY::middle};
  style.angle_deg = 90;
  const double fraction = 1.1 * box.height / std::max(1.0, canvas.measure(bar.words, style).width);
  if (fraction < smallest) return;
  style.size *= std::min(1.0, fraction);
  canvas.text(bar.words, {box.right() - 0.55 * font_size, box.middle().y}, style);
}

/// Draws a bar or arrow of this length at the bottom of the box, in the middle, with its label
/// above. Returns false if there is no room.
bool draw_length(Canvas& canvas, const Box& box, double length, const std::string& label,
                 double font_size, const std::function<void(const Box&)>& draw) {
  const double thickness = 0.22 * font_size;
  const TextStyle style{.size = font_size, .align_x = AlignX::centre, .align_y = AlignY::bottom};
  const Box text = canvas.measure(label, style);
  if (!(length > 0) || std::max(length, text.width) > box.width ||
      text.height + 2 * thickness > box.height)
    return false;
  const double x = box.middle().x, y = box.bottom() - thickness;
  draw({x - length / 2, y, length, thickness});
  canvas.text(label, {x, y - thickness}, style);
  return true;
}

}  // namespace

double colour_bar_width(const Canvas& canvas, const ColourBar& bar, double font_size) {
  const TextStyle style{.size = font_size};
  const double ticks = widest_label(canvas, bar, style);
  const double with_ticks =
      bar_thickness(font_size) + tick_length(font_size) + 0.25 * font_size + ticks;
  const double words = words_column(bar, font_size);
  return std::max(with_ticks + words, canvas.measure(bar.label, style).width) + 0.2 * font_size;
}

double colour_bar_width(const ColourBar& bar, double font_size) {
  double width = 0;
  (void)draw_picture(1, 1, 1, {}, [&](Canvas& c) { width = colour_bar_width(c, bar, font_size); });
  return width;
}

void draw_colour_bar(Canvas& canvas, const Box& box, const ColourBar& bar, double font_size) {
  const TextStyle style{.size = font_size};
  const double line = canvas.measure("0", style).height;
  canvas.text(bar.label, {box.x, box.y}, {.size = font_size, .align_y = AlignY::top});

  // room for the label, for half a line of the outermost ticks' labels, and for the pointed ends
  const double point = 0.7 * bar_thickness(font_size);
  const double top = box.y + 1.25 * line + std::max(line / 2, bar.above_scale ? point : 0);
  const double bottom = box.bottom() - std::max(line / 2, bar.below_scale ? point : 0);
  const Box body{box.x, top, bar_thickness(font_size), bottom - top};
  if (body.height < line) return;

  draw_colours(canvas, body, bar.scale);
  std::vector<Point> rim = {{body.x, body.y}};
  const double middle = body.middle().x;
  if (bar.above_scale) {
    canvas.polygon({{body.x, body.y}, {middle, body.y - point}, {body.right(), body.y}},
                   bar.scale(bar.scale.high));
    rim.push_back({middle, body.y - point});
  }
  rim.insert(rim.end(), {{body.right(), body.y}, {body.right(), body.bottom()}});
  if (bar.below_scale) {
    canvas.polygon(
        {{body.x, body.bottom()}, {middle, body.bottom() + point}, {body.right(), body.bottom()}},
        bar.scale(bar.scale.low));
    rim.push_back({middle, body.bottom() + point});
  }
  rim.push_back({body.x, body.bottom()});
  canvas.polyline(rim, {ink, font_size / 14}, true);

  draw_words(canvas, {box.x, body.y, box.width, body.height}, bar, font_size);
  for (const Tick& tick : bar_ticks(bar, body.height, font_size)) {
    if (!tick.major) continue;
    const double t = (tick.value - bar.scale.low) / (bar.scale.high - bar.scale.low);
    const double y = body.bottom() - t * body.height, x = body.right();
    canvas.line({x, y}, {x + tick_length(font_size), y}, {ink, font_size / 14});
    canvas.text(tick.label, {x + tick_length(font_size) + 0.25 * font_size, y},
                {.size = font_size, .align_y = AlignY::middle});
  }
}

std::string scale_bar_text(double length_mm) {
  const bool metres = length_mm >= 1000;
  const double length = metres ? 1e-3 * length_mm : length_mm;
  return (length == std::round(length) ? fixed(length, 0) : scientific(length, 2)) +
         (metres ? " m" : " mm");
}

bool draw_scale_bar(Canvas& canvas, const Box& box, double length_mm, double units_per_mm,
                    double font_size) {
  return draw_length(canvas, box, length_mm * units_per_mm, scale_bar_text(length_mm), font_size,
                     [&](const Box& bar) { canvas.rectangle(bar, ink); });
}

bool draw_arrow_key(Canvas& canvas, const Box& box, const ArrowKey& key, double units_per_mm,
                    double font_size) {
  return draw_length(
      canvas, box, key.length_mm * units_per_mm, key.name, font_size, [&](const Box& at) {
        const double y = at.middle().y;
        draw_arrow(canvas, {at.x, y}, {at.right(), y}, {key.colour, 0.16 * font_size});
      });
}

void draw_arrow(Canvas& canvas, Point from, Point to, const Stroke& shaft) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length < 1e-9) return;
  const double head = std::min(4.5 * shaft.width, 0.6 * length), half = 1.4 * shaft.width;
  const double x = (to.x - from.x) / length, y = (to.y - from.y) / length;
  const Point neck{to.x - head * x, to.y - head * y};
  canvas.line(from, neck, shaft);
  canvas.polygon(
      {{neck.x - half * y, neck.y + half * x}, to, {neck.x + half * y, neck.y - half * x}},
      shaft.colour);
}

void draw_colour_keys(Canvas& canvas, const Box& box, const std::vector<ColourKey>& keys,
                      double font_size) {
  // lengths over the font's size
  constexpr double dash = 1.6, thickness = 0.22, after_dash = 0.5, between = 1.6;
  const auto width_of = [&](double size) {
    double width = -between * size;
    for (const ColourKey& key : keys)
      width +=
          (dash + after_dash + between) * size + canvas.measure(key.name, {.size = size}).width;
    return width;
  };
  const double size = font_size * std::min(1.0, box.width / std::max(1.0, width_of(font_size)));
  Point at{box.middle().x - width_of(size) / 2, box.middle().y};
  for (const ColourKey& key : keys) {
    canvas.rectangle({at.x, at.y - thickness * size / 2, dash * size, thickness * size},
                     key.colour);
    at.x += (dash + after_dash) * size;
    const TextStyle style{.size = size, .align_y = AlignY::middle};
    canvas.text(key.name, at, style);
    at.x += canvas.measure(key.name, style).width + between * size;
  }
}

void draw_patches(Canvas& canvas, const Box& first, const Patches& patches) {
  constexpr std::size_t columns = 4;
  for (std::size_t k = 0; k < patches.names.size(); ++k) {
    Box box = first;
    box.x += patches.row_width / columns * double(k % columns);
    const std::size_t row = k / columns;
    box.y += patches.row_height * double(row);
    patches.draw(k, box);
    canvas.text(patches.names[k], {box.right() + 4, box.middle().y},
                {.size = patches.font_size, .align_y = AlignY::middle});
  }
}

}  // namespace gridshell::render
