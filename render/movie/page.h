// A page of a journal: panels with letters at their positions in millimetres, drawn once as PNG,
// SVG and PDF.
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

/// One panel; what it draws stays in its box.
struct PagePanel {
  std::string letter;   ///< "A", at the upper left, outside of what is drawn; empty: none
  std::string caption;  ///< marked text below; empty: none
  Box box_mm;
  std::function<void(Canvas&, const Box&)> draw;  ///< into a box in points
  /// The panel with shells as lines; empty: as `draw`.
  std::function<void(Canvas&, const Box&)> draw_lines = {};
};

/// The largest box of so much width over height in the middle of another.
Box fitted(const Box& box, double aspect);

/// A picture as large as the box allows, in its middle.
void draw_fitted(Canvas& canvas, const Box& box, const Image& image);

/// The empty frame of what is not there: "photograph".
void draw_empty_frame(Canvas& canvas, const Box& box, const std::string& of_what);

/// `<stem>.png`, `.svg` and `.pdf`, shells as lines; with `drawn` also `<stem>_drawn`, with
/// pictures of the shells.
/// Errors: those of write_figure.
Result<void> write_page(const std::filesystem::path& stem, const std::string& title,
                        double width_mm, double height_mm, const std::vector<PagePanel>& panels,
                        const Print& print = {}, bool drawn = false);

// Pictures before and after a change next to one another, to look at.

/// A picture in two versions, either of which may be missing.
struct PicturePair {
  std::string name;
  std::optional<Image> before, after;
};

/// Whether two versions are the same to the eye, and how the line about them says it.
struct ComparisonVerdict {
  bool same = false;
  std::string text;                 ///< "differs by 12.40 of 255 at (320, 96)", "is new", ...
  std::optional<Comparison> worst;  ///< where both are there and of one size
};
ComparisonVerdict compare_versions(const PicturePair& pair, double threshold);

/// A row a pair: before, after, and where they differ, each scaled into a cell of `cell_width`
/// pixels, with name and verdict above. Errors: none; an empty list is an empty sheet.
Image contact_sheet(const std::vector<PicturePair>& pairs, double threshold,
                    double cell_width = 480);

}  // namespace gridshell::render
