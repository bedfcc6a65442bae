// How a run is shown: everything a user may choose about a movie or a still.
#pragma once

#include <string>

#include "engine/core/words.h"
#include "render/draw/drawing.h"

namespace gridshell::render {

enum class Quality { draft, movie, figure };
constexpr auto words(Quality) {
  return word_table<Quality>(
      {{Quality::draft, "draft"}, {Quality::movie, "movie"}, {Quality::figure, "figure"}});
}
enum class ColourBy { none, K, displacement };
constexpr auto words(ColourBy) {
  return word_table<ColourBy>(
      {{ColourBy::none, "none"}, {ColourBy::K, "K"}, {ColourBy::displacement, "displacement"}});
}

struct MovieStyle {
  int width = 1280, height = 720;  ///< pixels
  int fps = 30;
  Quality quality = Quality::movie;
  ColourBy colour_by = ColourBy::K;
  double azimuth_deg = 30, elevation_deg = 22;  ///< of the camera at the first frame
  double turn_deg = 40;                         ///< how far it turns until the last
  double zoom = 1;                              ///< 1: the whole run just fits
  bool inset = true;                            ///< the small top view
  bool bins = false;                            ///< K of the cells in bins along x, as a plot
  bool captions = true;                         ///< title, radius, height, frame, events
  bool legends = true;                          ///< the colour bar
  double K_limit = 0;                           ///< end of the colours of K, rad; 0: the run's own
  double scale_bar_mm = 0;                      ///< 0: none
  std::string title;                            ///< shown as it is

  bool operator==(const MovieStyle&) const = default;
};

/// Draft: one sample a pixel and no shadow; movie: 2 x 2 with soft shadow; figure: 64 passes with
/// jittered light.
DrawQuality draw_quality(Quality quality);

}  // namespace gridshell::render
