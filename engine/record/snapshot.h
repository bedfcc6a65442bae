// What a run leaves behind for whoever shows, stores or compares it: the net's layout, which does
// not change, and one frame per sampled state. Millimetres, newtons, millijoules, z up.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/record/frame_list.h"

namespace gridshell::record {

/// A crossing of a u-rod and a v-rod at grid position (u, v) of the flat footprint.
struct Joint {
  int i = 0, j = 0;
  double u_mm = 0, v_mm = 0;
  int node = 0;  ///< column of Frame::nodes
};

/// A complete cell: the joints (i,j), (i+1,j), (i+1,j+1), (i,j+1) as indices into Layout::joints.
struct Cell {
  int i = 0, j = 0;
  double u_mm = 0, v_mm = 0;  ///< middle of the cell in the footprint
  std::array<int, 4> joints{};
};

/// A building block on its own net: rods as polylines, where they would lie without the others.
struct Part {
  std::string name;
  std::vector<std::vector<int>> rods;  ///< columns of the points below
  Eigen::Matrix3Xd net, flat;          ///< in space, and in the flat footprint
};

/// A rod across the seam of two building blocks.
struct SeamRod {
  std::string seam;  ///< "left.east - middle.west"
  char family = 'u';
  double line_mm = 0;   ///< v of a u-rod, u of a v-rod
  double gap_mm = 0;    ///< between the two nets at the seam
  double kink_deg = 0;  ///< between its tangents there
};

/// A joint that is pushed or pulled, and which way: a unit vector.
struct LoadedJoint {
  int joint = 0;  ///< of Layout::joints
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  /// In the frames alone whose reactions say so, as a step by hand takes and lets go; else in all.
  bool at_times = false;
};

/// The net, fixed over a run.
struct Layout {
  double spacing_mm = 0;
  double rod_diameter_mm = 0;
  /// Of each rod, that of a round section of its area; empty: all of rod_diameter_mm.
  std::vector<double> diameters_mm;
  double length_scale_mm = 0;  ///< R_o for a circle, rho for a net: what errors are relative to
  std::vector<std::vector<int>> rods;  ///< nodes of each rod from edge point to edge point
  std::vector<std::string> families;   ///< of each rod: "u" or "v"; empty: not known
  std::vector<Joint> joints;
  std::vector<Cell> cells;
  std::vector<int> edge_points;  ///< nodes pinned on the boundary
  /// Nodes that something may hold: joints, edge points, far ends of tails. Empty: not known.
  std::vector<int> supports;
  Eigen::Matrix3Xd original_boundary;      ///< closed polyline (last point joins the first)
  Eigen::Matrix3Xd actuated_boundary;      ///< same number of points; in correspondence
  Eigen::Matrix3Xd net_nodes;              ///< place of every node on the net designed on, if any
  Eigen::Matrix3Xd flat_nodes;             ///< and in the flat footprint, where there is a net
  std::vector<Part> parts;                 ///< of a net made of building blocks
  std::vector<SeamRod> seam_rods;          ///< and how they meet
  std::vector<LoadedJoint> loaded_joints;  ///< where the shell is pushed or pulled
  /// Whether nodes, energies and K of frames are extrapolated over the last two meshes. Residuals
  /// and pivots are those of the finest mesh always. Written, not read back.
  bool extrapolated = false;
};

/// Where a run comes from; empty words are not known.
struct Origin {
  std::string title, preset;
  std::string program;  ///< "gridshell 0.2.0"
};

/// All frames of a run over one layout.
struct Trajectory {
  Layout layout;
  FrameList frames;
  Origin origin = {};
};

/// Diameter of a rod, mm.
inline double diameter_of(const Layout& layout, std::size_t rod) {
  return rod < layout.diameters_mm.size() ? layout.diameters_mm[rod] : layout.rod_diameter_mm;
}
/// The same over that of the layout; 1 where neither is known.
inline double thickness_of(const Layout& layout, std::size_t rod) {
  const double over = diameter_of(layout, rod) / layout.rod_diameter_mm;
  return over > 0 && over < 1e3 ? over : 1;
}

/// How many numbers the forces, curvatures and energies of a frame are: edges and points of all
/// rods.
inline Eigen::Index edges_of_rods(const Layout& layout) {
  Eigen::Index edges = 0;
  for (const auto& rod : layout.rods) edges += std::max<Eigen::Index>(0, long(rod.size()) - 1);
  return edges;
}
inline Eigen::Index points_of_rods(const Layout& layout) {
  Eigen::Index points = 0;
  for (const auto& rod : layout.rods) points += Eigen::Index(rod.size());
  return points;
}

}  // namespace gridshell::record
