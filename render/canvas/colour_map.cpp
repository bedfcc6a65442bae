#include "render/canvas/colour_map.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

/// A component in linear light, which may be outside [0, 1], as sRGB.
float clamped_srgb(double v) { return float(to_srgb(std::clamp(v, 0.0, 1.0))); }

Oklab mix(Oklab p, Oklab q, double t) {
  return {p.L + (q.L - p.L) * t, p.a + (q.a - p.a) * t, p.b + (q.b - p.b) * t};
}

// a colour by lightness, chroma and hue (rad)
Oklab from_polar(double L, double chroma, double hue) {
  return {L, chroma * std::cos(hue), chroma * std::sin(hue)};
}

// `count` points at equal distances on a smooth curve through the knots [Catmull and Rom 1974]
std::vector<Oklab> even_steps(const std::vector<Oklab>& knots, int count) {
  const int fine = 64, last = int(knots.size()) - 1;
  const auto at = [&](int k) { return knots[std::size_t(std::clamp(k, 0, last))]; };
  const auto blend = [](double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  };
  std::vector<Oklab> curve;
  std::vector<double> length;
  for (int n = 0; n <= fine * last; ++n) {
    const int k = std::min(n / fine, last - 1);
    const double t = double(n - k * fine) / fine;
    const Oklab a = at(k - 1), b = at(k), c = at(k + 1), d = at(k + 2);
    curve.push_back(
        {blend(a.L, b.L, c.L, d.L, t), blend(a.a, b.a, c.a, d.a, t), blend(a.b, b.b, c.b, d.b, t)});
    const Oklab& q = curve.back();
    const Oklab& p = n > 0 ? curve[std::size_t(n) - 1] : q;
    length.push_back((n > 0 ? length.back() : 0) + std::hypot(q.L - p.L, q.a - p.a, q.b - p.b));
  }
  std::vector<Oklab> even;
  for (int n = 0; n < count; ++n) {
    const double requested = length.back() * n / (count - 1);
    const auto after = std::size_t(std::clamp<long>(
        std::ranges::lower_bound(length, requested) - length.begin(), 1, long(length.size()) - 1));
    const double step = length[after] - length[after - 1];
    even.push_back(
        mix(curve[after - 1], curve[after],
            step > 0 ? std::clamp((requested - length[after - 1]) / step, 0.0, 1.0) : 0));
  }
  return even;
}

double begun(double t, double start) { return start + (1 - start) * std::clamp(t, 0.0, 1.0); }

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
  return {clamped_srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          clamped_srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          clamped_srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), alpha};
}

double contrast_to_white(Colour c) {
  const double luminance =
      0.2126 * to_linear(c.r) + 0.7152 * to_linear(c.g) + 0.0722 * to_linear(c.b);
  return 1.05 / (luminance + 0.05);
}

Colour readable(Colour colour) {
  Oklab lab = to_oklab(colour);
  for (; contrast_to_white(colour) < 4.5; colour = to_colour(lab, colour.a)) lab.L -= 0.005;
  return colour;
}

Colour diverging(double t, double start) {
  // the ends have the largest chroma that both hues have at this lightness within sRGB
  constexpr double middle_L = 0.975, end_L = 0.46, end_chroma = 0.165;
  constexpr double blue = 258 * 3.14159265358979 / 180, red = 26 * 3.14159265358979 / 180;
  t = std::clamp(t, -1.0, 1.0);
  return to_colour(mix({middle_L + start * (end_L - middle_L), 0, 0},
                       from_polar(end_L, end_chroma, t < 0 ? blue : red), std::abs(t)));
}

Colour diverging_in_print(double t, double start) {
  constexpr double middle_L = 0.975, blue = 258 * 3.14159265358979 / 180,
                   red = 40 * 3.14159265358979 / 180;
  t = std::clamp(t, -1.0, 1.0);
  const double end_L = t < 0 ? 0.3 : 0.7, chroma = t < 0 ? 0.13 : 0.15;
  return to_colour(mix({middle_L + start * (end_L - middle_L), 0, 0},
                       from_polar(end_L, chroma, t < 0 ? blue : red), std::abs(t)));
}

Colour sequential(double t, double start) {
  static const std::vector<Oklab> table = even_steps({{0.935, -0.002, 0.045},
                                                      {0.79, 0.066, 0.105},
                                                      {0.645, 0.135, 0.070},
                                                      {0.47, 0.140, -0.045},
                                                      {0.31, 0.055, -0.125}},
                                                     256);
  const double x = begun(t, start) * double(table.size() - 1);
  const std::size_t k = std::min(std::size_t(x), table.size() - 2);
  return to_colour(mix(table[k], table[k + 1], x - double(k)));
}

Colour grey(double t, double start) { return to_colour({0.95 - 0.75 * begun(t, start), 0, 0}); }

Colour ColourScale::operator()(double value) const {
  if (!std::isfinite(value)) return {0.6f, 0.6f, 0.6f, 1};
  // a diverging map is symmetric about zero, whichever part of it the scale shows
  if (map == diverging || map == diverging_in_print) {
    const double end = std::max(std::abs(low), std::abs(high));
    return map(end > 0 ? std::clamp(value, low, high) / end : 0, start);
  }
  const double t = high > low ? (value - low) / (high - low) : 0.5;
  // values farther from zero are darker
  return map(high <= 0 && low < 0 ? 1 - t : t, start);
}

ColourScale symmetric_scale(std::vector<double> values, double quantile) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  for (double& v : values) v = std::abs(v);
  double end = 0;
  if (!values.empty()) {
    const auto k = std::size_t(std::clamp(quantile, 0.0, 1.0) * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + long(k), values.end());
    end = values[k];
    // the largest value is chosen if it is not much larger, or if most values are zero
    const double largest = *std::ranges::max_element(values);
    if (largest <= 1.3 * end || end < 1e-9) end = largest;
  }
  end = end > 1e-12 ? nice_ceiling(end) : 1;
  return {diverging, -end, end};
}

bool is_dark(Colour paper) { return paper.a > 0.5f && contrast_to_white(paper) > 7; }

Colour text_on_dark(Colour colour) {
  if (contrast_to_white(colour) < 3) return colour;
  // lighter, but a saturated colour less, so that its hue remains visible
  const float most = std::max({colour.r, colour.g, colour.b}),
              least = std::min({colour.r, colour.g, colour.b});
  const float part = most - least > 0.25f ? 0.5f : std::clamp(0.95f - most, 0.3f, 0.9f);
  return {std::lerp(colour.r, 1.f, part), std::lerp(colour.g, 1.f, part),
          std::lerp(colour.b, 1.f, part), colour.a};
}

Colour line_on_dark(Colour colour) {
  constexpr Colour grey{0.52f, 0.54f, 0.58f, 1};
  // a colour that is not neutral has a meaning and is not changed
  const auto [least, most] = std::ranges::minmax({colour.r, colour.g, colour.b});
  const bool kept = contrast_to_white(colour) < 7 || most - least > 0.12f;
  return kept ? colour : Colour{grey.r, grey.g, grey.b, colour.a};
}

}  // namespace gridshell::render
