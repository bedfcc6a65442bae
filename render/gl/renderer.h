// The geometry and colours of one frame, and the renderer that draws it. The meaning of colours is
// known to the code that chose them and draws the legend (render/canvas, render/movie).
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

/// Azimuth and elevation of a camera.
struct ViewDirection {
  double azimuth_deg = 30, elevation_deg = 22;
};
/// The standard views.
inline constexpr ViewDirection view_home{}, view_front{-90, 0}, view_side{0, 0}, view_top{-90, 90},
    view_corner{-45, 35.264};

/// A closed polyline drawn as a rod, for example the ring of the actuated boundary.
struct Ring {
  Eigen::Matrix3Xd points;  ///< 3 x n, mm
  double diameter_mm = 1;
  Colour colour;
  bool shadow = true;  ///< whether it casts a shadow
};

/// Rods drawn without joints, cells and shadow: a Chebyshev net, a block, an unloaded shape.
struct GhostRods {
  Eigen::Matrix3Xd nodes;
  std::vector<std::vector<int>> rods;
  double diameter_mm = 0.5;
  Colour colour;
  double behind_mm = 0;  ///< drawn as if it were farther from the camera by this
};

/// An arrow with a solid head, tip at `to`.
struct Arrow {
  Eigen::Vector3d from, to;
  double diameter_mm = 1;  ///< of its shaft
  Colour colour;
  bool shadow = true;  ///< whether it casts a shadow
};

/// Text centred at a point; drawn only in panels of figures.
struct PointLabel {
  Eigen::Vector3d at;
  std::string text;  ///< with markup (render/canvas/text.h)
  bool bold = false;
};

/// A ball around a point.
struct PointMark {
  Eigen::Vector3d at;
  double diameter_mm = 4;
  Colour colour;
  bool over = true;  ///< also drawn over parts that are nearer by less than a spacing
};

/// The geometry of one frame.
struct Drawing {
  const record::Layout* layout = nullptr;  ///< never null when drawn
  Eigen::Matrix3Xd nodes;                  ///< mm
  /// Diameter as drawn, which may be larger than the rod's; rods of other diameters are drawn in
  /// proportion.
  double rod_diameter_mm = 1;
  /// Width and thickness of rod 0, of rod 1, ... if they are drawn as boxes; 0: a round rod. May be
  /// shorter than the rods.
  std::vector<double> laths_mm;
  Colour rod_colour{0.16f, 0.17f, 0.20f};
  /// One colour per node, drawn without light; empty: all rods in rod_colour.
  std::vector<Colour> node_colours;
  double joint_diameter_mm = 3;  ///< 0: none
  Colour joint_colour{0.75f, 0.12f, 0.10f};
  /// One colour per cell, with alpha, drawn without light as in the colour bar; empty: no cells.
  std::vector<Colour> cell_colours;
  std::vector<Ring> rings;
  std::vector<GhostRods> ghosts;
  std::vector<Arrow> arrows;
  std::vector<PointMark> marks;
  std::vector<PointLabel> labels;
  double sheen = 1;        ///< of rods and joints; 0: flat ink
  double far_fade = 0.16;  ///< fraction of the background's colour in that of the farthest parts
  double ground_z_mm = 0;  ///< height of the ground
  bool ground = true;
  Colour ground_colour{0.93f, 0.93f, 0.94f};
  Colour background{1, 1, 1};  ///< alpha 0: the picture is clear where nothing is drawn
};

/// Effort of drawing a frame.
struct DrawQuality {
  int supersample = 2;      ///< s x s samples per pixel
  bool shadow = true;       ///< soft-edged shadow on the ground and the shell
  int jittered_passes = 1;  ///< above 1: light and pixel jittered over that many passes, averaged
  bool coarse = false;      ///< rods and cells in few pieces, up to a pixel wrong: while it moves
};

// The projection of a Camera, also for labels on a picture.

/// The camera's axes in space: unit vectors, forward = up x right points away from the viewer.
struct CameraAxes {
  Eigen::Vector3d right, up, forward;
};

CameraAxes camera_axes(const Camera& camera);

/// Distance from the camera to its target, mm. Of an orthographic camera, whose picture does not
/// depend on it, ten half extents.
double camera_distance(const Camera& camera);

/// Matrix from world to clip coordinates of a picture with `aspect` = width / height. Near and far
/// planes enclose the part of the sphere (`centre`, `radius`) in front of the camera.
Eigen::Matrix4d view_projection(const Camera& camera, double aspect, const Eigen::Vector3d& centre,
                                double radius);

/// Position of `point` (mm) in a picture of width x height pixels: x to the right, y down, from the
/// top left corner. Only for points in front of the camera.
Eigen::Vector2d to_pixel(const Camera& camera, int width, int height, const Eigen::Vector3d& point);

class Context;

/// Draws a Drawing into an Image with OpenGL 3.3 core. Owns programs, buffers and targets of one
/// context, which must outlive it.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(Context& context);
  virtual ~Renderer() = default;

  /// The picture of `drawing`, width x height pixels, the same to the bit in every run and for any
  /// number of rasteriser threads. Errors: Fault::bad_input for a size or quality outside its
  /// range, or a drawing that is not consistent; Fault::io if OpenGL fails, for example without
  /// memory.
  virtual Result<Image> draw(const Drawing& drawing, const Camera& camera,
                             const DrawQuality& quality, int width, int height) = 0;
};

}  // namespace gridshell::render
