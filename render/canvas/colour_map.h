// Colour maps, made in the colour space Oklab, in which equal distances look equal [Ottosson 2020],
// and colours of text and lines on white and on dark paper.
#pragma once

#include <vector>

#include "render/gl/image.h"

namespace gridshell::render {

/// Lightness and two opponent axes (green-red, blue-yellow).
struct Oklab {
  double L = 0, a = 0, b = 0;
};
Oklab to_oklab(Colour colour);
/// Components outside of sRGB are clipped.
Colour to_colour(Oklab lab, float alpha = 1);

/// The contrast of a colour with white: 1.05/(Y + 0.05), Y its relative luminance [WCAG 2.1].
double contrast_to_white(Colour colour);
/// Whether black on this paper would not be visible; a transparent paper is not dark.
bool is_dark(Colour paper);
/// The colour of text or of a line on dark paper, for a colour chosen for white paper.
Colour text_on_dark(Colour colour);
Colour line_on_dark(Colour colour);
/// A colour for text on white: the given one, darkened until its contrast is 4.5.
Colour readable(Colour colour);

/// The map blue - white - red over t in [-1, 1] (clipped): from the neutral middle two straight
/// lines of equal length and equal lightness in Oklab, so that equal |t| looks equally strong.
/// `start` darkens the middle by that fraction of the distance to the ends' lightness.
Colour diverging(double t, double start = 0);
/// A diverging map for print without colours: blue is dark, red is light.
Colour diverging_in_print(double t, double start = 0);

/// The map sand - apricot - coral - plum - indigo over t in [0, 1] (clipped), from light to dark.
/// Equal steps of t are equal distances in Oklab. Small values are light, so that dark rods are
/// visible on them.
Colour sequential(double t, double start = 0);

/// Light to dark grey over t in [0, 1], for print without colours.
Colour grey(double t, double start = 0);

/// One of the four maps. `start` leaves out that fraction of a map over [0, 1] at its light end.
using ColourMap = Colour (*)(double t, double start);

/// The colours of values from `low` to `high`, which take all of a sequential map. A diverging map
/// is symmetric about zero and reaches to the larger of |low| and |high|. Values outside have the
/// colours of the ends, values that are not finite are grey.
struct ColourScale {
  ColourMap map = diverging;
  double low = -1, high = 1;
  double start = 0;  ///< of the map: its lightest colours are left out for thin lines on white

  Colour operator()(double value) const;
  bool operator==(const ColourScale&) const = default;
};

/// A diverging scale, symmetric about zero, for `values`. Its end is the `quantile` of their
/// magnitudes (or the largest, if that is at most 1.3 times as large), rounded up to a round
/// number, so that a few extreme cells do not make the others pale. Values that are not finite are
/// ignored; if there are no others, or all are zero, the end is 1.
ColourScale symmetric_scale(std::vector<double> values, double quantile);

}  // namespace gridshell::render
