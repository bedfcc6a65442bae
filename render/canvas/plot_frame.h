// Layout of a plot: the positions of its axes, ticks, title, notes and legend on the canvas.
#pragma once

#include "render/canvas/plot.h"

namespace gridshell::render {

/// The range of an axis and its position on the canvas.
struct PlotAxis {
  double low = 0, high = 1;
  bool logarithmic = false;
  double from = 0, to = 1;  ///< canvas coordinates of low and high

  /// canvas coordinate of a value; NaN for a value that is not positive on a logarithmic axis
  double coordinate(double value) const;
};

/// The axes' frame, with ticks.
struct PlotFrame {
  Box inside;  ///< the area that the axes enclose
  PlotAxis x, y;
  std::vector<Tick> x_ticks, y_ticks;

  Point point_at(double px, double py) const { return {x.coordinate(px), y.coordinate(py)}; }
};

/// The title broken into lines that fit into the box's width, its style, and its height with a gap
/// (0 without a title).
std::string title_in_lines(const Canvas& canvas, const Box& box, const Plot& plot);
TextStyle title_style(const Canvas& canvas, const Box& box, const Plot& plot);
double title_height(const Canvas& canvas, const Box& box, const Plot& plot);

/// Lays out a plot: ranges as given or from the data, margins from the sizes of the labels, and a
/// height `head` above the axes for the legend.
PlotFrame lay_out_plot(const Canvas& canvas, const Box& box, const Plot& plot, double head = 0);

void draw_axes(Canvas& canvas, const Box& box, const Plot& plot, const PlotFrame& frame);

/// A note's box, moved so that all of it is inside the axes.
Box note_box(const Canvas& canvas, const Plot& plot, const PlotFrame& frame, const Note& note);

/// The legend of a plot. The plot must outlive it.
class Legend {
 public:
  Legend(const Canvas& canvas, const Plot& plot);

  bool empty() const { return entries_.empty(); }
  /// A corner in which the legend hides no data; LegendPosition::none if there is none.
  LegendPosition free_corner(const Canvas& canvas, const PlotFrame& frame) const;
  /// The legend's height in rows above axes of that width.
  double height_above_axes(double width) const;
  void draw_in_corner(Canvas& canvas, const PlotFrame& frame, LegendPosition position) const;
  void draw_above(Canvas& canvas, const PlotFrame& frame, double top) const;

 private:
  struct Entry {
    const Series* series = nullptr;
    const Band* band = nullptr;
    std::string name;
    double width = 0;  ///< key and name
  };
  Box corner_box(const Box& inside, LegendPosition position) const;
  void draw_entry(Canvas& canvas, const Entry& entry, double x, double middle, double end) const;

  const Plot& plot_;
  std::vector<Entry> entries_;
  double size_, row_, key_;
};

}  // namespace gridshell::render
