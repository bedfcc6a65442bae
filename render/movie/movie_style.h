// How a run is shown: everything a user may choose about a movie or a still.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "render/canvas/canvas.h"
#include "render/canvas/colour_map.h"
#include "render/gl/image.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

enum class Quality { draft, movie, figure };
/// Cells by K, its change since the first frame or their distance from the net over rho; or rods by
/// how far they moved over the depth, their bending energy over length or their axial force.
enum class ColourBy { none, K, displacement, K_change, deviation, energy, axial_force };
enum class Pace { even, eased };

/// What things look like, the theme's choices and the user's in one.
struct Appearance {
  double rod_mm = 0, joint_mm = 3, ring_mm = 1.4;  ///< widths as drawn, no less than a pixel
  Colour rod{0.16f, 0.17f, 0.20f, 1}, joint{0.75f, 0.12f, 0.10f, 1}, ring{0.3f, 0.33f, 0.38f, 1},
      background{1, 1, 1, 1};                  ///< a background of alpha 0 stays out of the picture
  std::optional<ColourMap> map;                ///< else by the values
  std::optional<std::array<double, 2>> range;  ///< of the colours, else by the values
  bool cells = true, rings = true, floor = true, shadow = true;
  double sheen = 1;        ///< of rods and joints; 0: ink
  double far_fade = 0.25;  ///< of the far side, into the background
  bool letters = true;     ///< of the panels of a figure

  bool operator==(const Appearance&) const = default;
};

/// White, with black rods: as in the paper's figures.
Appearance paper_appearance();

/// A direction from which the shell is seen.
struct ViewDirection {
  double azimuth_deg = 30, elevation_deg = 22;

  bool operator==(const ViewDirection&) const = default;
};

struct MovieStyle {
  int width = 1280, height = 720;  ///< pixels
  int fps = 30;
  Quality quality = Quality::movie;
  ColourBy colour_by = ColourBy::K;
  double azimuth_deg = 30, elevation_deg = 22;  ///< of the camera at the first frame
  double turn_deg = 40;                         ///< how far it turns until the last
  double zoom = 1;                              ///< 1: the whole run just fits its panel
  std::optional<Eigen::Vector3d> target_mm;     ///< in the middle of the panel, else all that moves
  bool orthographic = false;
  std::vector<ViewDirection> views;                 ///< more of them, beside one another
  bool inset = true;                                ///< the small top view
  bool bins = false;                                ///< K of the cells in bins along x, as a plot
  std::optional<std::array<double, 2>> bins_range;  ///< of its axis, rad; else the run's
  bool captions = true;                             ///< title, radius, height, frame, events
  bool legends = true;                              ///< the colour bar
  bool heading = false;                             ///< room above for two lines of a still
  double scale_bar_mm = 0;                          ///< 0: none
  std::string title;                                ///< shown as it is
  std::string source;     ///< figure or movie that it follows, on the title card
  Print print;            ///< of figures
  bool vector = false;    ///< stills as lines too
  double font_scale = 1;  ///< of all text
  Appearance look;
  double seconds = 0, hold_s = 0, title_s = 0;  ///< of the movie; 0: frames / fps, none, none
  Pace pace = Pace::even;

  bool operator==(const MovieStyle&) const = default;
};

/// Draft: no shadow; movie: with soft shadow; figure: many passes with jittered light. A sample a
/// pixel is enough: what is thin knows how much of it is covered.
DrawQuality draw_quality(Quality quality);
/// The same, as the look wants it.
DrawQuality draw_quality(const MovieStyle& style);

// What stands before a movie: its title and what it follows.

/// A card of the movie's size with its title and, where there is one, its source below. Long titles
/// are set in several lines, and smaller until they fit.
Image title_card(const MovieStyle& style);

}  // namespace gridshell::render
