// A page of a journal: panels with letters at their places in millimetres, drawn once as PNG, SVG
// and PDF.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// One panel; what it draws stays in its box.
struct PagePanel {
  std::string letter;   ///< "A", at the upper left, outside of what is drawn; empty: none
  std::string caption;  ///< marked text below; empty: none
  Box box_mm;
  std::function<void(Canvas&, const Box&)> draw;  ///< into a box in points
  /// The same with shells as lines; empty: as `draw`.
  std::function<void(Canvas&, const Box&)> draw_lines = {};
};

/// The largest box of so much width over height in the middle of another.
Box fitted(const Box& box, double aspect);

/// A picture as large as the box allows, in its middle.
void draw_fitted(Canvas& canvas, const Box& box, const Image& image);

/// The empty frame of what is not there: "photograph".
void draw_empty_frame(Canvas& canvas, const Box& box, const std::string& of_what);

/// `<stem>.png`, `.svg` and `.pdf`, and with `lines` `<stem>_lines` beside them, shells as lines.
/// Errors: those of write_figure.
Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print = {}, bool lines = false);

}  // namespace gridshell::render
