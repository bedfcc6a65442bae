#include "engine/preset/style_fields.h"

#include "engine/preset/field_makers.h"

namespace gridshell::preset {
namespace {

using P = Preset;
using M = Movie;
using S = Style;

std::vector<Field> more_movie_fields() {
  return {
      {"movie", "view", "", word<&P::movie, &M::view>(),
       "a standard view, in the place of azimuth_deg and elevation_deg"},
      {"movie", "target_mm", "mm", list<&P::movie, &M::target_mm>({}),
       "[x, y, z] that stands in the middle of the shell's panel; empty: the middle of all that "
       "moves"},
      {"movie", "orthographic", "", flag<&P::movie, &M::orthographic>(),
       "whether what is far is as large as what is near"},
      {"movie", "bins_range", "rad", list<&P::movie, &M::bins_range>({}),
       "[low, high] of the axis of the plot of bins, so that movies compare; empty: the run's own"},
      {"movie", "views", "", points<&P::movie, &M::views>({"azimuth", "elevation"}),
       "more views in each frame, beside one another, degrees"},
      {"movie", "seconds", "s", real<&P::movie, &M::seconds>(at_least(0)),
       "how long the movie is without hold and title card; 0: frames / fps"},
      {"movie", "hold_s", "s", real<&P::movie, &M::hold_s>(between(0, 60)),
       "how long the last frame stands"},
      {"movie", "title_s", "s", real<&P::movie, &M::title_s>(between(0, 60)),
       "how long a card with title and source stands at the begin; 0: none"},
      {"movie", "pace", "", word<&P::movie, &M::pace>(), "eased: slow at both ends"},
      {"movie", "webm", "", flag<&P::movie, &M::webm>(), "whether movie.webm is made too"},
      {"movie", "gif", "", flag<&P::movie, &M::gif>(), "whether movie.gif is made too"},
      {"movie", "poster", "", flag<&P::movie, &M::poster>(),
       "whether the last frame is kept as poster.png"},
  };
}

std::vector<Field> look_fields() {
  return {
      {"style", "theme", "", word<&P::style, &S::theme>(),
       "screen: coloured cells, floor and shadow; paper: black rods on white, as in the paper's "
       "figures"},
      {"style", "rod_width_mm", "mm", real<&P::style, &S::rod_width_mm>(at_least(0)),
       "width of rods as drawn, no less than a pixel; 0: the theme's"},
      {"style", "joint_width_mm", "mm", real<&P::style, &S::joint_width_mm>(at_least(0)),
       "of joints; 0: the theme's"},
      {"style", "ring_width_mm", "mm", real<&P::style, &S::ring_width_mm>(at_least(0)),
       "of the boundary; 0: the theme's"},
      {"style", "rod_colour", "", colour<&P::style, &S::rod_colour>(),
       "of rods; empty: the theme's"},
      {"style", "joint_colour", "", colour<&P::style, &S::joint_colour>(), "of joints"},
      {"style", "ring_colour", "", colour<&P::style, &S::ring_colour>(), "of the boundary"},
      {"style", "background", "", colour<&P::style, &S::background>(),
       "behind the shell; \"transparent\" leaves it out of the PNG"},
      {"style", "colour_map", "", word<&P::style, &S::colour_map>(),
       "auto: sequential where the values have one sign, else diverging about zero"},
      {"style", "range", "", list<&P::style, &S::range>({}),
       "[low, high] of the colours, in the unit of the colour bar; empty: of all cases together"},
      {"style", "cells", "", word<&P::style, &S::cells>(), "whether cells are shown"},
      {"style", "joints", "", word<&P::style, &S::joints>(), "whether joints are shown"},
      {"style", "rings", "", word<&P::style, &S::rings>(), "whether the boundary is shown"},
      {"style", "floor", "", word<&P::style, &S::floor>(), "whether there is a floor"},
      {"style", "shadow", "", word<&P::style, &S::shadow>(), "whether shadows are cast"},
      {"style", "far_fade", "", real<&P::style, &S::far_fade>(between(0, 1)),
       "by how much the far side pales into the background"},
      {"style", "letters", "", flag<&P::style, &S::letters>(),
       "whether the panels of a figure bear letters"},
      {"style", "font", "", text<&P::style, &S::font>(),
       "family of all text, in all cases; empty: DejaVu Sans, which has every sign"},
      {"style", "font_size", "", real<&P::style, &S::font_size>(between(0.5, 2)),
       "of all text, over its usual size"},
  };
}

std::vector<Field> print_fields() {
  return {
      {"figure", "quality", "", word<&P::figure, &Figure::quality>(),
       "of stills, as [movie] quality"},
      {"figure", "width_mm", "mm", real<&P::figure, &Figure::width_mm>(at_least(0)),
       "width of a whole figure as printed; 0: as many pixels as [movie] size says"},
      {"figure", "dpi", "1/inch", real<&P::figure, &Figure::dpi>(between(30, 2400)),
       "pixels of an inch, where a width is given"},
      {"figure", "vector", "", flag<&P::figure, &Figure::vector>(),
       "whether stills are also drawn as lines, as SVG and PDF, hidden ones faded"},
      {"page", "kind", "", word<&P::page, &Page::kind>(),
       "figure of the paper that `figure` lays out on one page"},
      {"page", "photo", "", text<&P::page, &Page::photo>(),
       "a PNG in the photograph's place; empty: an empty frame"},
      {"page", "sweep", "", text<&P::page, &Page::sweep>(),
       "folder of a finished sweep over legs and rods in the phase diagram's place; empty: an "
       "empty "
       "frame"},
  };
}

}  // namespace

std::vector<Field> style_fields() {
  auto fields = more_movie_fields();
  for (const auto& more : {look_fields(), print_fields()})
    fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

}  // namespace gridshell::preset
