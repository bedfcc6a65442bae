// Figures of several pictures (panels): letters, a caption under each, and one scale bar, one
// colour bar and one row of colour keys for all.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/canvas/legend.h"

namespace gridshell::render {

/// Text in a panel, centred at a point.
struct PanelLabel {
  Point at;          ///< fractions of the panel's width and height, 0 to 1
  std::string text;  ///< with markup
  bool bold = false;
};

/// One picture of a figure; all of a figure have the same size.
struct Panel {
  Image picture;
  std::string letter;   ///< text with markup, bold, at the upper left: "A"
  std::string caption;  ///< text with markup below, in lines: "*R*_{a} = 115.9 mm"
  /// Draws the panel as lines, which are sharp at any size; empty: the panel is only a picture.
  std::function<void(Canvas&, const Box&)> lines = {};
  std::vector<PanelLabel> labels = {};
};

struct PanelFigure {
  std::string title;  ///< plain text above all; empty: none
  std::vector<Panel> panels;
  int columns = 3;
  bool as_lines = false;               ///< panels are drawn as lines in the PNG too
  double scale_bar_mm = 0;             ///< 0: none
  double pixels_per_mm = 0;            ///< of the panels' pictures
  std::optional<ArrowKey> arrow = {};  ///< next to the scale bar
  std::optional<ColourBar> colour_bar;
  std::vector<ColourKey> keys = {};  ///< in a row below all panels
  Colour background = white;
  /// the font has 8.5 pt at this width; a dpi above 0 makes the PNG that wide
  Print print{178, 0};
};

/// The figure as a picture; without a dpi a pixel of a panel is a pixel of the figure. Errors:
/// Fault::bad_input for no panel, empty panels or panels of different sizes; those of
/// draw_picture().
Result<Image> draw_panels(const PanelFigure& figure);

/// Writes the figure as the PNG `file`. If its panels have lines, it is also written as
/// `<stem>_lines.png`, `.svg` and `.pdf`; a figure `as_lines` only as `<stem>.png`, `.svg` and
/// `.pdf`. Errors: those of draw_panels(), io.
Result<void> write_panels(const PanelFigure& figure, const std::filesystem::path& file, double dpi);

/// Draws the figure in the middle of `box` on a canvas, as large as fits; with `lines` panels are
/// drawn as lines if they have them. Draws nothing if draw_panels() has an error.
void draw_panels_on(Canvas& canvas, const Box& box, const PanelFigure& figure, bool lines = false);

}  // namespace gridshell::render
