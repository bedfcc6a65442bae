// Where the flat footprint lies in space.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"

namespace gridshell {

/// The flat (u, v) plane in the frame of the scene: a point (u, v) lies at origin + axes (u, v).
/// The axes are orthonormal and horizontal, u x v = z.
struct FlatFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();

  Eigen::Vector3d at(const Eigen::Vector2d& uv) const;
  Eigen::Matrix3Xd all(const Eigen::Matrix2Xd& uv) const;
};

// The footprint's rods cut into edges: nodes, their flat positions and natural lengths.

/// A support on a spring: the node of the support, which is pinned and of no rod, and the rods'
/// node that it pulls.
struct MeshSpring {
  int support = 0, node = 0;
  Eigen::Vector3d N_per_mm{0, 0, 0};  ///< along x, y, z
};

/// A joint whose second rod has a node of its own there, above the first's.
struct EccentricJoint {
  int joint = 0, node = 0;
  double eccentricity = 0;  ///< mm
};

/// Nodes of all rods. An end whose direction is prescribed has one node more, a *ghost* past its
/// edge point, pinned where the direction asks for it: ghosts come after the nodes of the rods and
/// are the first or last of their rod, `ghost_length` from the edge point on every mesh. The last
/// nodes of the mesh are the supports of springs, in their order. Joints come first (node = index
/// of the joint, shared by its rods), then edge points (rod r has node joints + 2r at its start,
/// joints + 2r + 1 at its end), then the nodes inside segments, legs and tails, rod by rod. A rod
/// with a tail begins or ends at the tail's *far end*, its edge point being one of its inner nodes.
/// A rod whose end is joined begins or ends at that joint; the edge point of that number belongs to
/// no rod and has the joint's position. A closed rod names its joint twice, first and last.
struct RodMesh {
  int edges_per_segment = 0;
  int joints = 0;
  int edge_points = 0;
  std::vector<RodEnd> ends;       ///< of every edge point; empty: all pinned
  std::vector<int> far_ends;      ///< of every edge point, -1: no tail; empty: none has one
  std::vector<int> fixed_joints;  ///< that the boundary fixes, some by springs
  std::vector<MeshSpring> springs;
  std::vector<EccentricJoint> eccentric;  ///< in the order of their second nodes
  std::vector<char> centred;              ///< of every joint: edges are centred on it
  int ghosts = 0;
  double ghost_length = 0;                    ///< mm
  std::vector<std::vector<int>> rods;         ///< nodes of each rod from end to end
  std::vector<std::vector<double>> position;  ///< of those nodes along their rod in the flat, mm
  Eigen::Matrix2Xd flat;                      ///< (u, v) of every node, mm
  Eigen::RowVectorXd height{};                ///< above the plane, mm; empty: all in it

  int nodes() const { return int(flat.cols()); }
  int beside_rods() const { return ghosts + int(springs.size()); }  ///< ghosts and supports
  int rod_nodes() const { return nodes() - beside_rods(); }
  /// The joint at a node, of an eccentric one at either; else -1.
  int joint_of(int node) const;
  bool is_ghost(int node) const { return node >= rod_nodes(); }
  /// Whether the two edges of a rod at a node are the halves of one that is centred there.
  bool is_centred(int node) const {
    const int joint = joint_of(node);
    return joint >= 0 && std::size_t(joint) < centred.size() && centred[std::size_t(joint)];
  }
  RodEnd end_of(int edge_point) const {
    return ends.empty() ? RodEnd::pinned : ends[std::size_t(edge_point)];
  }
};

/// Cuts each segment into `edges_per_segment` = k edges, each leg and tail too; one shorter than
/// d/4 is cut into k/4 edges (rounded, at least one). So the meshes of 4, 8, 16 ... edges nest:
/// halving every edge of one gives the next.
/// Where a joint is centred, stretches of length h, h' a piece on its sides have their nodes half
/// an edge further on: h/2, 3h/2, ... from it, but for the two next to the joint, which lie
/// h h'/(h + h') off it on either side: the edge between them, the joint in its middle, is two
/// halves in the lists here. So lengths halve from mesh to mesh, too.
RodMesh mesh_rods(const Footprint& footprint, int edges_per_segment);

/// The nodes of the unformed shell: (u, v) in the frame's plane, heights along z.
Eigen::Matrix3Xd drawn_nodes(const RodMesh& mesh, const FlatFrame& flat);

/// Carries values between two meshes of one footprint, rod by rod along the flat arc length. The
/// plan (where each node or edge of `to` lies in `from`) is made once.
class MeshTransfer {
 public:
  MeshTransfer(const RodMesh& from, const RodMesh& to);

  /// Positions by cubic interpolation through the nodes, with the tangents of a quadratic fit;
  /// exact at nodes that the meshes share.
  void nodes(const Eigen::Matrix3Xd& from, Eigen::Matrix3Xd& to) const;
  /// One value an edge (edges rod by rod, in order): that of the edge of `from` around its middle.
  void edges(const Eigen::VectorXd& from, Eigen::VectorXd& to) const;

 private:
  struct Stencil {
    int to;       ///< node of the finer mesh
    int node[4];  ///< before, begin, end, after; a neighbour that does not exist repeats
    double weight[4];
  };
  static Stencil stencil(const std::vector<int>& node, const std::vector<double>& s, int k,
                         double at, int to);

  int nodes_to_ = 0;
  std::vector<Stencil> stencils_;
  std::vector<int> edge_;  ///< per edge of `to`: edge of `from`
};

}  // namespace gridshell
