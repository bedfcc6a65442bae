// sRGB to linear light, where colours are mixed and shaded [IEC 61966-2-1].
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "render/image/image.h"

namespace gridshell::render {

/// One sRGB component in [0, 1] to linear light.
inline float to_linear(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// And back.
inline float to_srgb(float v) {
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

/// Linear r, g, b and the unchanged alpha.
inline Eigen::Vector4f to_linear(const Colour& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b), c.a};
}

}  // namespace gridshell::render
