// What a picture needs to be read: a colour bar, a scale bar, patches with their names.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/canvas/canvas.h"
#include "render/canvas/colour_map.h"

namespace gridshell::render {

/// A colour bar: the quantity's sign and unit above, ticks and its name at its side.
struct ColourBar {
  std::string label;  ///< marked text with the unit: "*K*_{□} (rad)"
  ColourScale scale;
  bool beyond_low = false,
       beyond_high = false;  ///< values outside the scale occur: pointed ends say so
  std::string words = {};  ///< what the sign means, upright along the bar; empty: the sign says it
  bool ends = false;       ///< the scale's ends have ticks too, round or not
};

/// The width that a vertical bar with its labels takes at this font size.
double colour_bar_width(const Canvas& canvas, const ColourBar& bar, double font_size);
double colour_bar_width(const ColourBar& bar, double font_size);

/// Draws a vertical colour bar into `box`, everything within.
void draw_colour_bar(Canvas& canvas, const Box& box, const ColourBar& bar, double font_size);

/// A bar `length_mm` long with its length above, centred in `box`; nothing where it does not fit.
/// Returns whether it was drawn.
bool draw_scale_bar(Canvas& canvas, const Box& box, double length_mm, double units_per_mm,
                    double font_size);

/// An arrow and what its length means, drawn as a scale bar is.
struct ArrowKey {
  double length_mm = 0;
  std::string name;  ///< "500 N"
  Colour colour;
};
bool draw_arrow_key(Canvas& canvas, const Box& box, const ArrowKey& key, double units_per_mm,
                    double font_size);

/// An arrow in the plane: a shaft and a solid head.
void draw_arrow(Canvas& canvas, Point from, Point to, const Stroke& shaft);

/// A colour and what it means.
struct ColourKey {
  Colour colour;
  std::string name;  ///< marked text
};

/// The keys in one row in the middle of `box`, smaller where they would not fit into it.
void draw_colour_keys(Canvas& canvas, const Box& box, const std::vector<ColourKey>& keys,
                      double font_size);

/// Patches, four to a row, each with its name next to it.
struct Patches {
  std::vector<std::string> names = {};  ///< marked text
  std::function<void(std::size_t k, const Box&)> draw = {};
  double row_width = 0, row_height = 0, font_size = 0;
};

/// `first` is the first of the patches, all of one size.
void draw_patches(Canvas& canvas, const Box& first, const Patches& patches);

}  // namespace gridshell::render
