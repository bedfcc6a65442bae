// Pictures side by side as one figure: letters, a caption under each, one scale bar, one colour bar
// and one row of colour keys for all.
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
  Point at;          ///< of the panel's width and height, 0 to 1
  std::string text;  ///< marked text
  bool bold = false;
};

/// One picture of a figure; all of a figure have the same size.
struct Panel {
  Image picture;
  std::string letter;   ///< marked text, bold, at the upper left: "A"
  std::string caption;  ///< marked text below, in lines: "*R*_{a} = 115.9 mm"
  /// The panel as lines, that stay sharp however they are enlarged; empty: there is the picture
  /// alone.
  std::function<void(Canvas&, const Box&)> lines = {};
  std::vector<PanelLabel> labels = {};
};

struct PanelFigure {
  std::string title;  ///< plain text above all; empty: none
  std::vector<Panel> panels;
  int columns = 3;
  bool as_lines = false;               ///< panels are their lines in the PNG too
  double scale_bar_mm = 0;             ///< 0: none
  double pixels_per_mm = 0;            ///< of the panels' pictures
  std::optional<ArrowKey> arrow = {};  ///< next to the scale bar
  std::optional<ColourBar> colour_bar;
  std::vector<ColourKey> keys = {};  ///< in a row below all panels
  Colour background = white;
  Print print{178, 0};  ///< text is 8.5 pt at that width; with a dpi the figure is that wide
};

/// The figure, panels pixel by pixel as they are. Errors: Fault::bad_input for no panel or panels
/// of different size (naming both).
Result<Image> draw_panels(const PanelFigure& figure);

/// Writes the figure as `file`, a PNG, and where its panels have lines as SVG and PDF too:
/// `<stem>_lines` next to it, or `<stem>` of a figure that is lines.
Result<void> write_panels(const PanelFigure& figure, const std::filesystem::path& file, double dpi);

/// Draws the figure on a canvas, as large as `box` allows, in its middle; its words are the
/// canvas's text, and with `lines` its pictures are lines where there are some. Draws nothing where
/// draw_panels() has an error.
void draw_panels_on(Canvas& canvas, const Box& box, const PanelFigure& figure, bool lines = false);

}  // namespace gridshell::render
