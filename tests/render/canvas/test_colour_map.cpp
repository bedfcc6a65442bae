#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "render/canvas/colour_map.h"

using namespace gridshell::render;

namespace {

double distance(const Oklab& p, const Oklab& q) {
  return std::sqrt((p.L - q.L) * (p.L - q.L) + (p.a - q.a) * (p.a - q.a) +
                   (p.b - q.b) * (p.b - q.b));
}

}  // namespace

TEST_CASE("Oklab has its published values and comes back") {
  // [Ottosson 2020]: white is (1, 0, 0)
  const Oklab white = to_oklab({1, 1, 1, 1});
  CHECK(white.L == Approx(1).margin(1e-5));
  CHECK(std::abs(white.a) < 1e-4);
  const Oklab red = to_oklab({1, 0, 0, 1});
  CHECK(red.L == Approx(0.62796).margin(1e-4));
  CHECK(red.a == Approx(0.22486).margin(1e-4));
  CHECK(red.b == Approx(0.12585).margin(1e-4));
  for (const Colour c : {Colour{0.2f, 0.5f, 0.9f, 1}, Colour{0.8f, 0.1f, 0.3f, 1}}) {
    const Colour back = to_colour(to_oklab(c));
    CHECK(back.r == Approx(c.r).margin(1e-4));
    CHECK(back.g == Approx(c.g).margin(1e-4));
    CHECK(back.b == Approx(c.b).margin(1e-4));
  }
}

TEST_CASE("the diverging map is neutral in the middle and equally strong on both sides") {
  const Oklab middle = to_oklab(diverging(0));
  CHECK(std::hypot(middle.a, middle.b) < 0.002);
  CHECK(middle.L > 0.95);
  double before = 0;
  for (int k = 1; k <= 20; ++k) {
    const double t = k / 20.0;
    const Oklab red = to_oklab(diverging(t)), blue = to_oklab(diverging(-t));
    CHECK(red.L == Approx(blue.L).margin(0.004));
    CHECK(distance(red, middle) == Approx(distance(blue, middle)).margin(0.004));
    CHECK(red.a > 0);
    CHECK(blue.b < 0);
    // equal steps look equal
    CHECK(distance(red, middle) - before ==
          Approx(distance(to_oklab(diverging(1)), middle) / 20).margin(0.004));
    before = distance(red, middle);
  }
  CHECK(diverging(7).r == diverging(1).r);
  CHECK(diverging(-7).b == diverging(-1).b);
}

TEST_CASE("the sequential maps darken from end to end, in steps that look equal") {
  std::vector<double> steps;
  for (int k = 0; k < 64; ++k) {
    const Oklab p = to_oklab(sequential(k / 64.0)), q = to_oklab(sequential((k + 1) / 64.0));
    CHECK(q.L < p.L);
    CHECK(to_oklab(grey((k + 1) / 64.0)).L < to_oklab(grey(k / 64.0)).L);
    steps.push_back(std::hypot(q.L - p.L, q.a - p.a, q.b - p.b));
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  CHECK(*most < 1.05 * *least);
  CHECK(to_oklab(sequential(0)).L > 0.9);
  CHECK(to_oklab(sequential(1)).L < 0.35);
}

TEST_CASE("a scale for thin lines begins where they can be seen") {
  const ColourScale lines{sequential, 0, 1, 0.2};
  CHECK(lines(0).b == sequential(0.2).b);
  CHECK(lines(1).b == sequential(1).b);
  CHECK(lines(0.5).b == sequential(0.6).b);
}

TEST_CASE("a scale maps its ends and clips outside, the unknown is grey") {
  const ColourScale scale{diverging, -0.1, 0.1};
  CHECK(scale(0.1).r == diverging(1).r);
  CHECK(scale(0.3).r == diverging(1).r);
  CHECK(scale(-0.1).b == diverging(-1).b);
  CHECK(scale(0.0).g == diverging(0).g);
  const Colour grey = scale(std::nan(""));
  CHECK(grey.r == grey.g);
  CHECK(grey.g == grey.b);
}

TEST_CASE("the symmetric scale is round and not paled by a few extreme cells") {
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k) values.push_back(0.036 * std::sin(k));
  CHECK(symmetric_scale(values, 0.99).high == Approx(0.04));
  CHECK(symmetric_scale(values, 0.99).low == Approx(-0.04));
  values[3] = -5;
  values[4] = std::numeric_limits<double>::quiet_NaN();
  values[5] = std::numeric_limits<double>::infinity();
  CHECK(symmetric_scale(values, 0.99).high == Approx(0.04));
  CHECK(symmetric_scale({0.01, -0.019}, 0.99).high == Approx(0.02));
  CHECK(symmetric_scale({}, 0.99).high == 1);
  CHECK(symmetric_scale({0, 0, 0}, 0.99).high == 1);
}

TEST_CASE("a diverging scale is about zero, whichever part of it is shown") {
  const ColourScale part{diverging, 0, 0.1}, more{diverging, -0.2, 0.1};
  CHECK(part(0).r == diverging(0).r);
  CHECK(part(0.1).r == diverging(1).r);
  CHECK(part(-0.1).b == diverging(0).b);  // below its low end
  CHECK(more(0).g == diverging(0).g);
  CHECK(more(-0.2).b == diverging(-1).b);
  CHECK(more(0.1).r == diverging(0.5).r);
}

TEST_CASE("in print without colours negative values are darker than positive ones") {
  for (const double t : {0.4, 0.7, 1.0}) {
    const Oklab positive = to_oklab(diverging_in_print(t)),
                negative = to_oklab(diverging_in_print(-t));
    CHECK(negative.L < positive.L - 0.3 * t);
    CHECK((positive.a > 0 && negative.b < 0));
  }
  const ColourScale part{diverging_in_print, -0.2, 0.1};
  CHECK(part(0).g == diverging_in_print(0).g);
}
