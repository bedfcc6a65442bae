// Quantities to colours. Both maps are made in Oklab, where equal steps look equal
// [Ottosson 2020].
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
/// Whether what is black would be lost on it; not of what is transparent.
bool is_dark(Colour paper);
/// The colour that text or a line has on dark paper, for a colour chosen for white.
Colour text_on_dark(Colour colour);
Colour line_on_dark(Colour colour);
/// For words on white: the colour itself, or darker until its contrast is 4.5.
Colour readable(Colour colour);

/// Blue - white - red over t in [-1, 1] (clipped): from the neutral middle two straight lines of
/// equal length and equal lightness, so that equal |t| looks equally strong. `start` greys the
/// middle by that fraction of the distance to the ends' lightness.
Colour diverging(double t, double start = 0);
/// A diverging map for print without colours: blue is dark, red is light.
Colour diverging_in_print(double t, double start = 0);

/// Sand - apricot - coral - plum - indigo over t in [0, 1] (clipped): lightness falls evenly, and
/// equal steps of t are equal distances in Oklab. Light where there is little, so that dark rods
/// are visible and paper stays white.
Colour sequential(double t, double start = 0);

/// Light to dark grey over t in [0, 1], for print without colours.
Colour grey(double t, double start = 0);

/// One of the three. `start` leaves out that fraction of a map of [0, 1] at its light end.
using ColourMap = Colour (*)(double t, double start);

/// What a value looks like: `low` … `high` over the whole map, of the diverging one as far as the
/// larger of the two sizes on both sides of zero; outside it the end colours, for an unknown value
/// grey.
struct ColourScale {
  ColourMap map = diverging;
  double low = -1, high = 1;
  double start = 0;  ///< where in its map the least size is, for thin lines on white

  Colour operator()(double value) const;
  bool operator==(const ColourScale&) const = default;
};

/// The diverging scale, symmetric about zero, that suits `values`: its end is the `quantile` of
/// their sizes (or the largest, where that is not far off), rounded up to a nice number, so that a
/// few extreme cells do not pale the others. Not finite values are ignored; without any, or all
/// zero, the end is 1.
ColourScale symmetric_scale(std::vector<double> values, double quantile);

}  // namespace gridshell::render
