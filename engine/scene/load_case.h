// Load cases on the formed shell: how snow, wind and point forces become forces on its nodes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/footprint.h"
#include "engine/preset/preset.h"

namespace gridshell {

// The faces that rods and boundary enclose: what snow lies on and wind presses on.

/// A face of the net: its corners in order, anticlockwise as seen from above the flat. Nodes are
/// those of every mesh: joints, then edge points, begin and end of rod r at 2 r and 2 r + 1.
struct Face {
  std::vector<int> corners;
  bool on_boundary = false;  ///< from its last corner to its first there is no rod but the boundary
};

/// All faces of a planar footprint. Each is traversed with the face on the left: at every node
/// along the next rod to the left of the incoming one. At an edge point the boundary closes the
/// face by a straight line.
std::vector<Face> faces_of(const Footprint& footprint);

/// 1/2 sum of x_k x x_(k+1), mm^2: the area of a face of a shape, along its normal; its z is the
/// area in plan.
Eigen::Vector3d area_of(const Face& face, const Eigen::Matrix3Xd& nodes);

/// One case, its factors taken in.
struct LoadCase {
  std::string name;
  double dead = 0;                  ///< how many times more the dead loads of forming
  double snow_N_mm2 = 0;            ///< of plan, downwards
  double wind_N_mm2 = 0;            ///< pressure q
  double wind_rad = 0;              ///< where it blows to, from +x towards +y
  Eigen::Vector2d snow_side{0, 0};  ///< the half that has snow; zero: all
  double edge_N_mm = 0;
  preset::EdgeDirection edge_direction = preset::EdgeDirection::down;
  double pressure_N_mm2 = 0;  ///< on the faces, against their normals
  std::vector<PointLoad> points;
};

/// The case's forces on joints and edge points without its dead loads, computed on the shape
/// `nodes` (joints first, then edge points) and fixed from then on. Each corner of a face carries
/// the same fraction of the load on the face: of snow s on the face's area in plan A_z, if that is
/// not overhung, -s A_z z, at the corners on the side that has snow; of wind of direction w on its
/// area A = |A| n the force q (w . n) A. For each side a to b that belongs to one face only,
/// anticlockwise about n, both ends carry half of its length times the load on the edge: along -z,
/// -n or n x (b - a).
///
/// A pressure p rotates with the shell. Its energy is p times the volume under the faces, as a sum
/// of cones from the origin, 1/3 A . c of a face, c being the mean of its corners; the walls of the
/// cones are subtracted at the edge, which is constrained (load_cases_of()). For a pressure on the
/// edge, per length, the energy is p times the area in plan inside the edge, constrained or not.
std::vector<NodeAction> forces_of(const LoadCase& load, const Footprint& footprint,
                                  const Eigen::Matrix3Xd& nodes);

/// Rows of `key` as forces on joints and on free ends of a network, which are named as its joints.
/// Errors (bad_input): a joint that is not there.
Result<std::vector<PointLoad>> points_of(const preset::Points& rows, const std::string& key,
                                         const Footprint& footprint);

/// The cases of a preset. Errors (bad_input): as points_of(); a pressure on faces with an
/// unconstrained edge, which has no energy.
Result<std::vector<LoadCase>> load_cases_of(const preset::Preset& preset,
                                            const Footprint& footprint);

}  // namespace gridshell
