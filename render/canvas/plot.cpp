#include "render/canvas/plot.h"

#include "render/canvas/colour_map.h"

#include "render/canvas/plot_frame.h"

namespace gridshell::render {
namespace {

bool drawable(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

void draw_band(Canvas& canvas, const PlotFrame& frame, const Band& band) {
  const Box& in = frame.inside;
  std::vector<Point> outline;
  const auto end = [](double coordinate, double otherwise) {
    return std::isfinite(coordinate) ? coordinate : otherwise;
  };
  const std::size_t n = std::min({band.x.size(), band.low.size(), band.high.size()});
  for (std::size_t k = 0; k < n; ++k)
    outline.push_back({end(frame.x.coordinate(band.x[k]), band.x[k] > 0 ? in.right() : in.x),
                       end(frame.y.coordinate(band.high[k]), in.y)});
  for (std::size_t k = n; k-- > 0;)
    outline.push_back({outline[k].x, end(frame.y.coordinate(band.low[k]), in.bottom())});
  canvas.polygon(outline, band.colour);
}

void draw_horizontal(Canvas& canvas, const Box& in, const ReferenceLine& line, double y,
                     double size) {
  if (!(y >= in.y && y <= in.bottom())) return;
  canvas.line({in.x, y}, {in.right(), y}, line.stroke);
  if (line.label.empty()) return;
  // above the line, unless that would touch the frame's ticks
  const bool above = y - 1.9 * size > in.y;
  canvas.text(line.label, {in.right() - 0.8 * size, above ? y - 0.15 * size : y + 0.15 * size},
              {.size = size,
               .colour = readable(line.stroke.colour),
               .align_x = AlignX::right,
               .align_y = above ? AlignY::bottom : AlignY::top});
}

void draw_vertical(Canvas& canvas, const Box& in, const ReferenceLine& line, double x, double size,
                   bool top_is_free) {
  if (!(x >= in.x && x <= in.right())) return;
  canvas.line({x, in.y}, {x, in.bottom()}, line.stroke);
  if (line.label.empty()) return;
  const double width = canvas.measure(line.label, {.size = size}).width;
  const bool right = x + width + size < in.right();
  canvas.text(line.label,
              {right ? x + 0.4 * size : x - 0.4 * size,
               top_is_free ? in.y + 0.5 * size : in.bottom() - 0.5 * size},
              {.size = size,
               .colour = readable(line.stroke.colour),
               .align_x = right ? AlignX::left : AlignX::right,
               .align_y = top_is_free ? AlignY::top : AlignY::bottom});
}

void draw_references(Canvas& canvas, const PlotFrame& frame, const Plot& plot) {
  const Box& in = frame.inside;
  const double size = plot.font_size;
  bool top_is_free = true;
  for (const ReferenceLine& line : plot.references)
    if (line.horizontal) {
      const double y = frame.y.coordinate(line.at);
      top_is_free = top_is_free && !(y >= in.y && y < in.y + 3.5 * size);
      draw_horizontal(canvas, in, line, y, size);
    }
  for (const ReferenceLine& line : plot.references)
    if (!line.horizontal)
      draw_vertical(canvas, in, line, frame.x.coordinate(line.at), size, top_is_free);
}

void draw_bars(Canvas& canvas, const PlotFrame& frame, const Series& s) {
  const double zero = frame.y.logarithmic ? frame.inside.bottom() : frame.y.coordinate(0);
  for (std::size_t k = 0; k < std::min(s.x.size(), s.y.size()); ++k) {
    const double left = frame.x.coordinate(s.x[k] - s.bar_width / 2);
    const double right = frame.x.coordinate(s.x[k] + s.bar_width / 2),
                 top = frame.y.coordinate(s.y[k]);
    if (!std::isfinite(left + right + top)) continue;
    canvas.rectangle({left, std::min(top, zero), right - left, std::abs(zero - top)}, s.colour,
                     {{1, 1, 1, 1}, 0.5});
  }
}

void draw_error_bars(Canvas& canvas, const PlotFrame& frame, const Series& s) {
  const double cap = std::max(1.5, 0.4 * s.marker_size);
  // over bars of the same colour an error bar would not be visible
  const Stroke stroke{s.kind == SeriesKind::bars ? ink : s.colour,
                      std::max(0.8, 0.17 * s.marker_size)};
  for (std::size_t k = 0; k < std::min(s.x.size(), s.y.size()); ++k) {
    const Point p = frame.point_at(s.x[k], s.y[k]);
    if (!drawable(p)) continue;
    if (k < s.y_error.size() && s.y_error[k] > 0) {
      double low = frame.y.coordinate(s.y[k] - s.y_error[k]);
      if (!std::isfinite(low)) low = frame.inside.bottom();
      const double high = frame.y.coordinate(s.y[k] + s.y_error[k]);
      canvas.line({p.x, low}, {p.x, high}, stroke);
      for (double y : {low, high}) canvas.line({p.x - cap, y}, {p.x + cap, y}, stroke);
    }
    if (k < s.x_span.size() && s.x_span[k][1] > s.x_span[k][0]) {
      double low = frame.x.coordinate(s.x_span[k][0]);
      if (!std::isfinite(low)) low = frame.inside.x;
      const double high = frame.x.coordinate(s.x_span[k][1]);
      canvas.line({low, p.y}, {high, p.y}, stroke);
      for (double x : {low, high}) canvas.line({x, p.y - cap}, {x, p.y + cap}, stroke);
    }
  }
}

void draw_line_and_markers(Canvas& canvas, const PlotFrame& frame, const Series& s) {
  std::vector<Point> run;
  const auto flush = [&] {
    canvas.polyline(run, {s.colour, s.line_width, s.dash});
    run.clear();
  };
  const std::size_t n = std::min(s.x.size(), s.y.size());
  for (std::size_t k = 0; k < n; ++k) {
    const Point p = frame.point_at(s.x[k], s.y[k]);
    if (drawable(p))
      run.push_back(p);
    else
      flush();
  }
  flush();
  const Colour fill = s.hollow ? white : s.colour;
  for (std::size_t k = 0; k < n; ++k)
    if (const Point p = frame.point_at(s.x[k], s.y[k]); drawable(p))
      canvas.marker(s.marker, p, s.marker_size, fill, {s.colour, s.hollow ? 0.9 : 0});
}

}  // namespace

Colour series_colour(std::size_t index) {
  constexpr std::array<int, 10> colours = {0x4477AA, 0xEE6677, 0x228833, 0xCCBB44, 0x66CCEE,
                                           0xAA3377, 0x555555, 0x004488, 0xDDAA33, 0x000000};
  return hex_colour(colours[index % colours.size()]);
}

Marker series_marker(std::size_t index) {
  constexpr std::array markers{Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  return markers[index % markers.size()];
}

Series line_series(const std::string& name, Colour colour, double width,
                   const std::vector<double>& dash) {
  return {.name = name, .colour = colour, .line_width = width, .dash = dash};
}

Series mark_series(const std::string& name, Colour colour, Marker marker, double size,
                   bool hollow) {
  return {.name = name,
          .colour = colour,
          .line_width = 0,
          .marker = marker,
          .marker_size = size,
          .hollow = hollow};
}

Box note_box(const Canvas& canvas, const Plot& plot, const PlotFrame& frame, const Note& note) {
  const Point at = frame.point_at(note.x, note.y);
  Box box = canvas.measure(
      note.text, {.size = plot.font_size, .align_x = note.align_x, .align_y = note.align_y});
  const Box in = frame.inside.inset(0.4 * plot.font_size);
  box.x = std::max(in.x, std::min(at.x + box.x, in.right() - box.width));
  box.y = std::max(in.y, std::min(at.y + box.y, in.bottom() - box.height));
  return box;
}

void draw_plot(Canvas& canvas, const Box& box, const Plot& plot) {
  PlotFrame frame = lay_out_plot(canvas, box, plot);
  if (frame.inside.empty()) return;
  // the legend is in a free corner, or above the axes if there is none
  const Legend legend(canvas, plot);
  LegendPosition corner = plot.legend;
  if (plot.legend == LegendPosition::automatic) corner = legend.free_corner(canvas, frame);
  const bool above =
      !legend.empty() && (corner == LegendPosition::none || corner == LegendPosition::above);
  if (above) frame = lay_out_plot(canvas, box, plot, legend.height_above_axes(frame.inside.width));

  canvas.clipped(frame.inside, [&] {
    for (const Band& band : plot.bands) draw_band(canvas, frame, band);
    for (const Series& s : plot.series)
      if (s.kind == SeriesKind::bars) draw_bars(canvas, frame, s);
    draw_references(canvas, frame, plot);
    for (const Series& s : plot.series) draw_error_bars(canvas, frame, s);
  });
  draw_axes(canvas, box, plot, frame);
  // the clip is larger than the frame so that markers on it are complete
  canvas.clipped(frame.inside.inset(-3), [&] {
    for (const Series& s : plot.series)
      if (s.kind == SeriesKind::points) draw_line_and_markers(canvas, frame, s);
  });
  for (const Note& note : plot.notes) {
    const Box at = note_box(canvas, plot, frame, note);
    canvas.text(note.text, {at.x, at.y},
                {.size = plot.font_size,
                 .colour = readable(note.colour),
                 .align_y = AlignY::top,
                 .halo = {1, 1, 1, 0.85f}});
  }
  if (above)
    legend.draw_above(canvas, frame, box.y + title_height(canvas, box, plot));
  else if (!legend.empty())
    legend.draw_in_corner(canvas, frame, corner);
}

void draw_legend(Canvas& canvas, const Box& box, const Plot& plot) {
  const Legend legend(canvas, plot);
  PlotFrame frame;
  frame.inside = box;
  if (!legend.empty()) legend.draw_above(canvas, frame, box.y);
}

double legend_height(const Plot& plot, double width) {
  double height = 0;
  (void)draw_picture(1, 1, 1, {}, [&](Canvas& canvas) {
    const Legend legend(canvas, plot);
    if (!legend.empty()) height = legend.height_above_axes(width);
  });
  return height;
}

Result<void> write_plot(const std::filesystem::path& stem, const Plot& plot, const Print& print,
                        double height_over_width) {
  constexpr double column_mm = 88;
  const double width = (print.width_mm > 0 ? print.width_mm : column_mm) * points_per_mm;
  const double height = height_over_width * width;
  return write_figure(
      stem, width, height, plot.title.empty() ? plot.y.label : plot.title,
      [&](Canvas& canvas) {
        draw_plot(canvas, Box{0, 0, width, height}.inset(2), plot);
      },
      print);
}

}  // namespace gridshell::render
