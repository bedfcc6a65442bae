// Colours of K for what other programs show: blue below zero, white at it, red above.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "engine/core/result.h"
#include "engine/record/shape_export.h"
#include "engine/record/trajectory.h"

namespace gridshell::exports {

/// Symmetric about zero; 98 of 100 cells lie within.
struct ColourRange {
  double end = 1;  ///< rad

  using Colour = std::array<double, 3>;  ///< sRGB, 0 to 1
  static constexpr Colour below{0.13, 0.40, 0.67}, zero{0.97, 0.97, 0.97}, above{0.70, 0.09, 0.17},
      unknown{0.7, 0.7, 0.7};

  /// From `zero` to `below` or `above`.
  std::array<double, 3> colour(double K) const;
};

ColourRange range_of(const Eigen::VectorXd& K);

/// From sRGB to linear light.
std::array<double, 3> linear(const std::array<double, 3>& srgb);

/// Which frames of a run stand for all: evenly, the first and the last among them.
std::vector<std::size_t> even_frames(std::size_t frames, std::size_t shown);

// A run as one binary glTF 2.0 file (.glb), which Blender, browsers and slides play.

/// Rods as tubes and cells in the colour of their last K, both as morph targets of up to 60 key
/// shapes, joints as spheres that move; an animation `run` of `seconds`. In metres, y up, as the
/// format wants it. Runs whose key shapes would take more than 20 MB have fewer sides and fewer of
/// them. Errors: bad_input for what takes more than that in one shape; what the frames say.
Result<std::string> to_glb(const record::Trajectory& run, const std::string& title, double seconds);

// A run as one HTML page that shows it in 3D in any browser, without a network.

/// The page: turned with the mouse or a finger, scrubbed through the frames, cells coloured by K
/// with its legend, and what certifies each frame in figures. Positions are rounded to 1/65535 of
/// the shell's size, frames are left out evenly where it would pass 10 MB. Errors: what the frames
/// say; bad_input where one frame alone is larger.
Result<std::string> to_page(const record::Trajectory& run, const std::string& title);

// The page of page.html, in which "/*RUN*/" stands for the run.

extern const char* const page_template;

}  // namespace gridshell::exports
