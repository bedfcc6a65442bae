// What is to be drawn of one frame: geometry with its colours, and how. It knows nothing of what a
// colour means; the legend belongs to whoever mapped a quantity to it (render/plot).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/record/snapshot.h"
#include "render/image/image.h"

namespace gridshell::render {

/// A perspective or orthographic camera that looks at `target` from the direction given by azimuth
/// (from +x towards +y) and elevation (above z = 0); z stays up (at elevation 90, +y is up).
struct Camera {
  double azimuth_deg = 30, elevation_deg = 22;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< mm
  double half_extent_mm = 150;    ///< half of the picture's height, in the plane through the target
  double field_of_view_deg = 20;  ///< 0: orthographic
  bool operator==(const Camera&) const = default;
};

/// A closed polyline drawn as a rod of its own (the ring of the actuated boundary).
struct Ring {
  Eigen::Matrix3Xd points;
  double diameter_mm = 1;
  Colour colour;
  bool shadow = true;  ///< whether it throws one
};

/// Rods drawn without joints or cells, behind the shell: an ansatz, a block, an unloaded shape.
struct GhostRods {
  Eigen::Matrix3Xd nodes;
  std::vector<std::vector<int>> rods;
  double diameter_mm = 0.5;
  Colour colour;
};

/// An arrow with a solid head, tip at `to`.
struct Arrow {
  Eigen::Vector3d from, to;
  double diameter_mm = 1;  ///< of its shaft
  Colour colour;
};

/// A ball around a point.
struct PointMark {
  Eigen::Vector3d at;
  double diameter_mm = 4;
  Colour colour;
};

/// One frame's worth of geometry.
struct Drawing {
  const record::Layout* layout = nullptr;  ///< never null when drawn
  Eigen::Matrix3Xd nodes;                  ///< mm
  /// As drawn, may be thicker than the rod; of those of other diameters in proportion.
  double rod_diameter_mm = 1;
  Colour rod_colour{0.16f, 0.17f, 0.20f};
  std::vector<Colour> node_colours;  ///< empty: all rods in rod_colour; else one a node
  double joint_diameter_mm = 3;      ///< 0: none
  Colour joint_colour{0.75f, 0.12f, 0.10f};
  std::vector<Colour> cell_colours;  ///< empty: no cells; else one a cell, alpha counts
  std::vector<Ring> rings;
  std::vector<GhostRods> ghosts;
  std::vector<Arrow> arrows;
  std::vector<PointMark> marks;
  double sheen = 1;        ///< of rods and joints; 0: ink
  double far_fade = 0.16;  ///< how much of the background lies over what is farthest, 0 to 1
  double ground_z_mm = 0;  ///< plane of the ground
  bool ground = true;
  Colour ground_colour{0.93f, 0.93f, 0.94f};
  Colour background{1, 1, 1};  ///< alpha 0: the picture is clear where nothing is drawn
};

/// How much work goes into a frame.
struct DrawQuality {
  int supersample = 2;      ///< s x s samples a pixel
  bool shadow = true;       ///< soft-edged shadow on the ground and the shell
  int jittered_passes = 1;  ///< above 1: light and pixel jittered over that many passes, averaged
};

}  // namespace gridshell::render
