// Linearisation and newton(): a model's equilibrium equations at a state, assembled and factorised.
// Every solver uses them, with every rod model.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/outcome.h"
#include "engine/core/watch.h"
#include "engine/elastic/assembly.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {

/// A free node with prescribed components, a constrained or pushed joint. With one direction it is
/// constrained along it and free perpendicular to it; with three directions it is fixed.
struct Constraint {
  int node = 0;
  Eigen::Matrix3Xd directions = Eigen::Matrix3d::Identity();  ///< orthonormal columns, 1 to 3

  /// The prescribed part of a vector at the node.
  Eigen::Vector3d part(const Eigen::Vector3d& v) const;
};

/// Counts of the costly operations, for reports.
struct Effort {
  int newton_iterations = 0;
  int factorizations = 0;
  Effort& operator+=(const Effort& other) {
    newton_iterations += other.newton_iterations;
    factorizations += other.factorizations;
    return *this;
  }
  friend Effort operator+(Effort a, const Effort& b) { return a += b; }
  friend Effort operator-(Effort a, const Effort& b) {
    return {a.newton_iterations - b.newton_iterations, a.factorizations - b.factorizations};
  }
};

/// Linearises a model's equilibrium equations at a state and solves linear systems with the result.
/// The mixed form, with axial force N, unit tangent t and edge difference
/// B dx = t . (dx_to - dx_from)/l, is
///   (K_0 + EA/l t t^T + N/|e| (I - t t^T)) dx = -dE/dx,   N <- EA (strain + B dx),
/// K_0 being the stiffness of everything else; at an equilibrium its matrix is the Hessian of the
/// energy. The object owns the factorisation and the working memory of one model.
/// With constraints B (3 x m over their nodes) every solve is that of the bordered system
///   K dx - B c = r,   B^T dx = 0,
/// by block elimination with K + g B B^T instead of K: the solution is the same, and the matrix is
/// positive definite wherever the constrained system is, also where K is singular (a limit point in
/// force).
class Linearisation {
 public:
  explicit Linearisation(const Model& model, std::unique_ptr<LinearSolver> solver = nullptr);

  /// Assembles and factorises at `state`; with mixed = false the Hessian of the energy itself,
  /// whose inertia certifies stability.
  Inertia at(const State& state, bool mixed = true, double shift = 0, double EA_scale = 1);
  /// Factorises the assembled Hessian again with another shift.
  Inertia shifted(double shift);

  /// Regularises directions without stiffness, such as the rotation of a rod about the line between
  /// its two hinges, so that they do not count as unstable: all later matrices have 5e-5 of the
  /// least stiff rod's stiffness added to the diagonal. After a single correction the stiffness
  /// along such a direction may be that far below zero.
  void bear_neutral_directions();
  /// What bear_neutral_directions() added to the diagonal, N/mm; else 0.
  double neutral_shift() const { return neutral_shift_; }

  /// Sets the constraints from the next at() on. Corrections do not change constrained components;
  /// the inertia is that of the constrained system.
  void constrain(std::vector<Constraint> constraints) { constraints_ = std::move(constraints); }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  /// Reaction at a constrained node, all components, N; of the last assembly.
  Eigen::Vector3d reaction(const Constraint& constraint) const {
    return assembly_.gradient.col(constraint.node);
  }
  /// Derivative of the forces on the constrained components by their displacements, m x m in the
  /// order of the constraints and their directions, N/mm; of the last factorisation.
  Eigen::MatrixXd constraint_stiffness() const;

  /// Sets whether factorisations stop at the first negative pivot, which is enough for callers that
  /// need positive definite matrices.
  void stop_at_negative(bool stop) {
    solver_->most_negative = stop ? 0 : std::numeric_limits<int>::max();
  }

  /// Sets the threads for large matrices; null: one thread.
  void work_with(Team* team) { solver_->team = team; }
  /// Sets the memory of the factor's numbers, which several systems may use in turn: if another one
  /// has overwritten the factor, solve() factorises again.
  void share(std::shared_ptr<FactorNumbers> numbers) { solver_->numbers = std::move(numbers); }

  /// Frees the memory of the matrices. The next call must be at(): without it nothing can be
  /// solved.
  void free_memory();

  /// Size and stiffness of the shell, over those of the paper's (wire of 0.254 mm, 20 mm apart):
  /// factors of the tolerances and shifts of descents, so that equal shells of any size take equal
  /// steps.
  struct ShellScale {
    double length = 1;     ///< of the spacing
    double stiffness = 1;  ///< of EA over the spacing
  };
  ShellScale scale;

  /// External loads; changes count from the next assembly on.
  ExternalLoads outside;

  /// The energy's gradient at a state, without a factorisation.
  void gradient_at(const State& state);
  /// The mixed residual at another state, with the factorisation and directions of the last at().
  void residual_at(const State& state);
  /// The potential at a state, mJ.
  double energy_at(const State& state) const { return energies_of(model_, state, outside).total(); }

  /// Newton's correction: solves K dx = -dE/dx with the constraints.
  void correction(Eigen::Matrix3Xd& dx) const;
  /// Tangent of the path: derivative of all columns if the pinned ones move with `prescribed` (of
  /// free columns only the constrained components are used) and the factors of the loads change by
  /// `outside_velocity`.
  void tangent(const Eigen::Matrix3Xd& prescribed, const ExternalLoads& outside_velocity,
               const State& state, Eigen::Matrix3Xd& velocity) const;
  /// Solves K y = right_hand_side at the free columns, in place; constrained components of y are
  /// zero.
  void solve(Eigen::Matrix3Xd& right_hand_side) const;
  /// First-order change of the axial forces, EA B dx, and of the torques of joint springs, if the
  /// positions change by dx and the joint actuation by `opening`, at the linearisation point.
  Eigen::VectorXd force_change(const Eigen::Matrix3Xd& dx, double opening = 0) const;
  /// Corrects a state after a long step so that its axial forces and torques become `force` to
  /// first order: a straight step perpendicular to a bent rod stretches it to second order.
  void restore_lengths(const Eigen::VectorXd& force, State& state) const;
  /// Moves the state by a fraction of dx and updates its forces as the mixed form does: they change
  /// by the same fraction of their change in the full step.
  void apply(const Eigen::Matrix3Xd& dx, State& state, double fraction = 1) const;
  /// Fraction of dx at which no edges pass through one another (contact.h); 1 without contact.
  double clear_fraction(const State& state, const Eigen::Matrix3Xd& dx) const {
    return gridshell::clear_fraction(model_, state.x, dx);
  }

  /// Whether the axial force of every edge agrees with its strain within `fraction` of the largest
  /// axial force. A Newton step leaves a difference of second order, and a residual of that size.
  bool forces_agree(const State& state, double fraction) const;

  const Model& model() const { return model_; }
  const Assembly& assembly() const { return assembly_; }  ///< result of the last assembly
  double residual() const;  ///< largest force on an unconstrained component of a free column, N
  const Effort& effort() const { return effort_; }
  Effort& effort() { return effort_; }

 private:
  void border(Inertia& inertia);
  Eigen::VectorXd constrained_part(const Eigen::Matrix3Xd& x) const;

  const Model& model_;
  std::unique_ptr<LinearSolver> solver_;
  Assembly assembly_;
  std::vector<Constraint> constraints_;
  std::vector<Eigen::Matrix3Xd> border_;  // (K + g B B^T)^-1 B, one matrix per column of B
  Eigen::MatrixXd compliance_;            // B^T (K + g B B^T)^-1 B
  Eigen::Matrix3Xd tangents_;             // unit tangent of each edge at the linearisation point
  double EA_scale_ = 1;
  double neutral_shift_ = 0;  // N/mm
  double shift_ = 0;          // shift of the last factorisation
  mutable Effort effort_;     // solves may factorise again
};

/// Largest norm of a column, such as the largest move of a node; NaN if an entry is NaN.
double max_column_norm(const Eigen::Matrix3Xd& dx);
/// Scalar product: the sum of the products of corresponding entries.
double product(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b);

// How far a stable state is from losing its stability.

/// Smallest lambda, N/mm^2, of H v = lambda L v at a stable state: H is the Hessian of the energy
/// with the constraints, L the length of rod, mm, that belongs to each node (`length`, one per
/// node: half of each edge at the node). It is the stiffness of the lowest mode against a force per
/// length of rod and does not depend on the mesh. By inverse iteration; NaN if the Hessian is not
/// positive definite. Twist angles have no length: they adjust to the positions. `converged`:
/// relative change at which the iteration ends.
double lowest_eigenvalue(Linearisation& system, const State& state, const Eigen::VectorXd& length,
                         const Watch& watch, double converged = 1e-7);
/// As above, with the last factorisation, which must be positive definite. The iteration starts
/// from the sum of `mode` and a generic direction (empty `mode`: from the latter alone); `mode`
/// then is the lowest mode.
double lowest_eigenvalue(Linearisation& system, const Eigen::VectorXd& length,
                         Eigen::Matrix3Xd& mode, const Watch& watch, double converged);

// Newton's method on the mixed form: positions and the axial force of every edge are unknowns; the
// forces are eliminated edge by edge, so the system solved has the size and pattern of the Hessian.

struct NewtonOptions {
  double tolerance_mm = 1e-5;  ///< converged when a correction moves no node further
  int most_iterations = 25;
  double near_mm = 0.2;  ///< corrections below this may use an old factorisation
  /// Accept a correction m of a new factorisation without a further one if the predicted next
  /// correction, 8 m^2/l, is at most this, mm; l is the mean natural length of an edge. Near a snap
  /// the prediction may be a hundred times too small.
  double trusted_mm = 0;
  /// Further condition of that: axial forces and strains agree within this fraction of the largest
  /// force; empty: no condition.
  std::optional<double> trusted_misfit = {};
  double farthest_mm = 1e300;  ///< a correction that moves a node further is refused: lost
  double widest_turn = -0.5;   ///< adjacent edges with a smaller cosine of their angle have folded
};

struct NewtonReport {
  Outcome outcome =
      Outcome::not_converged;  ///< reached, folded, lost, not_finite, not_converged, cancelled
  int iterations = 0;          ///< corrections, with a new factorisation or an old one
  double first_move_mm = 0;    ///< largest move in the first correction: the error of the guess
  double last_move_mm = 0;
  double factored_move_mm =
      0;            ///< sum since the last factorisation, including the first correction with it
  Inertia inertia;  ///< of the last factorisation (mixed form)
};

/// Full mixed Newton steps from `state` with the constraints; a factorisation is reused as long as
/// its corrections decrease tenfold. On success `state` is the equilibrium, else the last iterate,
/// and the report says why. A cancel is noticed between corrections.
NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options,
                    const Watch& watch = unwatched);

}  // namespace gridshell
