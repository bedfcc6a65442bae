// What is to be drawn of one frame: geometry with its colours, and how. It knows nothing of what a
// colour means; the legend belongs to whoever mapped a quantity to it (render/plot).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"
#include "render/gl/image.h"

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

/// Azimuth and elevation of a view, and the standard ones.
struct ViewDirection {
  double azimuth_deg = 30, elevation_deg = 22;
};
inline constexpr ViewDirection view_home{}, view_front{-90, 0}, view_side{0, 0}, view_top{-90, 90},
    view_corner{-45, 35.264};

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
  double behind_mm = 0;  ///< lies behind what is farther by less than this, too
};

/// An arrow with a solid head, tip at `to`.
struct Arrow {
  Eigen::Vector3d from, to;
  double diameter_mm = 1;  ///< of its shaft
  Colour colour;
};

/// Text at a point, centred on it; in the panels of figures alone.
struct PointLabel {
  Eigen::Vector3d at;
  std::string text;  ///< marked text
  bool bold = false;
};

/// A ball around a point.
struct PointMark {
  Eigen::Vector3d at;
  double diameter_mm = 4;
  Colour colour;
  bool over = true;  ///< what is nearer by less than a spacing too
};

/// One frame's worth of geometry.
struct Drawing {
  const record::Layout* layout = nullptr;  ///< never null when drawn
  Eigen::Matrix3Xd nodes;                  ///< mm
  /// As drawn, may be thicker than the rod; of those of other diameters in proportion.
  double rod_diameter_mm = 1;
  /// Width and thickness of each rod, one after the other, that is drawn as a box; 0: round ones.
  std::vector<double> laths_mm;
  Colour rod_colour{0.16f, 0.17f, 0.20f};
  /// Empty: all rods in rod_colour; else one per node, unlit as the cells' are.
  std::vector<Colour> node_colours;
  double joint_diameter_mm = 3;  ///< 0: none
  Colour joint_colour{0.75f, 0.12f, 0.10f};
  /// Empty: no cells; else one per cell, alpha counts; drawn without light, as their bar has them.
  std::vector<Colour> cell_colours;
  std::vector<Ring> rings;
  std::vector<GhostRods> ghosts;
  std::vector<Arrow> arrows;
  std::vector<PointMark> marks;
  std::vector<PointLabel> labels;
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
  bool coarse = false;      ///< rods and cells in few pieces, off by up to a sample: while it moves
};

// Where a Camera puts a point: the matrices of the renderer, and pixels for whoever labels a
// picture.

/// The camera's axes in space: unit vectors, forward = right x up turned away from the viewer.
struct CameraAxes {
  Eigen::Vector3d right, up, forward;
};

CameraAxes camera_axes(const Camera& camera);

/// From the camera to its target in mm; any length will do for an orthographic one.
double camera_distance(const Camera& camera);

/// World to clip coordinates of a picture with the given width / height. Near and far planes
/// enclose the sphere (`centre`, `radius`), as far as it lies before the camera.
Eigen::Matrix4d view_projection(const Camera& camera, double aspect, const Eigen::Vector3d& centre,
                                double radius);

/// Where `point` (mm) falls in a picture of width x height pixels: x to the right, y down, from the
/// top left corner. Only for points before the camera.
Eigen::Vector2d to_pixel(const Camera& camera, int width, int height, const Eigen::Vector3d& point);

// Draws a Drawing into an Image with OpenGL 3.3 core, in whatever context is current.

class Context;

/// Owns programs, buffers and targets of one context; the context outlives it.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(Context& context);
  virtual ~Renderer() = default;

  /// The picture of `drawing`, width x height pixels. Bit-identical from run to run and for any
  /// number of rasteriser threads. Errors: Fault::io when the context cannot provide a target of
  /// that size.
  virtual Result<Image> draw(const Drawing& drawing, const Camera& camera,
                             const DrawQuality& quality, int width, int height) = 0;
};

}  // namespace gridshell::render
