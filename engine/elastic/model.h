// The mechanical model of a gridshell: nodes, energies between them, and prescribed unknowns. It is
// const once built; a state is separate and changes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/result.h"
#include "engine/elastic/block_hessian.h"
#include "engine/elastic/contact.h"
#include "engine/elastic/element_energies.h"
#include "engine/elastic/rod_material.h"
#include "engine/footprint/footprint.h"

namespace gridshell {

/// An edge of a rod from node `from` to node `to`. The edges of a rod are consecutive. A ghost edge
/// has EA = 0.
struct ModelEdge {
  int from = 0, to = 0;
  double rest_length = 0;  ///< mm
  double EA = 0;           ///< N
  BlockSlot slot = 0;
  int centre = -1;  ///< if it is half of an edge centred on a joint: that joint's node; else -1
};

/// Bending at the node between edges e and f of a rod. f = e + 1, except where a ring closes.
struct ModelBend {
  int e = 0, f = 0;
  double stiffness =
      0;  ///< 2 EI/l, mJ, l the mean natural length of both edges; 0: its law is in Model::pairs
  BlockSlot slot = 0;
};

/// Two nodes joined by a spring.
struct ModelSpring {
  NodeSpring law;
  BlockSlot slot = 0;
};

/// Two nodes with a bar between them.
struct ModelBar {
  NodeBar law;
  BlockSlot slot = 0;
};

/// Positions in the Hessian of the blocks that an energy of two edges e, f adds to; -1: no block.
struct PairSlots {
  BlockSlot e = -1, f = -1;                       ///< between both ends of e, both ends of f
  BlockSlot across[2][2] = {{-1, -1}, {-1, -1}};  ///< [end of e][end of f]
  /// [end: e.from, e.to, f.from, f.to][angle of e, of f]
  BlockSlot spin[4][2] = {{-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}};
  BlockSlot spins = -1;  ///< between the columns of the two angles
};

/// An energy of the kind `Law` of two edges e and f.
template <class Law>
struct Pair {
  int e = 0, f = 0;
  int bend =
      -1;  ///< bend at the node between e and f, for its reference twist; -1: not consecutive
  Law law;
  PairSlots slots = {};
};

/// All energies of two edges, a list for each kind, except the bending of round straight rods
/// (ModelBend).
using PairLists = std::tuple<std::vector<Pair<Torsion>>, std::vector<Pair<SectionBending>>,
                             std::vector<Pair<EndBending>>, std::vector<Pair<JointAngle>>,
                             std::vector<Pair<JointSpin>>>;

// A joint with a law has unknowns of its own: its position x_c and, for each of its rods, the edge
// that is centred on x_c. Such an edge is given by x_c and its first node; its second node
// *follows* from these. Energies, forces and the Hessian are first computed by all nodes and
// angles, then transferred to the leading ones by the chain rule.

/// Where the Hessian's blocks of a following column are added.
struct FollowerBlocks {
  /// A column with which the following column has a block.
  struct Column {
    int column = 0;
    BlockSlot own = -1;                                ///< that block; -1: the following column
    std::array<BlockSlot, 4> leading{-1, -1, -1, -1};  ///< of the leading columns; -1: same column
  };
  std::vector<int> leading;  ///< columns that the following column follows
  std::vector<Column> neighbours;
};

/// The second node of a centred edge, which follows from the joint and the first node:
/// x = 2 x_centre - x_first.
struct ModelFollower {
  int node = 0, centre = 0, first = 0;
  FollowerBlocks blocks = {};
};

/// A rod whose section is connected to the normal of a joint. The normal is n = side t_e x t_f
/// /|t_e x t_f|, with the tangents of both rods' centred edges. It is the first reference director
/// of edge e, so the angle of e is the spin phi from the normal: E = k/2 phi^2, or phi = 0 (k
/// infinite).
struct ModelHinge {
  Pair<JointSpin> pair;
  int other_half = -1;   ///< other half of edge e; -1: the rod ends there
  double stiffness = 0;  ///< k, N mm/rad; 0: fixed
  FollowerBlocks blocks = {};
};

/// A bolt between two rods whose axes have the distance `eccentricity` at their joint, along the
/// normal n = t_a x t_b/|t_a x t_b| to the tangents of their centred edges. With d = x_b - x_a,
/// E = k/2 |d - eccentricity n|^2. So a force F perpendicular to the bolt exerts the couple
/// eccentricity n x F on the rods.
struct ModelLink {
  int a = 0, b = 0;            ///< nodes
  int edge_a = 0, edge_b = 0;  ///< half of each centred edge
  double eccentricity = 0;     ///< mm
  double stiffness = 0;        ///< k, N/mm
};

/// A rod: its nodes and their natural arc lengths. A closed rod has one arc length more than nodes.
/// Ends that prescribe a direction (`tangent`, `clamped`) do so at the end point itself, by a ghost
/// edge past it. The bend there extends over half an edge (EndBending), so the error of the
/// constraint is of second order [the symmetric ghost of beam theory].
struct ModelRod {
  std::vector<int> nodes;
  std::vector<double> position;  ///< mm, ascending
  RodMaterial material;
  /// Natural curvature binormal about m1 and m2 of the edge before, at every node, in addition to
  /// the material's curvature; empty: 0.
  std::vector<Eigen::Vector2d> turns{};
  std::vector<char> centred{};  ///< per node: whether an edge is centred on it; empty: none is
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  Eigen::Vector3d director{0, 0, 1};     ///< m1 at the start, as near as the tangent allows
  int ghost_begin = -1, ghost_end = -1;  ///< nodes of the ghosts; -1: numbered after the others

  bool closed() const { return position.size() == nodes.size() + 1; }
};

/// The model. Its unknowns are columns of three numbers: first one column per node (position, mm),
/// then, in the twist model, the angles of the edges, three per column. Angles are multiplied by
/// `spin_length`, so that all unknowns are lengths (mm), all forces N and all stiffnesses N/mm.
struct Model {
  int nodes = 0;           ///< number of nodes, including ghosts
  double spin_length = 1;  ///< mean length of an edge, mm
  std::vector<ModelEdge> edges;
  std::vector<ModelBend> bends;  ///< in the order of their edges, those that close a ring last
  std::vector<ModelSpring> springs;
  std::vector<ModelBar> bars;    ///< braces
  std::vector<ModelLink> links;  ///< bolts of eccentric joints
  PairLists pairs;
  double mean_stiffness = 0;  ///< K of the mean of joints' angles (JointAngle::weight), N mm/rad
  std::vector<ModelFollower> followers;
  std::vector<ModelHinge> hinges;
  std::vector<NodeAction> loads;   ///< dead loads, multiplied by a load factor
  std::vector<NodeAction> ground;  ///< the elastic ground
  ContactPairs contact;            ///< edges that may touch; none: contact is not modelled
  std::vector<int> spin;  ///< per edge: the index of its angle, 3 column + row; empty: bend model

  /// The edges and bends of a rod, and its properties.
  struct Rod {
    std::vector<int> edges;                ///< in order, including ghost edges
    int ghost_begin = -1, ghost_end = -1;  ///< ghost edges at its ends, or -1
    bool closed = false;
    int first_bend = 0;        ///< the first of its bends, which are consecutive
    int closing_bend = -1;     ///< the bend that closes a ring, or -1
    int fixed_spin = -1;       ///< edge whose angle is fixed as nothing resists the spin, or -1
    Eigen::Vector3d director;  ///< m1 at the start, as near as the tangent allows
    double gyration_mm2 = 0;   ///< squared radius of gyration about the rod's axis: (I1 + I2)/A
    FibreReach fibres;
  };
  std::vector<Rod> rods;
  /// Rods in groups that share no node. Groups are processed one after another, the rods of a group
  /// in parallel: the sum at a node has the same order for any number of threads.
  std::vector<std::vector<int>> waves;

  /// For each column bits 1, 2, 4 of its unknowns that are prescribed or do not exist (all_fixed:
  /// all three), and bit 8 in addition if it follows other columns (`follows`).
  std::vector<unsigned char> fixed;
  static constexpr unsigned char all_fixed = 7, follows = 15;

  // computed by finish()
  BlockPattern pattern;
  std::vector<int> free_index;    ///< per column: its index among the free ones; -1: all prescribed
  std::vector<int> free_columns;  ///< its inverse
  Eigen::Matrix2Xd flat;          ///< (u, v) of every column, for seeds and orderings
  std::vector<int> segment;       ///< per column: the segment of a rod it is inside of, or -1
  std::vector<int> inside;        ///< columns inside segments, in order along the rods

  /// Unknowns of the mixed form: axial forces of edges, then torques of joints with a spring.
  Eigen::Index forces() const {
    return Eigen::Index(edges.size() + std::get<std::vector<Pair<JointAngle>>>(pairs).size());
  }
  int columns() const { return int(fixed.size()); }
  int free() const { return int(free_columns.size()); }
  int dof() const;
  bool pinned(int column) const { return fixed[std::size_t(column)] == all_fixed; }
  void pin(int node) { fixed[std::size_t(node)] = all_fixed; }
  void fix(int column, int row) { fixed[std::size_t(column)] |= (unsigned char)(1 << row); }
  bool has_spins() const { return !spin.empty(); }
  /// Sets the following nodes of `x`, positions or displacements, from the leading ones.
  void follow(Eigen::Matrix3Xd& x) const;
  /// Transfers the forces on following nodes to the leading ones (chain rule).
  void fold(Eigen::Matrix3Xd& force) const;
  /// Fixes the angle of an edge.
  void fix_spin(int edge) { fix(spin[std::size_t(edge)] / 3, spin[std::size_t(edge)] % 3); }
  /// The angle of an edge in a state, rad.
  double angle(const Eigen::Matrix3Xd& x, int edge) const {
    return x.data()[spin[std::size_t(edge)]] / spin_length;
  }
};

/// The length of an edge for bending, mm: 0 for a ghost edge; for half of a centred edge the length
/// of the complete edge.
double bending_length(const Model& model, int edge);
/// The length over which the node between two edges bends, mm: the mean of their bending_length().
double length_between(const Model& model, int e, int f);

/// Builds the model of `rods` on `nodes` nodes. Rods with a common node share that joint.
/// `crossings` marks further nodes at which rods are connected (spring joints). In the twist model,
/// if nothing resists the spin of a rod (round, straight, no clamped end), one of its angles is
/// fixed. In the bend model a section with two stiffnesses has the smaller one (for an initial
/// guess of the twist model). Errors (bad_input): stiffness that is not positive, a torsional
/// stiffness that is missing on the twist model, arc lengths that do not ascend, a node that does
/// not exist.
Result<Model> build_model(int nodes, const std::vector<ModelRod>& rods, RodModel rod_model,
                          const std::vector<char>& crossings = {});

/// The law of kind `Law` in Model::pairs at a bend; null if the bend has none of that kind.
template <class Law, class AnyModel>
auto* law_of(AnyModel& model, int bend) {
  auto& pairs = std::get<std::vector<Pair<Law>>>(model.pairs);  // in the order of the bends
  const auto at = std::ranges::lower_bound(pairs, bend, {}, &Pair<Law>::bend);
  return at != pairs.end() && at->bend == bend ? &at->law : nullptr;
}

/// The edges of rod `rod` at a node: one at its end, else two.
std::vector<int> edges_at(const Model& model, int rod, int node);

/// The unit tangent of a rod at a node: the direction of the edge that is centred there, else that
/// of the quadratic through the two edges, t ~ t1 l2 + t2 l1 (t1, t2 unit tangents, l1, l2
/// lengths).
Eigen::Vector3d tangent_at(const Model& model, const Eigen::Matrix3Xd& x, int rod, int node);

/// Where rods `a` and `b` of a model cross: at a node, or at two nodes that a spring joins.
struct Crossing {
  int rod_a = 0, node_a = 0, rod_b = 0, node_b = 0;
};

/// Adds the resistance to shear of rods that cross, by the angle between their centred edges. Call
/// finish() after this function and those below.
void add_joint_shear(Model& model, const Crossing& at, const JointAngle& law);

/// Adds the resistance `stiffness` (N mm/rad) of a joint of two rods to their spin, the angle of
/// their first directors from the joint's normal, `side` t_a x t_b/|t_a x t_b|. Infinite: the
/// directors are along the normal.
void add_joint_hinge(Model& model, const Crossing& at, double stiffness, int side = 1);

/// Adds the same resistance to spin between two of more than two rods of a joint, as an energy
/// (JointSpin).
void add_joint_spin(Model& model, const Crossing& at, double stiffness, int side = 1);

/// Adds the bolt between two rods whose axes have the distance `eccentricity` (mm) along t_a x t_b.
/// Its stiffness is EA/|eccentricity| of the rod with the smaller EA.
void add_joint_link(Model& model, const Crossing& at, double eccentricity);

/// The nodes of the two edges of a link.
std::array<int, 4> nodes_of(const ModelLink& link, const Model& model);

/// Computes pattern and numbering after elements were added or unknowns were fixed.
void finish(Model& model);

}  // namespace gridshell
