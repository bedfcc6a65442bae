#include "render/draw/lighting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gridshell::render {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double key_azimuth = -70 * pi / 180;  // from the camera's, to its left
constexpr double key_elevation = 60 * pi / 180;
constexpr double key_disc = 5 * pi / 180;  // radius of the light's disc
constexpr double key_spread = 0.04;        // narrower than the disc's: shadows of thin rods stay
constexpr double key_share = 0.55;         // of the light on ground that faces up
constexpr double ground_share = 0.5;       // of the sky's light returned by the ground

Eigen::Vector3d key_direction(const Camera& camera) {
  // from straight above the picture's up is +y: the light stands as for a camera in the south
  const bool straight = std::abs(camera.elevation_deg) > 90 - 1e-6;
  const double azimuth = (straight ? -pi / 2 : camera.azimuth_deg * pi / 180) + key_azimuth;
  return {std::cos(key_elevation) * std::cos(azimuth), std::cos(key_elevation) * std::sin(azimuth),
          std::sin(key_elevation)};
}

/// Point i of the two-dimensional sequence with the plastic number's powers as steps, from `start`.
Eigen::Vector2d sequence(int i, double start) {
  constexpr double plastic = 1.32471795724474602596;
  const double x = start + (i + 1) / plastic, y = start + (i + 1) / (plastic * plastic);
  return {x - std::floor(x), y - std::floor(y)};
}

/// A direction on the disc of angular radius `key_disc` about `axis`.
Eigen::Vector3d on_disc(const Eigen::Vector3d& axis, const Eigen::Vector2d& p) {
  const Eigen::Vector3d across = axis.unitOrthogonal();
  const double r = std::tan(key_disc) * std::sqrt(p.x()), angle = 2 * pi * p.y();
  return (axis + r * (std::cos(angle) * across + std::sin(angle) * axis.cross(across)))
      .normalized();
}

/// A direction even over the upper half sphere, kept off the horizon where shadows are endless.
Eigen::Vector3d on_sky(const Eigen::Vector2d& p) {
  const double z = 0.08 + 0.92 * p.x(), r = std::sqrt(1 - z * z), angle = 2 * pi * p.y();
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Scales the key weights of passes [first, last) so that level ground receives `share` of the mean
/// over all passes.
void normalise(std::vector<Lighting>& passes, int first, int last, double share) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += passes[i].direction.z();
  for (int i = first; i < last; ++i) passes[i].key = share * double(passes.size()) / sum;
}

}  // namespace

std::vector<Lighting> lighting_passes(const Camera& camera, int passes) {
  const Eigen::Vector3d key = key_direction(camera);
  const double sky = 1 - key_share, bounce = ground_share * sky;
  if (passes <= 1) return {{key, key_share / key.z(), sky, bounce, key_spread}};
  std::vector<Lighting> result(passes);
  const int keys = std::clamp(int(std::lround(key_share * passes)), 1, passes - 1);
  for (int i = 0; i < passes; ++i) {
    const Eigen::Vector2d p = sequence(i, 0.5);
    result[i].direction = i < keys ? on_disc(key, p) : on_sky(p);
    result[i].bounce = bounce;
    // each direction stands for its part of the sky: blurred so wide, single shadows do not show
    result[i].spread = i < keys ? 0.01 : std::sqrt(2 * pi / (passes - keys));
    result[i].pixel_shift = sequence(i, 0.25) - Eigen::Vector2d::Constant(0.5);
  }
  normalise(result, 0, keys, key_share);
  normalise(result, keys, passes, sky);
  return result;
}

}  // namespace gridshell::render
