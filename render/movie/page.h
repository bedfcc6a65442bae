// Pages of a journal, with lettered panels at positions in millimetres, as PNG, SVG and PDF; and
// sheets that compare two versions of pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "render/canvas/canvas.h"
#include "render/gl/image.h"

namespace gridshell::render {

struct PagePanel {
  std::string letter;   ///< "A", at the upper left, next to the drawing; empty: none
  std::string caption;  ///< text with markup below; empty: none
  Box box_mm;
  std::function<void(Canvas&, const Box&)> draw;  ///< draws into a box in points
  /// Draws the panel with shells as lines; empty: like `draw`.
  std::function<void(Canvas&, const Box&)> draw_lines = {};
};

/// The largest box with `aspect` = width / height in the middle of another.
Box fitted(const Box& box, double aspect);

/// Draws a picture in the middle of a box, as large as fits.
void draw_fitted(Canvas& canvas, const Box& box, const Image& image);

/// Draws an empty frame with the name of what is missing, for example "photograph".
void draw_empty_frame(Canvas& canvas, const Box& box, const std::string& of_what);

/// Writes a page as `<stem>.png`, `.svg` and `.pdf`, with shells as lines; with `drawn` also as
/// `<stem>_drawn`, with pictures of the shells. Errors: those of write_figure.
Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print = {}, bool drawn = false);

/// A picture before and after a change; either may be missing.
struct PicturePair {
  std::string name;
  std::optional<Image> before, after;
};

/// Whether two versions look the same, and the text that reports it.
struct ComparisonVerdict {
  bool same = false;
  std::string text;                 ///< "differs by 12.40 of 255 at (320, 96)", "is new", ...
  std::optional<Comparison> worst;  ///< empty if one is missing or their sizes differ
};
ComparisonVerdict compare_versions(const PicturePair& pair, double threshold);

/// A picture with one row per pair: before, after and the difference, each scaled into a cell of
/// `cell_width` pixels, with name and verdict above. A sheet too high for a picture is drawn
/// smaller. Errors: Fault::bad_input for more pairs than remain legible so.
Result<Image> contact_sheet(const std::vector<PicturePair>& pairs, double threshold,
                            double cell_width = 480);

}  // namespace gridshell::render
