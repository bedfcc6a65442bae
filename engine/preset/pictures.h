// The part of a preset that says what its pictures look like: movies, stills and pages.
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
enum class View { free, front, side, top, corner, push };
enum class Pace { even, eased, height };
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
  bool inset = true;  ///< the small top view
  bool bins = false;  ///< the plot of K in bins
  bool captions = true;
  bool beside = true;             ///< whether cases are shown next to one another in each frame
  View view = View::free;         ///< a standard view, which replaces azimuth and elevation
  std::vector<double> target_mm;  ///< (x, y, z) in the middle of the panel; empty: all that moves
  bool orthographic = false;
  std::vector<double> bins_range;  ///< (low, high) of the axis of the bins, rad; empty: the run's
  Points views;                    ///< (azimuth, elevation) of more views in each frame
  /// of the movie without the stills at its ends and the title; 0: frames / fps
  double seconds = 0;
  double hold_first_s = 0;  ///< of the first frame
  double hold_s = 0;        ///< of the last frame
  double title_s = 0;       ///< of a title card at the start
  Pace pace = Pace::even;
  bool webm = false, gif = false, poster = false;  ///< further files next to movie.mp4
};

enum class Theme { screen, paper, dark };
enum class ColourMap { automatic, diverging, sequential, grey, print };
constexpr auto words(ColourMap) {
  return names_except<ColourMap>({{ColourMap::automatic, "auto"}});
}
enum class Visibility { automatic, on, off };  ///< automatic: as the theme has it
constexpr auto words(Visibility) {
  return names_except<Visibility>({{Visibility::automatic, "auto"}});
}
/// How pictures look. An empty colour and a width of 0 are the theme's.
struct Style {
  Theme theme = Theme::screen;
  double rod_width_mm = 0, joint_width_mm = 0, ring_width_mm = 0;
  std::string rod_colour, joint_colour, ring_colour, background;
  ColourMap colour_map = ColourMap::automatic;
  std::vector<double> range;  ///< (low, high) of the colours; empty: of all cases together
  Visibility cells = Visibility::automatic, joints = Visibility::automatic,
             rings = Visibility::automatic, floor = Visibility::automatic,
             shadow = Visibility::automatic, loads = Visibility::automatic,
             braces = Visibility::automatic, ghost = Visibility::automatic;
  double far_fade = 0.25;  ///< by how much the far side pales
  bool letters = true;     ///< of the panels of a figure
  std::string font;        ///< family of all text; empty: the usual one
  double font_size = 1;    ///< of all text, over its usual size
};

enum class PageKind { none, fig1, fig2, fig3, fig4, fig5, literature };
/// A page that shows a figure of the paper, or shells of other authors next to one another.
struct Page {
  PageKind kind = PageKind::none;
  std::string photo;   ///< a PNG at the position of the photograph
  std::string sweep;   ///< folder or table of a finished sweep, for the phase diagram
  bool drawn = false;  ///< the page with rendered pictures of the shells too
};

struct Figure {
  Quality quality = Quality::figure;
  double width_mm = 0;  ///< as printed; 0: as many pixels as movie.size says
  double dpi = 300;
  bool vector = false;           ///< shells as lines in addition to their pictures
  double cut_step_mm = 0.1;      ///< lengths and marks of cut lists are multiples of it; 0: as are
  double stock_mm = 0;           ///< longest piece of rod that there is; 0: any
  std::vector<double> radii_mm;  ///< boundary radii of the stills
  double scale_bar_mm = 20;
  bool title = true;  ///< over every still, figure and plot
  Points scan;        ///< (x, y, z) of joints measured by others
};

}  // namespace gridshell::preset
