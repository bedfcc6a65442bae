// Text of a preset small enough to run in a moment, for tests of the complete program.
#pragma once

#include <fmt/format.h>

#include <string>

/// A circle, with the values that a test chooses.
struct SmallPreset {
  int rods = 4;  ///< per direction
  double radius_mm = 45, actuated_mm = 40;
  int edges = 2;  ///< per segment; 0: chosen from the tolerance
  int frames = 3;
  int width = 160, height = 120;  ///< of a picture
  const char* quality = "draft";
};

inline std::string small_preset(const SmallPreset& requested) {
  return fmt::format(
      R"(title = "small"
[footprint]
rods = {}
radius_mm = {}
[actuation]
radius_mm = {}
[accuracy]
edges_per_segment = {}
[movie]
frames = {}
size = [{}, {}]
quality = "{}"
)",
      requested.rods, requested.radius_mm, requested.actuated_mm, requested.edges, requested.frames,
      requested.width, requested.height, requested.quality);
}
