// Exports of a run for other programs: one frame as lines, tubes and quadrilaterals, or all frames
// as a glTF model or an HTML page.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/drawing.h"
#include "engine/record/trajectory.h"

namespace gridshell::exports {

/// The frame that is exported. The objects that it refers to must outlive it.
struct Shape {
  const record::Layout& layout;
  const record::Frame& frame;
  const record::Frame& start;  ///< first frame of the run: displacements are relative to it
  std::string title;
};

/// A rod's nodes from end to end, 3 x n, mm.
Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod);

std::vector<int> nodes_of_joints(const record::Layout& layout);

/// Reaction at each node of the frame, 3 x nodes, N: 0 without a constraint, NaN if the run did not
/// record reactions.
Eigen::Matrix3Xd reactions_N(const record::Layout& layout, const record::Frame& frame);

/// Four corners of a cell, joints in order, 3 x 4, mm.
Eigen::Matrix<double, 3, 4> cell_corners(const record::Layout& layout, const record::Frame& frame,
                                         std::size_t cell);

/// A rod as a closed tube: `sides` vertices around each point, and one in the middle of each end.
struct Tube {
  Eigen::Matrix3Xd vertices, normals;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise from outside
};

/// A tube around `points` (3 x n, n >= 2). The directions of its vertices are transported along it
/// without twist. The triangles depend only on the numbers of points and sides.
Tube tube_around(const Eigen::Matrix3Xd& points, double radius_mm, int sides);

// Shapes as text for other programs: Rhino and Blender (.obj, .dxf), ParaView (.vtp, .pvd, .xdmf),
// spreadsheets (.csv). Millimetres, z up.

/// Wavefront OBJ: a line per rod (group `rods`), a point per joint (`joints`), a face per cell
/// (`cells`).
std::string to_obj(const Shape& shape);
/// OBJ text with rods as tubes of their diameter (8 sides), and without joints.
std::string to_obj_tubes(const Shape& shape);

/// Rods as 3D polylines (layer `rods`) and the actuated boundary, for to_dxf().
Drawing rods_in_space(const Shape& shape);

/// VTK PolyData in ASCII: a polyline per rod with separate points, a polygon per cell. Point data:
/// `displacement_mm`, `curvature_per_mm`, `axial_force_N` (mean of the adjacent edges),
/// `stress_MPa`, `reaction_N` (a joint's reaction only at the cells' corner, not on its rods); cell
/// data: `rod` (-1 for a cell), `K_rad` (nan for a rod); field data: `TimeValue` (progress).
std::string to_vtp(const Shape& shape);
/// ParaView's list of such files over progress.
std::string to_pvd(const std::vector<double>& progress, const std::vector<std::string>& files);

/// XDMF of all frames of `trajectory.h5`, over progress: edges with `axial_force_N`, and the
/// supports with `reaction_N`; the numbers are read from `trajectory`. For ParaView's `XDMF
/// Reader`; its Xdmf3 readers do not support HyperSlab.
std::string to_xdmf(const record::Layout& layout, const record::FrameList& frames,
                    const std::string& trajectory);

/// A table with one row per point of each rod, rod by rod, with the columns
/// `rod,point,x_mm,y_mm,z_mm,curvature_per_mm,axial_force_N,stress_MPa,reaction_x_N,reaction_y_N,
/// reaction_z_N`; forces are empty if the run did not record them.
std::string to_csv(const Shape& shape);

// Colours of K in exports: blue below zero, white at zero, red above.

/// The range of K from -end to end over which colours change.
struct ColourRange {
  double end = 1;  ///< rad

  using Colour = std::array<double, 3>;  ///< sRGB, 0 to 1
  static constexpr Colour below{0.13, 0.40, 0.67}, zero{0.97, 0.97, 0.97}, above{0.70, 0.09, 0.17},
      unknown{0.7, 0.7, 0.7};

  /// Colour of a value of K: linear from `zero` to `below` or `above`; `unknown` for NaN.
  std::array<double, 3> colour(double K) const;
};

/// The range that contains |K| of 98 % of the cells.
ColourRange range_of(const Eigen::VectorXd& K);

/// Converts a colour from sRGB to linear light.
std::array<double, 3> linear(const std::array<double, 3>& srgb);

/// Indices of `shown` evenly spaced frames of a run, with the first and the last; of one frame the
/// last.
std::vector<std::size_t> even_frames(std::size_t frames, std::size_t shown);

// A run as one binary glTF 2.0 file (.glb), which Blender, browsers and slides play.

/// The bytes of a .glb file: rods as tubes and cells in the colour of their last K, both as morph
/// targets of up to 60 key shapes; joints as spheres that move; an animation `run` of `seconds`. In
/// metres with y up, as the format requires. If the key shapes would take more than 20 MB, the
/// tubes have fewer sides, and then there are fewer shapes. The run must have a frame. Errors:
/// bad_input if one shape takes more than 20 MB; those of reading a frame.
Result<std::string> to_glb(const record::Trajectory& run, const std::string& title, double seconds);

// A run as one HTML page that shows it in 3D in any browser, without a network.

/// The text of the page. It can be turned with the mouse or a finger and played; cells are coloured
/// by K with a legend, and the certificate of each frame (residual, error, pivots) is shown.
/// Positions are rounded to 1/65535 of the shell's size. If the page would be larger than about
/// 10 MB, frames are left out evenly. The run must have a frame. Errors: bad_input if one frame
/// alone is larger; those of reading a frame.
Result<std::string> to_page(const record::Trajectory& run, const std::string& title);

/// The text of page.html, in which "/*RUN*/" is replaced by the run.
extern const char* const page_template;

}  // namespace gridshell::exports
