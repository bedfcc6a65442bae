// Load cases on the formed shell: snow, wind, edge and point loads as forces on its nodes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/footprint.h"
#include "engine/preset/preset.h"

namespace gridshell {

// The faces that rods and boundary enclose; snow and wind act on them.

/// A face of the net: its corners in order, anticlockwise as seen from above the flat. Node numbers
/// are those of every mesh: joints, then edge points, start and end of rod r at 2 r and 2 r + 1.
struct Face {
  std::vector<int> corners;
  bool on_boundary = false;  ///< whether the side from last to first corner is the boundary, no rod
};

/// All faces of a planar footprint. Each is traversed with the face on the left: at every node
/// along the next rod to the left of the incoming one. At an edge point the boundary closes the
/// face by a straight line.
std::vector<Face> faces_of(const Footprint& footprint);

/// 1/2 sum of x_k x x_(k+1), mm^2: the area of a face of a shape, along its normal; its z is the
/// area in plan.
Eigen::Vector3d area_of(const Face& face, const Eigen::Matrix3Xd& nodes);

/// One load case, multiplied by its factors.
struct LoadCase {
  std::string name;
  double dead = 0;                  ///< added to the factor of the dead loads
  double snow_N_mm2 = 0;            ///< per area in plan, downwards
  double wind_N_mm2 = 0;            ///< pressure q
  double wind_rad = 0;              ///< direction to which it blows, from +x towards +y
  Eigen::Vector2d snow_side{0, 0};  ///< towards the half with snow; zero: all of the shell
  double edge_N_mm = 0;             ///< load per length of the edge
  preset::EdgeDirection edge_direction = preset::EdgeDirection::down;
  double pressure_N_mm2 = 0;  ///< on the faces, against their normals
  std::vector<PointLoad> points;
};

/// The case's forces on joints and edge points without its dead loads. They are computed on the
/// shape `nodes` (joints first, then edge points) and constant, except a pressure. The corners of a
/// face carry equal fractions of the load on the face. Snow s: -s A_z z with the area in plan A_z,
/// if it is positive, at the corners on the side with snow. Wind of direction w: q (w . n) A with
/// the area A = |A| n. Edge load: at each side from a to b that belongs to one face only
/// (anticlockwise about n), both ends carry half of its length times the load, along -z, -n or n x
/// (b - a).
///
/// A pressure p stays normal to the shell. Its energy is p times the volume under the faces: the
/// sum of cones from the origin, 1/3 A . c for a face, c being the mean of its corners, without the
/// walls of the cones at the edge, which must be constrained (load_cases_of()). For a pressure on
/// the edge, per length, the energy is p times the area in plan inside the edge, constrained or
/// not.
std::vector<NodeAction> forces_of(const LoadCase& load, const Footprint& footprint,
                                  const Eigen::Matrix3Xd& nodes);

/// Converts rows (i, j, force in N) of `key` to forces on joints, and on free ends of a network,
/// which are named like its joints. Errors (bad_input): a joint that does not exist.
Result<std::vector<PointLoad>> points_of(const preset::Points& rows, const std::string& key,
                                         const Footprint& footprint);

/// The cases of a preset. Errors (bad_input): as points_of(); a pressure on faces with an
/// unconstrained edge, which has no energy.
Result<std::vector<LoadCase>> load_cases_of(const preset::Preset& preset,
                                            const Footprint& footprint);

}  // namespace gridshell
