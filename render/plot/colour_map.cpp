#include "render/plot/colour_map.h"

#include <algorithm>
#include <cmath>

#include "render/draw/colour.h"
#include "render/plot/ticks.h"

namespace gridshell::render {
namespace {

double gamma(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

Oklab mix(Oklab p, Oklab q, double t) {
  return {p.L + (q.L - p.L) * t, p.a + (q.a - p.a) * t, p.b + (q.b - p.b) * t};
}

// polar form: chroma and hue in radians
Oklab from_polar(double L, double chroma, double hue) {
  return {L, chroma * std::cos(hue), chroma * std::sin(hue)};
}

}  // namespace

Oklab to_oklab(Colour c) {
  const double r = to_linear(c.r), g = to_linear(c.g), b = to_linear(c.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour to_colour(Oklab lab, float alpha) {
  const double l = std::pow(lab.L + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.L - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.L - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {float(gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
          float(gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
          float(gamma(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)), alpha};
}

Colour diverging(double t) {
  // lightness and chroma of the ends are the strongest that both hues have within sRGB
  constexpr double middle_L = 0.975, end_L = 0.46, end_chroma = 0.165;
  constexpr double blue = 258 * 3.14159265358979 / 180, red = 26 * 3.14159265358979 / 180;
  t = std::clamp(t, -1.0, 1.0);
  return to_colour(
      mix({middle_L, 0, 0}, from_polar(end_L, end_chroma, t < 0 ? blue : red), std::abs(t)));
}

Colour sequential(double t) {
  static const std::array<Oklab, 9> knots = [] {
    constexpr std::array<int, 9> viridis = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                            0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
    std::array<Oklab, 9> labs;
    for (std::size_t k = 0; k < labs.size(); ++k)
      labs[k] = to_oklab({float(viridis[k] >> 16) / 255, float(viridis[k] >> 8 & 255) / 255,
                          float(viridis[k] & 255) / 255});
    return labs;
  }();
  const double x = std::clamp(t, 0.0, 1.0) * (knots.size() - 1);
  const std::size_t k = std::min<std::size_t>(std::size_t(x), knots.size() - 2);
  return to_colour(mix(knots[k], knots[k + 1], x - double(k)));
}

Colour ColourScale::operator()(double value) const {
  if (!std::isfinite(value)) return {0.6f, 0.6f, 0.6f, 1};
  const double t = high > low ? (value - low) / (high - low) : 0.5;
  return map == ColourMap::diverging ? diverging(2 * t - 1) : sequential(t);
}

ColourScale symmetric_scale(std::vector<double> values, double quantile) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  for (double& v : values) v = std::abs(v);
  double end = 0;
  if (!values.empty()) {
    const auto k = std::size_t(std::clamp(quantile, 0.0, 1.0) * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + long(k), values.end());
    end = values[k];
    // the largest value decides where it is not far off, or where most are zero
    const double largest = *std::max_element(values.begin(), values.end());
    if (largest <= 1.3 * end || end < 1e-9) end = largest;
  }
  end = end > 1e-12 ? nice_ceiling(end) : 1;
  return {ColourMap::diverging, -end, end};
}

}  // namespace gridshell::render
