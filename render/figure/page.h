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
};

/// A picture as large as the box allows, in its middle.
void draw_fitted(Canvas& canvas, const Box& box, const Image& image);

/// The empty frame that a photograph goes into.
void draw_photo_frame(Canvas& canvas, const Box& box);

/// `<stem>.png`, `.svg` and `.pdf`. Errors: those of write_figure.
Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print = {});

}  // namespace gridshell::render
