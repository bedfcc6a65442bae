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

/// One picture of a figure; all of a figure have the same size.
struct Panel {
  Image picture;
  std::string letter;   ///< marked text, bold, at the upper left: "a"
  std::string caption;  ///< marked text below, in lines: "*R*_{a} = 115.9 mm"
  /// The panel as lines, that stay sharp however they are enlarged; empty: there is the picture
  /// alone.
  std::function<void(Canvas&, const Box&)> lines = {};
};

struct PanelFigure {
  std::string title;  ///< plain text above all; empty: none
  std::vector<Panel> panels;
  int columns = 3;
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

/// Writes the figure as `file`, a PNG, and where its panels have lines `<stem>_lines` as SVG and
/// PDF.
Result<void> write_panels(const PanelFigure& figure, const std::filesystem::path& file, double dpi);

/// Draws the figure on a canvas, as large as `box` allows, in its middle; its words are the
/// canvas's text, and with `lines` its pictures are lines where there are some. Draws nothing where
/// draw_panels() has an error.
void draw_panels_on(Canvas& canvas, const Box& box, const PanelFigure& figure, bool lines = false);

}  // namespace gridshell::render
