// A general plot over two axes: lines, markers, bars, error bars, shaded bands, reference lines,
// notes and a legend, as a journal prints it.
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

/// Ten colours that stay apart for colour-blind readers and in grey, in order of use (Paul Tol's
/// "bright" and "high contrast" schemes).
Colour series_colour(std::size_t index);
/// Four signs, in the same order of use.
Marker series_marker(std::size_t index);

struct Axis {
  std::string label;  ///< marked text with its unit: "*R*_{a} (mm)"
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};  ///< otherwise from the data, with a margin
  int ticks = 6;                              ///< about so many labels; 0: none, nor ticks
};

enum class SeriesKind { points, bars };

/// One row of the legend. Points that are not finite (or not positive on a logarithmic axis) part
/// the line.
struct Series {
  std::string name;  ///< marked text; empty: not in the legend
  std::vector<double> x = {}, y = {};
  std::vector<double> y_error = {};                ///< half-lengths; empty: none
  std::vector<std::array<double, 2>> x_span = {};  ///< ends of a bar, least and most; empty: none
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
  void part() { add(NAN, NAN); }
};

/// A line without marks, and marks without a line; points come by add().
Series line_series(const std::string& name, Colour colour, double width = 1,
                   const std::vector<double>& dash = {});
Series mark_series(const std::string& name, Colour colour, Marker marker = Marker::circle,
                   double size = 4.5, bool hollow = false);

/// The area between two curves, or, with one x to the next, a shaded region of the plot.
struct Band {
  std::string name;
  std::vector<double> x = {}, low = {}, high = {};  ///< not finite ends reach to the frame
  Colour colour{0.5f, 0.5f, 0.5f, 0.2f};
};

/// The values of a member in the order in which they first come, of those that are selected.
template <class Row, class Value, class Wanted>
std::vector<Value> distinct(const std::vector<Row>& rows, Value Row::*member,
                            const Wanted& requested) {
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

/// A line across the whole plot.
struct ReferenceLine {
  bool horizontal = true;
  double at = 0;
  std::string label;  ///< written at its end; empty: none
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
  std::string title;  ///< marked text; empty: none
  Axis x, y;
  std::vector<Band> bands;  ///< drawn first
  std::vector<Series> series;
  std::vector<ReferenceLine> references;
  std::vector<Note> notes;
  LegendPosition legend = LegendPosition::automatic;
  double font_size = 8.5;

  /// On top of all others; left out where it has no point.
  void add(Series one) {
    if (!one.x.empty()) series.push_back(std::move(one));
  }
};

/// The legend of a plot alone, in rows from the top of `box`: of several that share it.
void draw_legend(Canvas& canvas, const Box& box, const Plot& plot);
/// The height that it takes in a box so wide.
double legend_height(const Plot& plot, double width);

/// Draws the plot with its labels into `box`; nothing reaches outside.
void draw_plot(Canvas& canvas, const Box& box, const Plot& plot);

/// A plot of its own as `<stem>.png`, `<stem>.svg` and `<stem>.pdf`, as wide as printed or 88 mm, a
/// journal's column.
Result<void> write_plot(const std::filesystem::path& stem, const Plot& plot,
                        const Print& print = {}, double height_over_width = 62.0 / 88);

}  // namespace gridshell::render
