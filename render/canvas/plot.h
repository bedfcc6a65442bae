// Plots over two axes, as journals print them: lines, markers, bars, error bars, shaded bands,
// reference lines, notes and a legend.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/canvas/canvas.h"
#include "render/canvas/text.h"

namespace gridshell::render {

/// The colour of the index-th series: ten colours, repeated, that colour-blind readers and readers
/// of grey copies can distinguish (Paul Tol's schemes "bright" and "high contrast").
Colour series_colour(std::size_t index);
/// The marker of the index-th series: four, repeated.
Marker series_marker(std::size_t index);

struct Axis {
  std::string label;  ///< text with markup and unit: "*R*_{a} (mm)"
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};  ///< none: from the data, with a margin
  int ticks = 6;                              ///< approximate number of labels; 0: no ticks
};

enum class SeriesKind { points, bars };

/// Points or bars of one look, with one row of the legend. Points that are not finite (or not
/// positive on a logarithmic axis) interrupt the line.
struct Series {
  std::string name;  ///< text with markup; empty: not in the legend
  std::vector<double> x = {}, y = {};
  std::vector<double> y_error = {};                ///< half-lengths; empty: none
  std::vector<std::array<double, 2>> x_span = {};  ///< ends of horizontal error bars; empty: none
  Colour colour{0.27f, 0.47f, 0.67f, 1};
  SeriesKind kind = SeriesKind::points;
  double line_width = 1;          ///< in units of the canvas; 0: markers alone
  std::vector<double> dash = {};  ///< empty: solid
  Marker marker = Marker::none;
  double marker_size = 4.5;
  bool hollow = false;   ///< markers filled with white
  double bar_width = 0;  ///< in units of x

  void add(double px, double py) {
    x.push_back(px);
    y.push_back(py);
  }
  /// Interrupts the line.
  void part() { add(NAN, NAN); }
};

/// A series with a line only, and one with markers only; add() adds their points.
Series line_series(const std::string& name, Colour colour, double width = 1,
                   const std::vector<double>& dash = {});
Series mark_series(const std::string& name, Colour colour, Marker marker = Marker::circle,
                   double size = 4.5, bool hollow = false);

/// The area between two curves over x, or a shaded region of the plot.
struct Band {
  std::string name;  ///< text with markup; empty: not in the legend
  /// an end that is not finite reaches to the frame
  std::vector<double> x = {}, low = {}, high = {};
  Colour colour{0.5f, 0.5f, 0.5f, 0.2f};
};

/// The different values of a member that `requested` accepts, in the order of their first rows.
template <class Row, class Value, class Predicate>
std::vector<Value> distinct(const std::vector<Row>& rows, Value Row::*member,
                            const Predicate& requested) {
  std::vector<Value> values;
  for (const Row& row : rows)
    if (requested(row.*member) && std::ranges::find(values, row.*member) == values.end())
      values.push_back(row.*member);
  return values;
}
template <class Row, class Value>
std::vector<Value> distinct(const std::vector<Row>& rows, Value Row::*member) {
  return distinct(rows, member, [](const Value&) { return true; });
}

/// A line across all of the plot.
struct ReferenceLine {
  bool horizontal = true;
  double at = 0;
  std::string label;  ///< text at its end; empty: none
  Stroke stroke{{0.3f, 0.3f, 0.3f, 1}, 0.8, {3, 2}};
};

/// Text at a point of the plot.
struct Note {
  double x = 0, y = 0;
  std::string text;
  AlignX align_x = AlignX::left;
  AlignY align_y = AlignY::bottom;
  Colour colour = ink;
};

enum class LegendPosition {
  none,
  automatic,
  above,
  upper_left,
  upper_right,
  lower_left,
  lower_right
};

struct Plot {
  std::string title;  ///< text with markup; empty: none
  Axis x, y;
  std::vector<Band> bands;  ///< drawn first
  std::vector<Series> series;
  std::vector<ReferenceLine> references;
  std::vector<Note> notes;
  LegendPosition legend = LegendPosition::automatic;
  double font_size = 8.5;
  double labels_width = 0;  ///< least width left of the frame, so that plots in a column align

  /// Adds a series on top of all others, unless it has no points.
  void add(Series one) {
    if (!one.x.empty()) series.push_back(std::move(one));
  }
};

/// Draws the legend of a plot alone, in rows from the top of `box`, for several plots with one
/// legend.
void draw_legend(Canvas& canvas, const Box& box, const Plot& plot);
/// The height of this legend in a box of that width.
double legend_height(const Plot& plot, double width);

/// The width that the labels left of a plot's frame take.
double labels_width(const Canvas& canvas, const Box& box, const Plot& plot);

void draw_plot(Canvas& canvas, const Box& box, const Plot& plot);

/// Writes a plot as `<stem>.png`, `<stem>.svg` and `<stem>.pdf`, of the printed width or that of a
/// journal's column, 88 mm. Errors: Fault::io with the path.
Result<void> write_plot(const std::filesystem::path& stem, const Plot& plot,
                        const Print& print = {}, double height_over_width = 62.0 / 88);

}  // namespace gridshell::render
