// The mechanical model of a gridshell on the `bend` rung: stretch and bend of rods that share a
// node at each joint, and spin freely at their ends. Three degrees of freedom a node. Exact for
// isotropic, naturally straight rods whose joints pass no twist: their twist energy is zero at
// rest.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/mesh.h"
#include "engine/gridshell/shell_rods.h"
#include "engine/rod/energies.h"

namespace gridshell {

/// Edge k of the model joins nodes `from` and `to`; edges of a rod follow one another.
struct ModelEdge {
  int from = 0, to = 0;
  double rest_length = 0;  ///< mm
  double EA = 0;           ///< N
};

/// Bending at the node between edges `edge` and `edge + 1`.
struct ModelBend {
  int edge = 0;
  double stiffness = 0;  ///< 2 EI / l, l the mean rest length of the two edges (mJ)
};

/// Const once built; a state (positions) changes beside it.
struct Model {
  int nodes = 0;
  std::vector<ModelEdge> edges;
  std::vector<ModelBend> bends;
  std::vector<char> pinned;     ///< per node: position prescribed
  std::vector<int> free_index;  ///< per node: index among the free ones, or -1
  std::vector<int> free_nodes;  ///< its inverse
  Eigen::Matrix2Xd flat;        ///< (u, v) of every node, for seeds and orderings
  Eigen::Matrix3Xd load;        ///< dead force on every node, N; empty: none

  int free() const { return int(free_nodes.size()); }
  int dof() const { return 3 * free(); }
};

/// Rods of `mesh` with their sections and loads; edge points are pinned but for free ends, ghosts
/// too. A held direction costs EI/l |kb|^2, l the length of the edge at the end: half an edge bends
/// there [the symmetric ghost of beam theory, second order]. The edge to a ghost has no EA.
Model build_model(const RodMesh& mesh, const ShellRods& rods);

/// The symmetric Hessian of a net of chains in 3x3 blocks: `diagonal` per node, `next` per edge
/// (row: its `from`, column: its `to`), `second` per bend (row: first node, column: third node).
/// Rows and columns of pinned nodes are there too. N/mm.
struct ChainHessian {
  std::vector<Eigen::Matrix3d> diagonal, next, second;
};

/// Working memory and results of one assembly; reused from call to call.
struct Assembly {
  Energies energies;
  Eigen::Matrix3Xd gradient;  ///< dE/dx at every node, pinned ones too (their reaction), N
  Eigen::Matrix3Xd tangents;  ///< unit tangent of every edge
  Eigen::VectorXd force;      ///< axial force EA (|e|/l - 1) of every edge, N
  ChainHessian hessian;
  double largest_turn =
      0;  ///< smallest t_e . t_f over all bends: below 0 edges turn over 90 degrees
  double largest_strain = 0;  ///< over all edges, absolute
};

/// Energies of the rods alone, without the loads.
Energies energies_of(const Model& model, const Eigen::Matrix3Xd& x);

/// Energies, gradient and axial forces at x.
void assemble_gradient(const Model& model, const Eigen::Matrix3Xd& x, Assembly& out);

/// The residual of the mixed form at x with axial forces N, its condition N = EA strain eliminated
/// with the edges' directions t0 of an earlier linearisation: dE_bend/dx + sum over edges of N t +
/// (EA strain - N) t0. Where N = EA strain it is the gradient.
void assemble_mixed_residual(const Model& model, const Eigen::Matrix3Xd& x,
                             const Eigen::VectorXd& axial_force, const Eigen::Matrix3Xd& tangents,
                             Assembly& out);

/// All of the above and the Hessian. `axial_force` (one an edge), where given, takes the place of
/// EA (|e|/l - 1) in the geometric stiffness N/|e| (I - t t^T) only: the mixed form, whose axial
/// forces are unknowns of their own, eliminated on the edge. Null: the Hessian of the energy.
/// `EA_scale` multiplies EA (continuation in stiffness).
void assemble_hessian(const Model& model, const Eigen::Matrix3Xd& x,
                      const Eigen::VectorXd* axial_force, double EA_scale, Assembly& out);

/// Adds `factor` times the dead loads to the energies and the gradient of an assembly at x; the
/// assemblies above are those of the unloaded rods.
void add_loads(const Model& model, const Eigen::Matrix3Xd& x, double factor, Assembly& out);

/// Minus the work of `factor` times the dead loads, mJ.
double load_energy(const Model& model, const Eigen::Matrix3Xd& x, double factor);

/// y = H x over all nodes (3 x nodes).
void multiply(const Model& model, const ChainHessian& hessian, const Eigen::Matrix3Xd& x,
              Eigen::Matrix3Xd& y);

/// Largest residual force on a free node, N.
double residual_of(const Model& model, const Eigen::Matrix3Xd& gradient);

}  // namespace gridshell
