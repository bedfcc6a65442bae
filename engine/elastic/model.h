// The mechanical model of a gridshell: its nodes, what stores energy between them, and what is
// fixed. It is const once built; a state is separate and changes.
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

/// Edge k joins nodes `from` and `to`; edges of a rod follow one another. A ghost has no EA.
struct ModelEdge {
  int from = 0, to = 0;
  double rest_length = 0;  ///< mm
  double EA = 0;           ///< N
  BlockSlot slot = 0;
  int centre = -1;  ///< node that it is centred on, of which it is one half; -1: none
};

/// Bending at the node between edges e and f: f = e + 1, but where a ring closes.
struct ModelBend {
  int e = 0, f = 0;
  double stiffness =
      0;  ///< 2 EI/l, l the mean natural length of the two edges (mJ); 0: one of PairLists
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

/// Blocks between the nodes of two edges and the columns of their angles; -1: none.
struct PairSlots {
  BlockSlot e = -1, f = -1;                                         ///< between the ends of an edge
  BlockSlot across[2][2] = {{-1, -1}, {-1, -1}};                    ///< an end of e, an end of f
  BlockSlot spin[4][2] = {{-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}};  ///< end (e's, f's), angle
  BlockSlot spins = -1;                                             ///< between the angles
};

/// An energy of two edges of one kind.
template <class Law>
struct Pair {
  int e = 0, f = 0;
  int bend = -1;  ///< of edges that follow one another: whose reference twist it is
  Law law;
  PairSlots slots = {};
};

/// All energies of two edges except plain bending: another energy is another list.
using PairLists = std::tuple<std::vector<Pair<Torsion>>, std::vector<Pair<SectionBending>>,
                             std::vector<Pair<EndBending>>, std::vector<Pair<JointAngle>>,
                             std::vector<Pair<JointSpin>>>;

// A joint with a law has unknowns of its own: its position x_c, and for each rod the vector of the
// edge that is centred on it, by one of the neighbouring nodes, whose edges are its halves. What
// else is there follows from these, and so do energies, forces and the Hessian: those by all nodes
// and angles are taken first, then they are carried over to what is free (chain rule).

/// A column that follows others: where its blocks of the Hessian go. Of every column that it has a
/// block with the slot of that, and those of the leading ones with it (-1: it is the same column).
struct FollowerBlocks {
  struct Column {
    int column = 0;
    BlockSlot own = -1;
    std::array<BlockSlot, 4> leading{-1, -1, -1, -1};
  };
  std::vector<int> leading;  ///< columns
  std::vector<Column> beside;
};

/// The second node of a centred edge, x = 2 x_centre - x_first.
struct ModelFollower {
  int node = 0, centre = 0, first = 0;
  FollowerBlocks blocks = {};
};

/// A rod at a joint that keeps its section near the joint's normal n = side t_e x t_f/|...|, t the
/// tangents of the two rods' centred edges: n is the first reference director of edge e, whose
/// angle then is the spin phi from the normal, E = k/2 phi^2, or is fixed (k infinite).
struct ModelHinge {
  Pair<JointSpin> pair;
  int other_half = -1;   ///< of edge e; -1: the rod ends there
  double stiffness = 0;  ///< k, N mm/rad; 0: fixed
  FollowerBlocks blocks = {};
};

/// A bolt between the axes of two rods that lie `eccentricity` apart at their joint, along the
/// normal n = t_a x t_b/|t_a x t_b| to the tangents of their centred edges there. With d = x_b -
/// x_a, E = k/2 |d - eccentricity n|^2. So a force F across the bolt puts the couple eccentricity
/// n x F on the rods.
struct ModelLink {
  int a = 0, b = 0;            ///< nodes
  int edge_a = 0, edge_b = 0;  ///< half of each centred edge
  double eccentricity = 0;     ///< mm
  double stiffness = 0;        ///< k, N/mm
};

/// A rod: its nodes and their natural arc lengths. A closed rod has one arc length more than nodes.
/// Ends that prescribe a direction (`tangent`, `clamped`) do so at the end point itself, by a ghost
/// edge past it: its bend counts over half an edge, as EndBending says, so the constraint is second
/// order [the symmetric ghost of beam theory].
struct ModelRod {
  std::vector<int> nodes;
  std::vector<double> position;  ///< mm, ascending
  RodMaterial material;
  /// Natural curvature binormal about m1 and m2 of the edge before, at every node, in addition to
  /// the material's curvature; empty: 0.
  std::vector<Eigen::Vector2d> turns{};
  std::vector<char> centred{};  ///< of every node: an edge is centred on it; empty: none is
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  Eigen::Vector3d director{0, 0, 1};     ///< m1 at the start, as near as the tangent allows
  int ghost_begin = -1, ghost_end = -1;  ///< nodes of the ghosts; -1: numbered after the others

  bool closed() const { return position.size() == nodes.size() + 1; }
};

/// The unknowns are in columns of three: one per node (mm), then, of the twist model, the angles of
/// edges, three per column and times `spin_length`, so that every unknown is a length, every force
/// a force and every stiffness N/mm.
struct Model {
  int nodes = 0;           ///< ghosts too
  double spin_length = 1;  ///< mm; the mean edge
  std::vector<ModelEdge> edges;
  std::vector<ModelBend> bends;  ///< in the order of their edges, those that close a ring last
  std::vector<ModelSpring> springs;
  std::vector<ModelBar> bars;    ///< braces
  std::vector<ModelLink> links;  ///< of eccentric joints
  PairLists pairs;
  double mean_stiffness = 0;  ///< K of the mean of joints' angles (JointAngle::weight), N mm/rad
  std::vector<ModelFollower> followers;
  std::vector<ModelHinge> hinges;
  std::vector<NodeAction> loads;   ///< dead; they count times a load factor
  std::vector<NodeAction> ground;  ///< the elastic ground
  ContactPairs contact;            ///< edges that may touch; none: nothing keeps them apart
  std::vector<int> spin;  ///< per edge: the index of its angle, 3 column + row; empty: bend model

  /// A list of edges per rod, for frames and for what turns a fixed end.
  struct Rod {
    std::vector<int> edges;                ///< in order, ghosts too
    int ghost_begin = -1, ghost_end = -1;  ///< their edges
    bool closed = false;
    int first_bend = 0;     ///< of those that follow one another along it
    int closing_bend = -1;  ///< that which closes a ring, or -1
    int held_spin = -1;     ///< edge whose angle is fixed as nothing resists the spin, or -1
    Eigen::Vector3d director;
    double gyration_mm2 = 0;  ///< of the section about the rod's axis, squared: (I1 + I2)/A
    FibreReach fibres;
  };
  std::vector<Rod> rods;
  /// Rods of one wave share no node, and those at a node are in the order of their waves: sums at
  /// a node have one order, whoever goes along which rod.
  std::vector<std::vector<int>> waves;

  /// per column: a bit set for each of its three unknowns that is prescribed or does not exist; all
  /// of one that follows others, and a fourth
  std::vector<unsigned char> held;
  static constexpr unsigned char all_held = 7, follows = 15;

  // worked out by finish()
  BlockPattern pattern;
  std::vector<int> free_index;    ///< per column: index among those not completely fixed, or -1
  std::vector<int> free_columns;  ///< its inverse
  Eigen::Matrix2Xd flat;          ///< (u, v) of every column, for seeds and orderings
  std::vector<int> segment;       ///< per column: the segment of a rod it is inside of, or -1
  std::vector<int> inside;        ///< columns inside segments, in order along the rods

  /// Unknowns of the mixed form: axial forces of edges, then torques of joints with a spring.
  Eigen::Index forces() const {
    return Eigen::Index(edges.size() + std::get<std::vector<Pair<JointAngle>>>(pairs).size());
  }
  int columns() const { return int(held.size()); }
  int free() const { return int(free_columns.size()); }
  int dof() const;
  bool pinned(int column) const { return held[std::size_t(column)] == all_held; }
  void pin(int node) { held[std::size_t(node)] = all_held; }
  void hold(int column, int row) { held[std::size_t(column)] |= (unsigned char)(1 << row); }
  bool has_spins() const { return !spin.empty(); }
  /// Puts nodes that follow others where these say: positions, or moves of them.
  void follow(Eigen::Matrix3Xd& x) const;
  /// Forces on nodes that follow others become forces on these.
  void fold(Eigen::Matrix3Xd& force) const;
  /// Fixes the angle of an edge.
  void hold_spin(int edge) { hold(spin[std::size_t(edge)] / 3, spin[std::size_t(edge)] % 3); }
  /// The angle of an edge in a state, rad.
  double angle(const Eigen::Matrix3Xd& x, int edge) const {
    return x.data()[spin[std::size_t(edge)]] / spin_length;
  }
};

/// The length of an edge that bends at its two nodes, mm: none of a ghost, of a half that of the
/// whole centred edge.
double bending_length(const Model& model, int edge);
/// What bends between two edges, mm: the mean of their lengths.
double length_between(const Model& model, int e, int f);

/// Puts rods together; nodes that rods share are shared joints. `crossings` marks more nodes at
/// which rods are connected (spring joints). In the twist model the spin of a rod that
/// nothing resists (round and straight, no end clamped) costs no energy: one of its angles is
/// fixed. In the bend model a section with axes bends as its softer one (an initial guess for the
/// twist model). Errors (bad_input): stiffness that is not positive, a torsional stiffness that is
/// missing on the twist model, arc lengths that do not ascend, a node that does not exist.
Result<Model> build_model(int nodes, const std::vector<ModelRod>& rods, RodModel rod_model,
                          const std::vector<char>& crossings = {});

/// The law of a bend of which `bends` has no stiffness, if it is one of these; else null.
template <class Law, class AnyModel>
auto* law_of(AnyModel& model, int bend) {
  auto& pairs = std::get<std::vector<Pair<Law>>>(model.pairs);  // in the order of the bends
  const auto at = std::ranges::lower_bound(pairs, bend, {}, &Pair<Law>::bend);
  return at != pairs.end() && at->bend == bend ? &at->law : nullptr;
}

/// The edges of a rod that meet at a node, one or two.
std::vector<int> edges_beside(const Model& model, int rod, int node);

/// The tangent of a rod at a node, of one centred there that of its edge, else by the quadratic
/// through the two edges at the node: t ~ t1 l2 + t2 l1.
Eigen::Vector3d tangent_at(const Model& model, const Eigen::Matrix3Xd& x, int rod, int node);

/// Where rods `a` and `b` of a model cross: at a node, or at two nodes that a spring joins.
struct Crossing {
  int rod_a = 0, node_a = 0, rod_b = 0, node_b = 0;
};

/// Adds the resistance to shear `stiffness` (N mm/rad) where rods cross, on the angle between their
/// centred edges: E = k/2 (angle - `rest` - `opening`)^2. finish() afterwards; so for those below.
void add_joint_shear(Model& model, const Crossing& at, const JointAngle& law);

/// Adds the resistance to spin `stiffness` (N mm/rad) of both rods where they cross: their first
/// directors stay near the joint's normal, `side` times that from the direction of `a` to that of
/// `b`; infinite: on it. The joint is of these two rods alone.
void add_joint_hinge(Model& model, const Crossing& at, double stiffness, int side = 1);

/// Adds the resistance to shear as an energy of every two of more rods, whose spins are no joint's
/// own.
void add_joint_spin(Model& model, const Crossing& at, double stiffness, int side = 1);

/// Adds the bolt of two rods that lie apart where they cross, `eccentricity` along t_a x t_b: as
/// stiff as so long a piece of the softer rod.
void add_joint_link(Model& model, const Crossing& at, double eccentricity);

/// The nodes of its two edges.
std::array<int, 4> nodes_of(const ModelLink& link, const Model& model);

/// Works out pattern and numbering after elements were added or unknowns fixed.
void finish(Model& model);

}  // namespace gridshell
