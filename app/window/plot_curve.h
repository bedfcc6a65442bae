// The curves of the panel of plots, which are also those of saved plots.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/window/viewer_state.h"
#include "render/canvas/plot.h"

namespace gridshell::window {

/// A position on the abscissa, or an interval of it.
struct CurveMark {
  float from, to;
  bool unstable;  ///< there is no stable state; else an event happened there
  std::string what;
};

/// One curve, or two over the same x.
struct Curve {
  const char* y_label;
  const char* x_label;
  const char* without;  ///< text that is shown if there is nothing to plot
  std::vector<float> x, y;
  bool bars = false;
  std::vector<std::size_t> jumps = {};     ///< points without a line from the one before
  std::vector<float> second = {};          ///< y of a second curve, which is paler
  bool logarithmic = false;                ///< y, which is above 0
  std::vector<std::size_t> unstable = {};  ///< points of unstable states
  std::vector<std::size_t> coarse = {};    ///< points on the coarse mesh of a drag, which are pale
  std::vector<CurveMark> marks = {};
  bool whole = false;  ///< x are whole numbers
};

/// The curve of the states so far over the chosen quantity.
Curve curve_of(const ViewerState& viewer, const PlotAxes& axes);
/// The mean K□ of the cells in bins along x, as bars.
Curve bins_of(const ShellView& shell);

/// The points `from` to before `end` of a curve, which one line connects.
struct CurvePiece {
  std::size_t from, end;
  bool coarse;  ///< on the coarse mesh of a drag

  bool is_point() const { return end == from + 1; }
};
/// A curve with the ordinates `y` (Curve::y or Curve::second), divided at its jumps and at unknown
/// values, which are in no piece.
std::vector<CurvePiece> pieces_of(const Curve& curve, const std::vector<float>& y);

/// The first curve for print, as it is on the screen: a line for each piece, pale on a coarse mesh;
/// a marker for a piece of one point and for each unstable state; the marks.
render::Plot plot_of(const Curve& curve);
/// Its table: x, y, the number of the line (piece) from 1, and whether the point is on a coarse
/// mesh and of an unstable state, 0 or 1.
std::string table_of(const Curve& curve);

}  // namespace gridshell::window
