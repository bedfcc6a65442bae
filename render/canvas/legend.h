// Legends of pictures: colour bars, scale bars, arrows, colour keys and patches with names.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/canvas/canvas.h"
#include "render/canvas/colour_map.h"

namespace gridshell::render {

/// A colour bar, with the symbol of the quantity and its unit above, ticks and its name at its
/// side.
struct ColourBar {
  std::string label;  ///< text with markup and unit: "*K*_{□} (rad)"
  ColourScale scale;
  bool below_scale = false,
       above_scale = false;  ///< values outside the scale occur, shown by pointed ends
  std::string words = {};    ///< name of the quantity, vertical along the bar; empty: none
  bool ends = false;         ///< whether the ends of the scale have ticks too, round or not
};

/// Width of a vertical bar with its labels at this font size.
double colour_bar_width(const Canvas& canvas, const ColourBar& bar, double font_size);
double colour_bar_width(const ColourBar& bar, double font_size);

/// Draws a vertical colour bar with its labels into `box`.
void draw_colour_bar(Canvas& canvas, const Box& box, const ColourBar& bar, double font_size);

/// The length of a scale bar: "20 mm", from 1000 mm "1.5 m".
std::string scale_bar_text(double length_mm);
/// Draws a bar of `length_mm` with its length above, centred in `box`. Returns false, and draws
/// nothing, if it does not fit.
bool draw_scale_bar(Canvas& canvas, const Box& box, double length_mm, double units_per_mm,
                    double font_size);

/// An arrow with the quantity that its length means.
struct ArrowKey {
  double length_mm = 0;
  std::string name;  ///< "500 N"
  Colour colour;
};
/// Draws the key like a scale bar. Returns false, and draws nothing, if it does not fit.
bool draw_arrow_key(Canvas& canvas, const Box& box, const ArrowKey& key, double units_per_mm,
                    double font_size);

/// Draws an arrow with a solid head.
void draw_arrow(Canvas& canvas, Point from, Point to, const Stroke& shaft);

/// A colour and its meaning.
struct ColourKey {
  Colour colour;
  std::string name;  ///< text with markup
};

/// Draws the keys in one row in the middle of `box`, smaller if they would not fit into it.
void draw_colour_keys(Canvas& canvas, const Box& box, const std::vector<ColourKey>& keys,
                      double font_size);

/// Patches, four per row, each with its name next to it.
struct Patches {
  std::vector<std::string> names = {};  ///< text with markup
  std::function<void(std::size_t k, const Box&)> draw = {};
  double row_width = 0, row_height = 0, font_size = 0;
};

/// Draws patches of one size; `first` is the box of the first one.
void draw_patches(Canvas& canvas, const Box& first, const Patches& patches);

}  // namespace gridshell::render
