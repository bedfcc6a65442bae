// How a run is shown: everything a user may choose about a movie or a still.
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

/// What things look like, the theme's choices and the user's in one.
struct Appearance {
  double rod_mm = 0, joint_mm = 3, ring_mm = 1.4;  ///< widths as drawn, no less than a pixel
  Colour rod{0.16f, 0.17f, 0.20f, 1}, joint{0.52f, 0.53f, 0.55f, 1}, ring{0.3f, 0.33f, 0.38f, 1},
      background{1, 1, 1, 1};  ///< a background of alpha 0 stays out of the picture
  ColourMap map = nullptr;     ///< null: by the values
  std::vector<double> range;   ///< (low, high) of the colours; empty: by the values
  bool cells = true, rings = true, floor = true, shadow = true, loads = true, braces = true,
       ghost = true, supports = true;
  bool clamped = false;                             ///< the supports prescribe directions
  double lath_width_mm = 0, lath_thickness_mm = 0;  ///< of rods whose layout has none; 0: round
  double sheen = 1;                                 ///< of rods and joints; 0: ink
  double far_fade = 0.25;                           ///< of the far side, into the background
  bool letters = true;                              ///< of the panels of a figure
};

/// White, with black rods: as in the paper's figures.
Appearance paper_appearance();

/// What the preset says of movies (of stills the quality is that of figures), and what it says
/// elsewhere. Standard views are in azimuth and elevation.
struct MovieStyle : preset::Movie {
  bool legends = true;           ///< the colour bar
  bool heading = false;          ///< room above for two lines of a still
  double scale_bar_mm = 0;       ///< 0: none
  std::string title = {};        ///< shown as it is
  std::string source = {};       ///< figure or movie that it follows, on the title card
  std::string description = {};  ///< what is shown and what moves, there too
  std::string parameters = {};   ///< the shell's numbers and the program, there too, marked text
  Print print = {};              ///< of figures
  bool vector = false;           ///< stills as lines too
  double font_scale = 1;         ///< of all text
  Appearance look = {};

  int width() const { return size[0]; }
  int height() const { return size[1]; }
};

/// How the preset wants its run shown as a movie, or as the stills of a figure in the size of
/// print.
MovieStyle movie_style(const preset::Preset& preset);
MovieStyle figure_style(const preset::Preset& preset);

/// Draft: no shadow; movie: with soft shadow; figure: many passes with jittered light. A sample a
/// pixel is enough: what is thin knows how much of it is covered.
DrawQuality draw_quality(Quality quality);
/// The same colour with the contrast that the look has.
DrawQuality draw_quality(const MovieStyle& style);

// What is before a movie: its title and what it follows.

/// A card of the movie's size with its title and, where there are any, its description and source
/// below. Long titles are set in several lines, and smaller until they fit.
Image title_card(const MovieStyle& style);

}  // namespace gridshell::render
