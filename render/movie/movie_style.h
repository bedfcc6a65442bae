// The style of a movie or a still: everything that a user may choose about the picture of a run.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/preset.h"
#include "render/canvas/canvas.h"
#include "render/canvas/colour_map.h"
#include "render/gl/image.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

using preset::ColourBy;
using preset::Pace;
using preset::Quality;

/// Colours, widths and visibility of what is drawn, from the theme and the user's keys.
struct Appearance {
  /// widths as drawn, but at least about a pixel; rod_mm 0: the rods' own; joint_mm 0: no joints
  double rod_mm = 0, joint_mm = 3, ring_mm = 1.4;
  Colour rod{0.16f, 0.17f, 0.20f, 1}, joint{0.52f, 0.53f, 0.55f, 1}, ring{0.3f, 0.33f, 0.38f, 1},
      background{1, 1, 1, 1};                     ///< alpha 0: a transparent background
  bool rod_chosen = false, joint_chosen = false;  ///< the user chose these colours
  ColourMap map = nullptr;                        ///< null: that of the quantity
  std::vector<double> range;  ///< (low, high) of the colours; empty: that of the values
  bool cells = true, rings = true, floor = true, shadow = true, loads = true, braces = true,
       ghost = true, supports = true;
  bool clamped = false;                             ///< the supports prescribe directions
  double lath_width_mm = 0, lath_thickness_mm = 0;  ///< of rods whose layout has none; 0: round
  double sheen = 1;                                 ///< of rods and joints; 0: flat ink
  double far_fade = 0.25;                           ///< fading of the far side to the background
  bool letters = true;                              ///< whether panels of a figure have letters
};

/// The theme of the paper's figures: black rods on white.
Appearance paper_appearance();

/// Width and thickness of every rod, mm: the layout's or, if it has none, those of the appearance;
/// empty if rods are drawn round.
std::vector<double> laths_of(const record::Layout& layout, const Appearance& look);

/// The keys of [movie] (for stills with the quality of [figure]), and other keys that pictures
/// need. A standard view is given by azimuth and elevation.
struct MovieStyle : preset::Movie {
  bool legends = true;           ///< whether there is a colour bar
  bool heading = false;          ///< whether there is room above for the heading of a still
  double scale_bar_mm = 0;       ///< 0: none
  std::string title = {};        ///< plain text
  std::string source = {};       ///< published figure or movie that the run follows; title card
  std::string description = {};  ///< of what is shown; title card
  std::string parameters = {};   ///< numbers of the shell, and the program; title card; markup
  Print print = {};              ///< of figures
  bool vector = false;           ///< whether stills are also written as lines
  double font_scale = 1;         ///< factor of the size of all text
  Appearance look = {};

  int width() const { return size[0]; }
  int height() const { return size[1]; }
};

/// The style of a preset's movie, and of its stills in the size of print.
MovieStyle movie_style(const preset::Preset& preset);
MovieStyle figure_style(const preset::Preset& preset);

/// The effort of a quality: draft has no shadow; movie a soft shadow and four samples per pixel;
/// figure many passes with jittered light, so that one sample per pixel is enough.
DrawQuality draw_quality(Quality quality);
/// The effort of the style's quality; no shadow if the style has none.
DrawQuality draw_quality(const MovieStyle& style);

/// The title card before a movie, of the movie's size, with its title and, if there are any,
/// description, parameters and source below. Long titles have several lines and are set smaller
/// until they fit.
Result<Image> title_card(const MovieStyle& style);

}  // namespace gridshell::render
