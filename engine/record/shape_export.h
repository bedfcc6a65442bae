// One frame of a run as other programs see it: rods as lines or tubes, cells as quadrilaterals.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/drawing.h"
#include "engine/record/trajectory.h"

namespace gridshell::exports {

/// What is written; what it refers to must outlive it.
struct Shape {
  const record::Layout& layout;
  const record::Frame& frame;
  const record::Frame& start;  ///< what displacements are from: the first frame of the run
  std::string title;
};

/// A rod's nodes from end to end, 3 x n, mm.
Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod);

/// The node of each joint.
std::vector<int> nodes_of_joints(const record::Layout& layout);

/// Reaction at each node of the frame, N: 0 without a constraint, NaN if the run did not record it.
Eigen::Matrix3Xd reactions_N(const record::Layout& layout, const record::Frame& frame);

/// Four corners of a cell, joints in order, 3 x 4, mm.
Eigen::Matrix<double, 3, 4> cell_corners(const record::Layout& layout, const record::Frame& frame,
                                         std::size_t cell);

/// A rod as a tube: `sides` vertices around each point, ends closed.
struct Tube {
  Eigen::Matrix3Xd vertices, normals;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise from outside
};

/// The directions around it are carried along without twist. The same number of points gives the
/// same triangles.
Tube tube_around(const Eigen::Matrix3Xd& points, double radius_mm, int sides);

// Shapes as text for other programs: Rhino and Blender (.obj, .dxf), ParaView (.vtp, .pvd, .xdmf),
// spreadsheets (.csv). Millimetres, z up.

/// Wavefront: a line element a rod (group `rods`), a point a joint, a face a cell (group `cells`).
std::string to_obj(const Shape& shape);
/// OBJ text with rods as tubes of their diameter (8 sides), and without joints.
std::string to_obj_tubes(const Shape& shape);

/// Rods as 3D polylines (layer `rods`) and the actuated boundary, for to_dxf().
Drawing rods_in_space(const Shape& shape);

/// VTK PolyData in ASCII: a polyline per rod with separate points, a polygon per cell. Point data:
/// `displacement_mm`, `curvature_per_mm`, `axial_force_N` (mean of the adjacent edges),
/// `stress_MPa`, `reaction_N` (a joint's at the cells' corner alone); cell data: `rod` (-1 for a
/// cell), `K_rad` (nan for a rod); field data: `TimeValue` (progress).
std::string to_vtp(const Shape& shape);
/// ParaView's list of such files over progress.
std::string to_pvd(const std::vector<double>& progress, const std::vector<std::string>& files);

/// XDMF of all frames of `trajectory.h5`: edges over /nodes at each progress with `axial_force_N`,
/// and the supports with `reaction_N`. For ParaView's `XDMF
/// Reader`; its Xdmf3 readers know no HyperSlab.
std::string to_xdmf(const record::Layout& layout, const record::FrameList& frames,
                    const std::string& trajectory);

/// `rod,point,x_mm,y_mm,z_mm,curvature_per_mm,axial_force_N,stress_MPa,reaction_x_N,
/// reaction_y_N,reaction_z_N`, rod by rod; forces empty where the run did not record them.
std::string to_csv(const Shape& shape);

// Colours of K for what other programs show: blue below zero, white at it, red above.

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

/// Evenly spaced frames that represent a run, the first and the last among them.
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

// Template page.html, in which "/*RUN*/" is replaced by the run.

extern const char* const page_template;

}  // namespace gridshell::exports
