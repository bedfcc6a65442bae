#include <algorithm>
#include <cmath>

#include "render/plot/plot_frame.h"

namespace gridshell::render {
namespace {

// does the drawing of a series pass through `box`? sampled along lines, bars and error bars
bool passes(const Series& s, const PlotFrame& frame, const Box& box) {
  const auto inside = [&](Point p) {
    return p.x >= box.x && p.x <= box.right() && p.y >= box.y && p.y <= box.bottom();
  };
  const auto segment = [&](Point p, Point q) {
    for (int m = 0; m <= 24; ++m)
      if (inside({p.x + (q.x - p.x) * m / 24, p.y + (q.y - p.y) * m / 24})) return true;
    return false;
  };
  for (std::size_t k = 0; k < std::min(s.x.size(), s.y.size()); ++k) {
    const Point p = frame.place(s.x[k], s.y[k]);
    if (s.kind == SeriesKind::bars) {
      const double half = std::abs(frame.x.place(s.x[k] + s.bar_width / 2) - p.x);
      const double zero = frame.y.logarithmic ? frame.inside.bottom() : frame.y.place(0);
      if (box.overlaps({p.x - half, std::min(p.y, zero), 2 * half, std::abs(zero - p.y)}))
        return true;
    }
    if (inside(p)) return true;
    if (s.kind == SeriesKind::points && s.line_width > 0 && k > 0 &&
        segment(frame.place(s.x[k - 1], s.y[k - 1]), p))
      return true;
    if (k < s.y_error.size() && segment({p.x, frame.y.place(s.y[k] - s.y_error[k])},
                                        {p.x, frame.y.place(s.y[k] + s.y_error[k])}))
      return true;
  }
  return false;
}

bool hides(const Canvas& canvas, const Plot& plot, const PlotFrame& frame, const Box& box) {
  for (const Series& s : plot.series)
    if (passes(s, frame, box)) return true;
  for (const Note& note : plot.notes)
    if (box.overlaps(note_box(canvas, plot, frame, note))) return true;
  for (const ReferenceLine& line : plot.references) {
    const Box in = frame.inside;
    const double at = line.horizontal ? frame.y.place(line.at) : frame.x.place(line.at);
    const double room = line.label.empty() ? 0.5 : 1.4 * plot.font_size;
    if (box.overlaps(line.horizontal ? Box{in.x, at - room, in.width, 2 * room}
                                     : Box{at - 0.5, in.y, 1, in.height}))
      return true;
  }
  return false;
}

}  // namespace

Legend::Legend(const Canvas& canvas, const Plot& plot)
    : plot_(plot), size_(plot.font_size), row_(1.35 * plot.font_size), key_(2.2 * plot.font_size) {
  if (plot.legend == LegendPlace::none) return;
  for (const Series& s : plot.series)
    if (!s.name.empty()) entries_.push_back({&s, nullptr, s.name});
  for (const Band& b : plot.bands)
    if (!b.name.empty()) entries_.push_back({nullptr, &b, b.name});
  for (Entry& e : entries_)
    e.width = key_ + 0.5 * size_ + canvas.measure(e.name, {.size = size_}).width;
}

Box Legend::corner_box(const Box& in, LegendPlace place) const {
  double width = 0;
  for (const Entry& e : entries_) width = std::max(width, e.width);
  width += 0.8 * size_;
  const double height = double(entries_.size()) * row_ + 0.4 * size_, margin = 0.7 * size_;
  const bool left = place == LegendPlace::upper_left || place == LegendPlace::lower_left;
  const bool upper = place == LegendPlace::upper_left || place == LegendPlace::upper_right;
  return {left ? in.x + margin : in.right() - margin - width,
          upper ? in.y + margin : in.bottom() - margin - height, width, height};
}

LegendPlace Legend::free_corner(const Canvas& canvas, const PlotFrame& frame) const {
  for (LegendPlace place : {LegendPlace::upper_right, LegendPlace::upper_left,
                            LegendPlace::lower_right, LegendPlace::lower_left}) {
    const Box box = corner_box(frame.inside, place);
    if (frame.inside.contains(box) && !hides(canvas, plot_, frame, box)) return place;
  }
  return LegendPlace::none;
}

double Legend::head_height(double width) const {
  double x = 0;
  int rows = 1;
  for (const Entry& e : entries_) {
    if (x > 0 && x + e.width > width) ++rows, x = 0;
    x += e.width + 1.2 * size_;
  }
  return rows * row_ + 0.3 * size_;
}

void Legend::draw_above(Canvas& canvas, const PlotFrame& frame, double top) const {
  double x = 0, y = top + row_ / 2;
  for (const Entry& e : entries_) {
    if (x > 0 && x + e.width > frame.inside.width) x = 0, y += row_;
    draw_entry(canvas, e, frame.inside.x + x, y, frame.inside.right());
    x += e.width + 1.2 * size_;
  }
}

void Legend::draw_in_corner(Canvas& canvas, const PlotFrame& frame, LegendPlace place) const {
  const Box box = corner_box(frame.inside, place);
  canvas.rectangle(box, {1, 1, 1, 0.85f});
  double y = box.y + 0.2 * size_ + row_ / 2;
  for (const Entry& e : entries_) {
    draw_entry(canvas, e, box.x + 0.4 * size_, y, frame.inside.right());
    y += row_;
  }
}

void Legend::draw_entry(Canvas& canvas, const Entry& entry, double x, double middle,
                        double end) const {
  const Box key{x, middle - 0.4 * size_, key_, 0.8 * size_};
  if (entry.band || entry.series->kind == SeriesKind::bars) {
    canvas.rectangle(key.inset(0.08 * size_),
                     entry.band ? entry.band->colour : entry.series->colour);
  } else {
    const Series& s = *entry.series;
    if (s.line_width > 0)
      canvas.line({key.x, middle}, {key.right(), middle}, {s.colour, s.line_width, s.dash});
    const Colour fill = s.hollow ? Colour{1, 1, 1, 1} : s.colour;
    canvas.marker(s.marker, key.middle(), s.marker_size, fill, {s.colour, s.hollow ? 0.9 : 0});
  }
  // a name too long for the plot is set smaller
  TextStyle style{.size = size_, .align_y = AlignY::middle};
  const double at = x + key_ + 0.5 * size_;
  style.size *= std::min(1.0, (end - at) / std::max(1e-9, canvas.measure(entry.name, style).width));
  canvas.text(entry.name, {at, middle}, style);
}

}  // namespace gridshell::render
