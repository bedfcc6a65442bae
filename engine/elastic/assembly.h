// Energies, forces and stiffness of a model in a state, assembled.
#pragma once

#include <Eigen/Core>

#include "engine/core/energies.h"
#include "engine/elastic/block_hessian.h"
#include "engine/elastic/state.h"

namespace gridshell {

/// What the edges and bends of a rod add up to.
struct RodSum {
  double stretch = 0, bend = 0;  ///< energies, mJ
  double smallest_cosine = 1, largest_strain = 0;
};

/// Working memory and results of one assembly; reused from call to call.
struct Assembly {
  Energies energies;          ///< by term, mJ
  Eigen::Matrix3Xd gradient;  ///< dE/dx in every column, in fixed ones too (their reaction), N
  /// unit tangent of every edge; then by the vectors of its two edges how the angle grows of every
  /// joint with a spring, 1/mm
  Eigen::Matrix3Xd tangents;
  Eigen::VectorXd force;  ///< axial force EA (|e|/l - 1) of every edge, N; then torques of joints
  BlockHessian hessian;
  double smallest_cosine = 1;  ///< of the turns between edges: below 0 they turn over 90 degrees
  double largest_strain = 0;   ///< of the edges, by size, with its sign
  bool overlap = false;        ///< rods that a barrier keeps apart are nearer than their radii
  std::vector<RodSum> of_rod;  ///< of a small model one of all
};

/// Loads on a model in addition to its ground: the factor of its dead loads, a constant load per
/// node, one that changes along the path; and the fraction of the joint actuation that is applied.
struct ExternalLoads {
  double load = 1;
  const std::vector<NodeAction>* steady = nullptr;
  const std::vector<NodeAction>* field = nullptr;
  double field_factor = 0;
  double opening = 0;  ///< applied fraction of JointAngle::opening
};

/// How the Hessian's stretch is taken.
struct Stiffness {
  /// The state's axial forces replace EA (|e|/l - 1) in the geometric stiffness
  /// N/|e| (I - t t^T), its torques replace k (angle - `rest`): the mixed form, whose forces are
  /// unknowns of their own, eliminated on the edge.
  bool mixed = false;
  double EA_scale = 1;  ///< multiplies EA (continuation in stiffness)
  /// At 0 forces act alone: of bars and of joints' springs too, the part of their own stiffness in
  /// their direction, EA/l t t^T and k (d angle)(d angle)^T, is left out.
  bool with_own() const { return EA_scale != 0; }
};

/// Energies by term at a state.
Energies energies_of(const Model& model, const State& state, const ExternalLoads& outside = {});

/// Bending energy of every bend, also of one with axes or natural curvature, mJ.
Eigen::VectorXd bending_of(const Model& model, const State& state);

/// Largest strain that bending puts on a fibre at every bend: the difference from the natural
/// curvature times the fibres' reach.
Eigen::VectorXd bending_strain_of(const Model& model, const State& state);

/// Energies, gradient and axial forces at a state. A team shares the rods of a large model; here
/// and below the results do not depend on it.
void assemble_gradient(const Model& model, const State& state, const ExternalLoads& outside,
                       Assembly& out, Team* team = nullptr);

/// What springs and bolts of joints store, and the spins of hinged rods.
void add_joint_energies(const Model& model, const State& state, double opening, Energies& sum);
/// Adds what springs and bolts of joints store to an assembly (`stiffness`: with its Hessian, then
/// `before` is null; `before`: the mixed residual's tangents), and carries all over to the joints'
/// own unknowns.
void add_joint_angles(const Model& model, const State& state, double opening,
                      const Stiffness* stiffness, const Eigen::Matrix3Xd* before, Assembly& out);
void add_links(const Model& model, const State& state, bool with_hessian, Assembly& out);
void reduce_to_free(const Model& model, const State& state, bool with_hessian, Assembly& out);

/// Excess of the angle of every joint with a spring over its natural one, rad.
Eigen::VectorXd spring_excess(const Model& model, const State& state, double opening);
/// Torques, N mm, that such angles give: k angle + K weight (sum of the weights times the angles).
Eigen::VectorXd spring_torques(const Model& model, Eigen::VectorXd angles);

/// How the gradient changes with the opening of the joints, N, by an assembly's tangents.
Eigen::Matrix3Xd opening_rate(const Model& model, const Eigen::Matrix3Xd& tangents);

/// The residual of the mixed form at a state with axial forces N, its condition N = EA strain
/// eliminated with the edges' directions t0 of an earlier linearisation: the gradient with N t +
/// (EA strain - N) t0 instead of EA strain t, and torques likewise. Where N = EA strain it is
/// the gradient.
void assemble_mixed_residual(const Model& model, const State& state, const ExternalLoads& outside,
                             const Eigen::Matrix3Xd& tangents, Assembly& out, Team* team = nullptr);

/// Energies, gradient and Hessian.
void assemble_hessian(const Model& model, const State& state, const ExternalLoads& outside,
                      const Stiffness& stiffness, Assembly& out, Team* team = nullptr);

/// y = H x over all columns.
void multiply(const Model& model, const BlockHessian& hessian, const Eigen::Matrix3Xd& x,
              Eigen::Matrix3Xd& y);

/// Sets to zero what is fixed.
void clear_held(const Model& model, Eigen::Matrix3Xd& x);

/// Largest force on a free column, N.
double residual_of(const Model& model, const Eigen::Matrix3Xd& gradient);

}  // namespace gridshell
