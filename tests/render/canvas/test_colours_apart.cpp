// Colours that distinguish things do so for readers with any of the three kinds of colour
// blindness.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "render/canvas/colour_map.h"
#include "render/canvas/plot.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_figures.h"
#include "render/movie/state_charts.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

/// Linear RGB as it is seen: by all cones, without those for long, middle or short waves
/// [Machado 2009, severity 1].
const std::array<Eigen::Matrix3d, 4>& kinds_of_sight() {
  static const auto made = [] {
    std::array<Eigen::Matrix3d, 4> all;
    all[0].setIdentity();
    all[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
        1.051998;
    all[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
        0.968881;
    all[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
        0.303900;
    return all;
  }();
  return made;
}

/// CIE L*a*b* of linear sRGB, white D65.
Eigen::Vector3d to_lab(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  Eigen::Vector3d f = to_xyz * rgb;
  f.array() /= Eigen::Array3d(0.95047, 1, 1.08883);
  for (double& t : f) t = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116;
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// The least distance of two colours over all kinds of sight, Delta E of 1976.
double apart(Colour a, Colour b) {
  double least = INFINITY;
  for (const Eigen::Matrix3d& sight : kinds_of_sight()) {
    const auto seen = [&](Colour c) {
      const Eigen::Vector3d rgb = to_linear(c).head<3>().cast<double>();
      return to_lab((sight * rgb).cwiseMax(0).cwiseMin(1));
    };
    least = std::min(least, (seen(a) - seen(b)).norm());
  }
  return least;
}

constexpr double clearly = 12;

void check_all_apart(const std::vector<Colour>& colours) {
  for (std::size_t a = 0; a < colours.size(); ++a)
    for (std::size_t b = a + 1; b < colours.size(); ++b) {
      INFO(a << " and " << b);
      CHECK(apart(colours[a], colours[b]) > clearly);
    }
}

}  // namespace

TEST_CASE("red is distinct from blue for every kind of sight, brown not from olive green") {
  CHECK(apart({1, 0, 0, 1}, {0, 0, 1, 1}) > clearly);
  CHECK(apart({0.55f, 0.40f, 0.10f, 1}, {0.35f, 0.47f, 0.10f, 1}) < clearly);
}

TEST_CASE("series differ by colour, the later ones by colour or sign") {
  std::vector<Colour> first;
  for (std::size_t k = 0; k < 6; ++k) first.push_back(series_colour(k));
  check_all_apart(first);
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t b = a + 1; b < 10; ++b) {
      INFO(a << " and " << b);
      CHECK((series_marker(a) != series_marker(b) ||
             apart(series_colour(a), series_colour(b)) > clearly));
    }
}

TEST_CASE("shells, nets, blocks and measured joints have distinct colours") {
  record::Trajectory run;
  for (const char* name : {"a", "b", "c", "d"}) run.layout.parts.emplace_back().name = name;
  std::vector<Colour> blocks{ink};
  for (const ColourKey& key : BlockKinds({{&run, ""}}).keys()) blocks.push_back(key.colour);
  REQUIRE(blocks.size() == 5);
  check_all_apart(blocks);
  check_all_apart({ink, net_ink, scan_key().colour, white});
  check_all_apart({first_order_ink, higher_order_ink, mirror_ink, white});
}

TEST_CASE("the ends and the middle of colour maps are distinct") {
  check_all_apart({diverging(-1), diverging(0), diverging(1)});
  check_all_apart({diverging(-0.5), diverging(0), diverging(0.5)});
  check_all_apart({sequential(0), sequential(0.33), sequential(0.67), sequential(1)});
}

TEST_CASE("words have a contrast of 4.5 to 1 with white in every theme") {
  CHECK(contrast_to_white({0, 0, 0, 1}) == Approx(21));
  CHECK(contrast_to_white(white) == Approx(1));
  for (const auto& theme : {Appearance{}, paper_appearance()})
    for (const Colour& colour : {ink, pale_ink, event_ink, contact_ink})
      CHECK(contrast_to_white(colour) / contrast_to_white(theme.background) >= 4.5);
  for (std::size_t k = 0; k < 10; ++k) CHECK(contrast_to_white(readable(series_colour(k))) >= 4.5);
  // a colour that is dark enough is not changed
  CHECK(readable(ink).r == ink.r);
}
