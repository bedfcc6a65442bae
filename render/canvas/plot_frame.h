// From the values of a plot's axes to positions on the canvas.
#pragma once

#include "render/canvas/plot.h"

namespace gridshell::render {

/// One axis as laid out: its range, and where that lies on the canvas.
struct PlotAxis {
  double low = 0, high = 1;
  bool logarithmic = false;
  double from = 0, to = 1;  ///< canvas coordinates of low and high

  /// canvas coordinate of a value; NaN where it has none (not positive on a logarithmic axis)
  double place(double value) const;
};

/// The axes' frame, with ticks.
struct PlotFrame {
  Box inside;  ///< what the axes enclose
  PlotAxis x, y;
  std::vector<Tick> x_ticks, y_ticks;

  Point place(double px, double py) const { return {x.place(px), y.place(py)}; }
};

/// The title as it fits into the box's width, and the height that it takes; 0 without a title.
std::string title_in_lines(const Canvas& canvas, const Box& box, const Plot& plot);
TextStyle title_style(const Canvas& canvas, const Box& box, const Plot& plot);
double title_height(const Canvas& canvas, const Box& box, const Plot& plot);

/// Ranges from the data or as given, margins from the labels' own sizes; `head` is kept free above.
PlotFrame lay_out_plot(const Canvas& canvas, const Box& box, const Plot& plot, double head = 0);

void draw_axes(Canvas& canvas, const Box& box, const Plot& plot, const PlotFrame& frame);

/// A note's box, moved so that all of it lies inside the axes.
Box note_box(const Canvas& canvas, const Plot& plot, const PlotFrame& frame, const Note& note);

/// The legend's entries with their sizes, and where it goes.
class Legend {
 public:
  Legend(const Canvas& canvas, const Plot& plot);

  bool empty() const { return entries_.empty(); }
  /// the corner that hides no data; LegendPosition::none where each of them does
  LegendPosition free_corner(const Canvas& canvas, const PlotFrame& frame) const;
  /// height of the legend as rows above axes of that width
  double height_above_axes(double width) const;
  void draw_in_corner(Canvas& canvas, const PlotFrame& frame, LegendPosition place) const;
  void draw_above(Canvas& canvas, const PlotFrame& frame, double top) const;

 private:
  struct Entry {
    const Series* series = nullptr;
    const Band* band = nullptr;
    std::string name;
    double width = 0;  ///< key and name
  };
  Box corner_box(const Box& inside, LegendPosition place) const;
  void draw_entry(Canvas& canvas, const Entry& entry, double x, double middle, double end) const;

  const Plot& plot_;
  std::vector<Entry> entries_;
  double size_, row_, key_;
};

}  // namespace gridshell::render
