// RodMesh: the rods of a footprint cut into edges; its position in space; interpolation between
// meshes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"

namespace gridshell {

/// Position of the flat (u, v) plane in the frame of the scene: a point (u, v) is at origin + axes
/// (u, v). The axes are orthonormal and horizontal, u x v = z.
struct FlatFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();

  /// Position in space of a point.
  Eigen::Vector3d at(const Eigen::Vector2d& uv) const;
  /// 3 x n positions in space of 2 x n points in the plane.
  Eigen::Matrix3Xd all(const Eigen::Matrix2Xd& uv) const;
};

/// A support on a spring: the node of the support, which is pinned and on no rod, and the rods'
/// node that the spring pulls towards it.
struct MeshSpring {
  int support = 0, node = 0;
  Eigen::Vector3d N_per_mm{0, 0, 0};  ///< stiffness along x, y, z
};

/// A joint whose second rod has a node of its own, above the node of the first rod (node = joint).
struct EccentricJoint {
  int joint = 0, node = 0;
  double eccentricity = 0;  ///< mm
};

/// Nodes and edges of all rods. The nodes are, in this order:
///   - joints: node = index of the joint, common to its rods;
///   - edge points: rod r has node joints + 2r at its start, joints + 2r + 1 at its end;
///   - nodes inside segments, legs and tails, rod by rod;
///   - *ghosts*: an end whose direction is prescribed has one more node past its edge point, at a
///     distance of `ghost_length` on every mesh, which is pinned so that the edge has the
///     direction; it is the first or last node of its rod;
///   - the supports of springs, in their order.
/// A rod with a tail starts or ends at the tail's *far end*, and its edge point is an inner node. A
/// rod whose end is joined starts or ends at that joint; its edge point is on no rod and has the
/// joint's position. A closed rod has its joint twice, first and last.
struct RodMesh {
  int edges_per_segment = 0;
  int joints = 0;
  int edge_points = 0;
  std::vector<RodEnd> ends;   ///< constraint of each edge point; empty: all pinned
  std::vector<int> far_ends;  ///< far end at each edge point, -1: no tail; empty: no tails at all
  std::vector<int> fixed_joints;  ///< joints that the boundary fixes, rigidly or by springs
  std::vector<MeshSpring> springs;
  std::vector<EccentricJoint> eccentric;  ///< by rising second nodes
  std::vector<char> centred;              ///< for each joint: whether edges are centred on it
  int ghosts = 0;
  double ghost_length = 0;                    ///< mm
  std::vector<std::vector<int>> rods;         ///< nodes of each rod from end to end
  std::vector<std::vector<double>> position;  ///< positions of those nodes along their rod, mm
  Eigen::Matrix2Xd flat;                      ///< (u, v) of every node, mm
  Eigen::RowVectorXd height{};                ///< height above the plane, mm; empty: all 0

  int nodes() const { return int(flat.cols()); }
  /// Number of ghosts and supports.
  int nodes_off_rods() const { return ghosts + int(springs.size()); }
  int rod_nodes() const { return nodes() - nodes_off_rods(); }
  /// The joint at a node, for an eccentric joint at both its nodes; -1: there is none.
  int joint_of(int node) const;
  bool is_ghost(int node) const { return node >= rod_nodes(); }
  /// Whether the two edges of a rod at a node are the halves of one edge that is centred on it.
  bool is_centred(int node) const {
    const int joint = joint_of(node);
    return joint >= 0 && std::size_t(joint) < centred.size() && centred[std::size_t(joint)];
  }
  RodEnd end_of(int edge_point) const {
    return ends.empty() ? RodEnd::pinned : ends[std::size_t(edge_point)];
  }
};

/// Cuts each segment, leg and tail into `edges_per_segment` = k edges; a leg or tail shorter than
/// d/4 into k/4 edges (rounded, at least one). Thus the meshes of 4, 8, 16 ... edges nest: halving
/// every edge of one gives the next. Next to a centred joint the nodes are displaced by half an
/// edge. With edges of length h on one side and h' on the other, the nodes are at distances 3h/2,
/// 5h/2 ... from the joint, except that the two nodes next to it are both at h h'/(h + h'): the
/// edge between them has the joint in its middle. In `rods` this edge appears as two halves. Its
/// length halves from mesh to mesh, too.
RodMesh mesh_rods(const Footprint& footprint, int edges_per_segment);

/// Positions of all nodes of the unformed shell, 3 x nodes: (u, v) in the frame's plane, heights
/// along z.
Eigen::Matrix3Xd drawn_nodes(const RodMesh& mesh, const FlatFrame& flat);

/// Interpolates values from one mesh of a footprint to another, rod by rod along the arc length in
/// the flat. The positions of the nodes and edges of `to` in `from` are computed once.
class MeshTransfer {
 public:
  MeshTransfer(const RodMesh& from, const RodMesh& to);

  /// Positions by cubic interpolation through the nodes, with the tangents of a quadratic fit;
  /// exact at nodes that are in both meshes.
  void nodes(const Eigen::Matrix3Xd& from, Eigen::Matrix3Xd& to) const;
  /// One value per edge (rod by rod, in order): that of the edge of `from` that contains the
  /// middle.
  void edges(const Eigen::VectorXd& from, Eigen::VectorXd& to) const;

 private:
  struct Stencil {
    int to;       ///< node of `to`
    int node[4];  ///< before, begin, end, after; a missing neighbour repeats the next one
    double weight[4];
  };
  static Stencil stencil(const std::vector<int>& node, const std::vector<double>& s, int k,
                         double at, int to);

  int nodes_to_ = 0;
  std::vector<Stencil> stencils_;
  std::vector<int> edge_;  ///< for each edge of `to` the edge of `from`
};

}  // namespace gridshell
