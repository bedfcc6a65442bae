// The part of a preset that describes its pictures: movies, stills and pages.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

enum class Quality { draft, movie, figure };
enum class ColourBy {
  none,
  K,
  displacement,
  K_change,
  deviation,
  energy,
  axial_force,
  stress,
  utilisation,
  joint_angle
};
/// Whether a colour shows what only rods in equilibrium have, as a force; a net has only a shape.
constexpr bool needs_equilibrium(ColourBy by) {
  switch (by) {
    case ColourBy::energy:
    case ColourBy::axial_force:
    case ColourBy::stress:
    case ColourBy::utilisation:
    case ColourBy::joint_angle:
      return true;
    case ColourBy::none:
    case ColourBy::K:
    case ColourBy::displacement:
    case ColourBy::K_change:
    case ColourBy::deviation:
      return false;
  }
  return false;
}
enum class View { free, front, side, top, corner, push };
enum class Pace { even, eased, height };
/// Frames and camera of a movie.
struct Movie {
  int frames = 240;
  std::array<int, 2> size{1280, 720};
  int fps = 30;
  Quality quality = Quality::movie;
  ColourBy colour_by = ColourBy::K;
  double azimuth_deg = 30;    ///< camera at the first frame, from +x towards +y
  double elevation_deg = 22;  ///< camera, above the boundary's plane
  double turn_deg = 40;       ///< camera turn over the whole movie
  double zoom = 1;
  bool inset = true;  ///< whether the small top view is drawn
  bool bins = false;  ///< whether K of the cells is plotted in bins along x
  bool captions = true;
  bool beside = true;      ///< whether cases are shown next to one another in each frame
  View view = View::free;  ///< a standard view, which replaces azimuth and elevation
  /// point (x, y, z) in the middle of the panel; empty: the middle of all that moves
  std::vector<double> target_mm;
  bool orthographic = false;
  /// range (low, high) of the axis of the plot of bins, rad; empty: that of the run
  std::vector<double> bins_range;
  Points views;  ///< (azimuth, elevation) of more views in each frame
  /// duration of the movie without the title and the stills at its ends; 0: frames / fps
  double seconds = 0;
  double hold_first_s = 0;  ///< duration of the first frame
  double hold_s = 0;        ///< duration of the last frame
  double title_s = 0;       ///< duration of a title card at the start
  Pace pace = Pace::even;
  bool webm = false, gif = false, poster = false;  ///< further files next to movie.mp4
};

enum class Theme { screen, paper, dark };
enum class ColourMap { automatic, diverging, sequential, grey, print };
constexpr auto words(ColourMap) {
  return names_except<ColourMap>({{ColourMap::automatic, "auto"}});
}
enum class Visibility { automatic, on, off };  ///< automatic: chosen by the theme
constexpr auto words(Visibility) {
  return names_except<Visibility>({{Visibility::automatic, "auto"}});
}
/// How pictures look. An empty colour and a width of 0 are the theme's.
struct Style {
  Theme theme = Theme::screen;
  double rod_width_mm = 0, joint_width_mm = 0, ring_width_mm = 0;
  std::string rod_colour, joint_colour, ring_colour, background;
  ColourMap colour_map = ColourMap::automatic;
  std::vector<double> range;  ///< (low, high) of the colours; empty: chosen for all cases together
  Visibility cells = Visibility::automatic, joints = Visibility::automatic,
             rings = Visibility::automatic, floor = Visibility::automatic,
             shadow = Visibility::automatic, loads = Visibility::automatic,
             braces = Visibility::automatic, ghost = Visibility::automatic;
  double far_fade = 0.25;  ///< fraction by which the far side fades into the background
  bool letters = true;     ///< whether the panels of a figure have letters
  std::string font;        ///< font family of all text; empty: DejaVu Sans
  double font_size = 1;    ///< size of all text over its usual size
};

enum class PageKind { none, fig1, fig2, fig3, fig4, fig5, literature };
/// A page that shows a figure of the paper, or shells of other authors next to one another.
struct Page {
  PageKind kind = PageKind::none;
  std::string photo;   ///< a PNG that replaces the photograph
  std::string sweep;   ///< folder or table of a finished sweep, for the phase diagram
  bool drawn = false;  ///< whether the page is also made with rendered pictures of the shells
};

/// Stills, figures and cut lists.
struct Figure {
  Quality quality = Quality::figure;
  double width_mm = 0;  ///< printed width; 0: the pixels of movie.size
  double dpi = 300;
  bool vector = false;           ///< whether shells are also drawn as lines, as SVG and PDF
  double cut_step_mm = 0.1;      ///< step of lengths and marks in cut lists; 0: all digits
  double stock_mm = 0;           ///< length in which rods are sold; 0: any length
  std::vector<double> radii_mm;  ///< boundary radii of the stills
  double scale_bar_mm = 20;
  bool title = true;  ///< whether every still, figure and plot has its title above it
  Points scan;        ///< positions (x, y, z) of joints measured by others
};

}  // namespace gridshell::preset
