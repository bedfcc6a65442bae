// Assembly of the energies, forces and stiffness of a model in a state.
#pragma once

#include <Eigen/Core>

#include "engine/core/energies.h"
#include "engine/elastic/block_hessian.h"
#include "engine/elastic/state.h"

namespace gridshell {

/// Sums and extreme values over the edges and bends of a rod.
struct RodSum {
  double stretch = 0, bend = 0;  ///< energies, mJ
  double smallest_cosine = 1, largest_strain = 0;
};

/// Working memory and results of one assembly; reused from call to call.
struct Assembly {
  Energies energies;          ///< by term, mJ
  Eigen::Matrix3Xd gradient;  ///< dE/dx in every column, in fixed ones too (their reaction), N
  /// unit tangent of every edge; then, for every joint with a spring, the derivatives of its angle
  /// by the vectors of its two edges, 1/mm
  Eigen::Matrix3Xd tangents;
  Eigen::VectorXd force;  ///< axial force EA (|e|/l - 1) of every edge, N; then torques of joints
  BlockHessian hessian;
  double smallest_cosine = 1;  ///< of the angle between adjacent edges; below 0: over 90 degrees
  double largest_strain = 0;   ///< axial strain of largest magnitude, with its sign
  bool overlap = false;        ///< rods with a contact barrier are nearer than their radii
  std::vector<RodSum> of_rod;  ///< one per rod; for a small model one for all rods
};

/// Loads on a model in addition to its ground, and its joint actuation.
struct ExternalLoads {
  double load = 1;                                  ///< factor of the model's dead loads
  const std::vector<NodeAction>* steady = nullptr;  ///< applied load, constant
  const std::vector<NodeAction>* field = nullptr;   ///< its increment along the path
  double field_factor = 0;                          ///< factor of the increment
  double opening = 0;                               ///< applied fraction of JointAngle::opening
};

/// How the stretch of edges enters the Hessian.
struct Stiffness {
  /// The state's axial forces replace EA (|e|/l - 1) in the geometric stiffness
  /// N/|e| (I - t t^T), its torques replace k (angle - `rest`): the mixed form, whose forces are
  /// unknowns of their own, eliminated on the edge.
  bool mixed = false;
  double EA_scale = 1;  ///< multiplies EA (continuation in stiffness)
  /// At EA_scale = 0 only forces contribute, also for bars and springs of joints: the terms of
  /// their own stiffness, EA/l t t^T and k (d angle)(d angle)^T, are left out.
  bool with_own() const { return EA_scale != 0; }
};

/// Energies by term at a state.
Energies energies_of(const Model& model, const State& state, const ExternalLoads& outside = {});

/// Bending energy of every bend, also of one with axes or natural curvature, mJ.
Eigen::VectorXd bending_of(const Model& model, const State& state);

/// Largest strain that bending puts on a fibre at every bend: the difference from the natural
/// curvature times the fibres' reach.
Eigen::VectorXd bending_strain_of(const Model& model, const State& state);

/// Energies, gradient and axial forces at a state. With a team, the rods of a large model are
/// assembled by several threads; the results do not depend on it, nor do those of the functions
/// below.
void assemble_gradient(const Model& model, const State& state, const ExternalLoads& outside,
                       Assembly& out, Team* team = nullptr);

/// Adds the energies of springs and bolts of joints, and of the spins of hinged rods.
void add_joint_energies(const Model& model, const State& state, double opening, Energies& sum);
/// Adds the springs of joints to an assembly: energies, gradient, torques and, with `stiffness`,
/// the Hessian. `before`: tangents of an earlier linearisation, for the mixed residual; else null.
void add_joint_angles(const Model& model, const State& state, double opening,
                      const Stiffness* stiffness, const Eigen::Matrix3Xd* before, Assembly& out);
/// Adds the bolts of eccentric joints to an assembly.
void add_links(const Model& model, const State& state, bool with_hessian, Assembly& out);
/// Transfers gradient and Hessian from angles and nodes that follow others to the leading unknowns,
/// and adds the energies of hinges.
void reduce_to_free(const Model& model, const State& state, bool with_hessian, Assembly& out);

/// Excess of the angle of every joint with a spring over its natural one, rad.
Eigen::VectorXd spring_excess(const Model& model, const State& state, double opening);
/// Torques, N mm, for such angles: k angle + K weight (sum of the weights times the angles).
Eigen::VectorXd spring_torques(const Model& model, Eigen::VectorXd angles);

/// Derivative of the gradient by ExternalLoads::opening, N. `tangents`: those of an assembly.
Eigen::Matrix3Xd opening_rate(const Model& model, const Eigen::Matrix3Xd& tangents);

/// The residual of the mixed form at a state with axial forces N, its condition N = EA strain
/// eliminated with the edges' directions t0 of an earlier linearisation: the gradient with N t +
/// (EA strain - N) t0 instead of EA strain t, and torques likewise. Where N = EA strain it is
/// the gradient.
void assemble_mixed_residual(const Model& model, const State& state, const ExternalLoads& outside,
                             const Eigen::Matrix3Xd& tangents, Assembly& out, Team* team = nullptr);

/// Energies, gradient, axial forces and Hessian at a state.
void assemble_hessian(const Model& model, const State& state, const ExternalLoads& outside,
                      const Stiffness& stiffness, Assembly& out, Team* team = nullptr);

/// y = H x over all columns.
void multiply(const Model& model, const BlockHessian& hessian, const Eigen::Matrix3Xd& x,
              Eigen::Matrix3Xd& y);

/// Sets the prescribed and following components of `x` to zero.
void clear_fixed(const Model& model, Eigen::Matrix3Xd& x);

/// Largest norm of the free components of a column of the gradient, N; NaN if one is NaN.
double residual_of(const Model& model, const Eigen::Matrix3Xd& gradient);

}  // namespace gridshell
