#include "render/canvas/plot_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gridshell::render {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Range {
  double low = infinity, high = -infinity;
  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Range data_range(const Plot& plot, bool of_x) {
  const bool logarithmic = of_x ? plot.x.logarithmic : plot.y.logarithmic;
  Range range;
  for (const Series& s : plot.series) {
    const auto& values = of_x ? s.x : s.y;
    for (std::size_t k = 0; k < values.size(); ++k) {
      double room = s.kind == SeriesKind::bars && of_x ? s.bar_width / 2 : 0;
      if (!of_x && k < s.y_error.size() && std::isfinite(s.y_error[k])) room = s.y_error[k];
      range.add(values[k] - room, logarithmic);
      range.add(values[k] + room, logarithmic);
      if (s.kind == SeriesKind::bars && !of_x) range.add(0, logarithmic);
    }
  }
  for (const Series& s : plot.series)
    for (const auto& span : s.x_span)
      if (of_x) range.add(span[0], logarithmic), range.add(span[1], logarithmic);
  for (const Band& band : plot.bands) {
    for (double v : of_x ? band.x : band.low) range.add(v, logarithmic);
    if (!of_x)
      for (double v : band.high) range.add(v, logarithmic);
  }
  for (const ReferenceLine& line : plot.references)
    if (line.horizontal != of_x) range.add(line.at, logarithmic);
  for (const Note& note : plot.notes) range.add(of_x ? note.x : note.y, logarithmic);
  return range;
}

// the range of an axis: its given ends, or those of the data with a margin of 5 %
PlotAxis choose_range(const Plot& plot, bool of_x) {
  const Axis& axis = of_x ? plot.x : plot.y;
  Range range = data_range(plot, of_x);
  if (!(range.low <= range.high)) range = axis.logarithmic ? Range{1, 10} : Range{0, 1};
  const auto warp = [&](double v) { return axis.logarithmic ? std::log10(v) : v; };
  const auto unwarp = [&](double v) { return axis.logarithmic ? std::pow(10.0, v) : v; };
  double low = warp(axis.low.value_or(range.low)), high = warp(axis.high.value_or(range.high));
  if (!(high > low)) {
    const double room = axis.logarithmic ? 0.5 : std::max(std::abs(low) * 0.5, 0.5);
    if (!axis.low) low -= room;
    high = std::max(low + room, high + (axis.high ? 0 : room));
  }
  const double room = 0.05 * (high - low);
  const bool bars_from_low =
      !of_x && range.low == 0 &&
      std::ranges::any_of(plot.series, [](const Series& s) { return s.kind == SeriesKind::bars; });
  if (!axis.low && !bars_from_low) low -= room;
  if (!axis.high) high += room;
  return {axis.low.value_or(unwarp(low)), axis.high.value_or(unwarp(high)), axis.logarithmic, 0, 1};
}

std::vector<Tick> ticks_of(const PlotAxis& axis, int count) {
  if (count == 0) return {};
  return axis.logarithmic ? log_ticks(axis.low, axis.high, count)
                          : linear_ticks(axis.low, axis.high, count);
}

double widest(const Canvas& canvas, const std::vector<Tick>& ticks, const TextStyle& style) {
  double width = 0;
  for (const Tick& tick : ticks)
    if (tick.major) width = std::max(width, canvas.measure(tick.label, style).width);
  return width;
}

// the ticks along x, so few that their labels do not touch
std::vector<Tick> ticks_without_overlap(const Canvas& canvas, const PlotAxis& axis, int count,
                                        const TextStyle& style) {
  for (;; --count) {
    std::vector<Tick> ticks = ticks_of(axis, count);
    double end = -infinity;
    bool overlap = false;
    for (const Tick& tick : ticks) {
      if (!tick.major) continue;
      const double half = canvas.measure(tick.label, style).width / 2,
                   at = axis.coordinate(tick.value);
      overlap |= at - half < end;
      end = at + half + 0.6 * style.size;
    }
    if (!overlap || count <= 2) return ticks;
  }
}

// whether the drawing of a series passes through `box`, sampled along lines and error bars
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
    const Point p = frame.point_at(s.x[k], s.y[k]);
    if (s.kind == SeriesKind::bars) {
      const double half = std::abs(frame.x.coordinate(s.x[k] + s.bar_width / 2) - p.x);
      const double zero = frame.y.logarithmic ? frame.inside.bottom() : frame.y.coordinate(0);
      if (box.overlaps({p.x - half, std::min(p.y, zero), 2 * half, std::abs(zero - p.y)}))
        return true;
    }
    if (inside(p)) return true;
    if (s.kind == SeriesKind::points && s.line_width > 0 && k > 0 &&
        segment(frame.point_at(s.x[k - 1], s.y[k - 1]), p))
      return true;
    if (k < s.y_error.size() && segment({p.x, frame.y.coordinate(s.y[k] - s.y_error[k])},
                                        {p.x, frame.y.coordinate(s.y[k] + s.y_error[k])}))
      return true;
    if (k < s.x_span.size() && segment({frame.x.coordinate(s.x_span[k][0]), p.y},
                                       {frame.x.coordinate(s.x_span[k][1]), p.y}))
      return true;
  }
  return false;
}

// whether a band between two curves passes through `box`; a band with an open end is a region of
// the plot, not data
bool passes(const Band& band, const PlotFrame& frame, const Box& box) {
  constexpr int samples = 24;
  for (std::size_t k = 0; k + 1 < band.x.size(); ++k)
    for (int m = 0; m <= samples; ++m) {
      const double part = double(m) / samples,
                   x = frame.x.coordinate(std::lerp(band.x[k], band.x[k + 1], part)),
                   low = frame.y.coordinate(std::lerp(band.low[k], band.low[k + 1], part)),
                   high = frame.y.coordinate(std::lerp(band.high[k], band.high[k + 1], part));
      if (std::isfinite(low + high) && x >= box.x && x <= box.right() &&
          std::min(low, high) <= box.bottom() && std::max(low, high) >= box.y)
        return true;
    }
  return false;
}

bool hides(const Canvas& canvas, const Plot& plot, const PlotFrame& frame, const Box& box) {
  for (const Series& s : plot.series)
    if (passes(s, frame, box)) return true;
  for (const Band& band : plot.bands)
    if (passes(band, frame, box)) return true;
  for (const Note& note : plot.notes)
    if (box.overlaps(note_box(canvas, plot, frame, note))) return true;
  for (const ReferenceLine& line : plot.references) {
    const Box in = frame.inside;
    const double at = line.horizontal ? frame.y.coordinate(line.at) : frame.x.coordinate(line.at);
    const double room = line.label.empty() ? 0.5 : 1.4 * plot.font_size;
    if (box.overlaps(line.horizontal ? Box{in.x, at - room, in.width, 2 * room}
                                     : Box{at - 0.5, in.y, 1, in.height}))
      return true;
  }
  return false;
}

}  // namespace

double PlotAxis::coordinate(double value) const {
  if (logarithmic && !(value > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double t =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from + t * (to - from);
}

std::string title_in_lines(const Canvas& canvas, const Box& box, const Plot& plot) {
  const TextStyle style{.size = plot.font_size, .bold = true};
  std::string text;
  std::istringstream lines(plot.title);
  for (std::string line; std::getline(lines, line);) {
    const bool fits = canvas.measure(line, style).width <= box.width;
    for (const std::string& part :
         fits ? std::vector{line} : canvas.wrapped_marked(line, box.width, style))
      text += (text.empty() ? "" : "\n") + part;
  }
  return text;
}

TextStyle title_style(const Canvas& canvas, const Box& box, const Plot& plot) {
  const TextStyle style{
      .size = plot.font_size, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::top};
  return canvas.fitted(title_in_lines(canvas, box, plot), box.width, style);
}

double title_height(const Canvas& canvas, const Box& box, const Plot& plot) {
  if (plot.title.empty()) return 0;
  return canvas.measure(title_in_lines(canvas, box, plot), title_style(canvas, box, plot)).height +
         0.3 * plot.font_size;
}

PlotFrame lay_out_plot(const Canvas& canvas, const Box& box, const Plot& plot, double head) {
  const TextStyle style{.size = plot.font_size};
  const double line = canvas.measure("0", style).height, gap = 0.35 * plot.font_size;
  PlotFrame frame{{}, choose_range(plot, true), choose_range(plot, false), {}, {}};

  const double top = box.y + head + std::max(line / 2, title_height(canvas, box, plot));
  const double bottom = box.bottom() - line - gap - (plot.x.label.empty() ? 0 : 1.15 * line);
  frame.y.from = bottom;
  frame.y.to = top;
  const int rows = std::max(2, int((bottom - top) / (1.8 * line)));
  frame.y_ticks = ticks_of(frame.y, std::min(plot.y.ticks, rows));

  // a label with a subscript is taller than a line
  const double label = plot.y.label.empty()
                           ? 0
                           : std::max(1.2 * line, canvas.measure(plot.y.label, style).height +
                                                      0.35 * plot.font_size);
  const double left =
      box.x + std::max(plot.labels_width, label + widest(canvas, frame.y_ticks, style) + gap);
  // half of the last label may be to the right of the frame
  const double right = box.right() - widest(canvas, ticks_of(frame.x, plot.x.ticks), style) / 2 - 1;
  frame.x.from = left;
  frame.x.to = right;
  frame.x_ticks = ticks_without_overlap(canvas, frame.x, plot.x.ticks, style);
  frame.inside = {left, top, right - left, bottom - top};
  return frame;
}

double labels_width(const Canvas& canvas, const Box& box, const Plot& plot) {
  return lay_out_plot(canvas, box, plot, 0).inside.x - box.x;
}

void draw_axes(Canvas& canvas, const Box& box, const Plot& plot, const PlotFrame& frame) {
  const Box& in = frame.inside;
  const double size = plot.font_size, long_tick = 0.4 * size, short_tick = 0.22 * size;
  const Stroke stroke{ink, size / 12};
  canvas.rectangle(in, {0, 0, 0, 0}, stroke);
  // ticks point inwards, on both sides
  for (const Tick& tick : frame.x_ticks) {
    const double x = frame.x.coordinate(tick.value), length = tick.major ? long_tick : short_tick;
    canvas.line({x, in.bottom()}, {x, in.bottom() - length}, stroke);
    canvas.line({x, in.y}, {x, in.y + length}, stroke);
    if (tick.major)
      canvas.text(tick.label, {x, in.bottom() + 0.3 * size},
                  {.size = size, .align_x = AlignX::centre, .align_y = AlignY::top});
  }
  for (const Tick& tick : frame.y_ticks) {
    const double y = frame.y.coordinate(tick.value), length = tick.major ? long_tick : short_tick;
    canvas.line({in.x, y}, {in.x + length, y}, stroke);
    canvas.line({in.right(), y}, {in.right() - length, y}, stroke);
    if (tick.major)
      canvas.text(tick.label, {in.x - 0.35 * size, y},
                  {.size = size, .align_x = AlignX::right, .align_y = AlignY::middle});
  }
  if (!plot.x.label.empty())
    canvas.text(plot.x.label, {in.middle().x, box.bottom() - 0.12 * size},
                {.size = size, .align_x = AlignX::centre, .align_y = AlignY::bottom});
  if (!plot.y.label.empty()) {
    // a label may be longer than its axis, but is set smaller if it is longer than the box
    TextStyle style =
        canvas.fitted(plot.y.label, box.height,
                      {.size = size, .align_x = AlignX::centre, .align_y = AlignY::top});
    const double half = canvas.measure(plot.y.label, style).width / 2;
    style.angle_deg = 90;
    const double middle = std::clamp(in.middle().y, box.y + half, box.bottom() - half);
    canvas.text(plot.y.label, {box.x + 0.12 * size, middle}, style);
  }
  if (plot.title.empty()) return;
  const std::string text = title_in_lines(canvas, box, plot);
  const TextStyle title = title_style(canvas, box, plot);
  const double half = canvas.measure(text, title).width / 2;
  canvas.text(text, {std::clamp(in.middle().x, box.x + half, box.right() - half), box.y}, title);
}

Legend::Legend(const Canvas& canvas, const Plot& plot)
    : plot_(plot), size_(plot.font_size), row_(1.35 * plot.font_size), key_(2.2 * plot.font_size) {
  if (plot.legend == LegendPosition::none) return;
  for (const Series& s : plot.series)
    if (!s.name.empty()) entries_.push_back({&s, nullptr, s.name});
  for (const Band& b : plot.bands)
    if (!b.name.empty()) entries_.push_back({nullptr, &b, b.name});
  for (Entry& e : entries_)
    e.width = key_ + 0.5 * size_ + canvas.measure(e.name, {.size = size_}).width;
}

Box Legend::corner_box(const Box& in, LegendPosition position) const {
  double width = 0;
  for (const Entry& e : entries_) width = std::max(width, e.width);
  width += 0.8 * size_;
  const double height = double(entries_.size()) * row_ + 0.4 * size_, margin = 0.7 * size_;
  const bool left =
      position == LegendPosition::upper_left || position == LegendPosition::lower_left;
  const bool upper =
      position == LegendPosition::upper_left || position == LegendPosition::upper_right;
  return {left ? in.x + margin : in.right() - margin - width,
          upper ? in.y + margin : in.bottom() - margin - height, width, height};
}

LegendPosition Legend::free_corner(const Canvas& canvas, const PlotFrame& frame) const {
  for (LegendPosition position : {LegendPosition::upper_right, LegendPosition::upper_left,
                                  LegendPosition::lower_right, LegendPosition::lower_left}) {
    const Box box = corner_box(frame.inside, position);
    if (frame.inside.contains(box) && !hides(canvas, plot_, frame, box)) return position;
  }
  return LegendPosition::none;
}

double Legend::height_above_axes(double width) const {
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

void Legend::draw_in_corner(Canvas& canvas, const PlotFrame& frame, LegendPosition position) const {
  const Box box = corner_box(frame.inside, position);
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
  constexpr double least = 0.2;  // of the size
  const double at = x + key_ + 0.5 * size_;
  const TextStyle style{.size = size_, .align_y = AlignY::middle};
  canvas.text(entry.name, {at, middle}, canvas.fitted(entry.name, end - at, style, least));
}

}  // namespace gridshell::render
