// Newton's method on the mixed form: positions and the axial force of every edge are unknowns; the
// forces are eliminated edge by edge, so the system solved has the size and pattern of the Hessian.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/core/watch.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {

/// What changes: positions (3 x nodes, mm) and axial forces (one an edge, N).
struct State {
  Eigen::Matrix3Xd x;
  Eigen::VectorXd force;
};

/// A free node of which some components are prescribed: a joint that is pushed. With one direction
/// it is held along that direction only and finds its own way across; with three it is held.
struct Prescription {
  int node = -1;                     ///< -1: none
  Eigen::Matrix3Xd directions = {};  ///< orthonormal columns, one to three

  bool active() const { return node >= 0; }
  /// The prescribed part of a vector at the node.
  Eigen::Vector3d part(const Eigen::Vector3d& v) const {
    return directions * (directions.transpose() * v);
  }
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
};

/// One linearisation at a time of a model's equilibrium equations, and solves with it. With axial
/// force N, unit tangent t and edge difference B dx = t . (dx_to - dx_from)/l,
///   (K_bend + EA/l t t^T + N/|e| (I - t t^T)) dx = -dE/dx,   N <- EA (strain + B dx);
/// at an equilibrium both forms agree. Owns the factorisation and the working memory of one model.
/// With a prescription B (3 x m at one node) every solve is that of the bordered system
///   K dx - B c = r,   B^T dx = 0,
/// by block elimination with K + g B B^T in the place of K: the same solution, but positive
/// definite wherever the constrained system is, also where K is singular (a limit point in force).
class Linearisation {
 public:
  explicit Linearisation(const Model& model, std::unique_ptr<LinearSolver> solver = nullptr);

  /// Assembles and factorises at `state`; with mixed = false the Hessian of the energy itself,
  /// whose inertia certifies stability.
  Inertia at(const State& state, bool mixed = true, double shift = 0, double EA_scale = 1);
  /// Factorises the assembled Hessian again with another shift.
  Inertia shifted(double shift);

  /// From the next at() on these components are prescribed: corrections leave them as they are, the
  /// inertia is that of the constrained system.
  void prescribe(const Prescription& prescription) { prescription_ = prescription; }
  const Prescription& prescription() const { return prescription_; }
  /// The force that holds the prescribed node where it is, all components, N; of the last assembly.
  Eigen::Vector3d reaction() const { return assembly_.gradient.col(prescription_.node); }
  /// How the force grows with the prescribed components, m x m, N/mm; of the last factorisation.
  Eigen::MatrixXd prescribed_stiffness() const;

  /// How much of the model's dead loads acts from the next assembly on, as a factor.
  void set_load(double factor) { load_factor_ = factor; }
  double load_factor() const { return load_factor_; }

  /// The energy's gradient at a state, without a factorisation.
  void gradient_at(const State& state);
  /// The mixed residual at another state, with the factorisation and directions of the last at().
  void residual_at(const State& state);

  /// Newton's correction: solves K dx = -dE/dx with the pinned nodes held.
  void correction(Eigen::Matrix3Xd& dx) const;
  /// Tangent of the path: how free nodes follow when pinned nodes move with `pinned_velocity` (of
  /// free nodes only what is prescribed counts) and the load factor grows by `load_velocity`; comes
  /// back as the velocity of all nodes.
  void tangent(const Eigen::Matrix3Xd& pinned_velocity, Eigen::Matrix3Xd& velocity,
               double load_velocity = 0) const;
  /// Solves K y = right_hand_side at the free nodes, in place; prescribed components of y are zero.
  void solve(Eigen::Matrix3Xd& right_hand_side) const;
  /// Change of the axial forces with positions, EA B dx, at the linearisation point.
  Eigen::VectorXd force_change(const Eigen::Matrix3Xd& dx) const;
  /// Moves x, which a long step came to, so that its axial forces become `force` to first order: a
  /// straight step across a bent rod stretches it at second order.
  void restore_lengths(const Eigen::VectorXd& force, Eigen::Matrix3Xd& x) const;
  /// state.x += dx and the mixed update of the forces.
  void apply(const Eigen::Matrix3Xd& dx, State& state) const;

  const Model& model() const { return model_; }
  const Assembly& assembly() const { return assembly_; }  ///< of the last at()
  double residual() const;  ///< largest force on a free node that nothing holds
  const Effort& effort() const { return effort_; }
  Effort& effort() { return effort_; }

 private:
  void border(Inertia& inertia);

  const Model& model_;
  std::unique_ptr<LinearSolver> solver_;
  Assembly assembly_;
  Prescription prescription_;
  std::vector<Eigen::Matrix3Xd> border_;  // (K + g B B^T)^-1 B, a matrix a column
  Eigen::MatrixXd compliance_;            // B^T (K + g B B^T)^-1 B
  Eigen::Matrix3Xd tangents_;             // unit tangent of each edge at the linearisation point
  double EA_scale_ = 1, load_factor_ = 1;
  Effort effort_;
};

/// Largest move of a node.
double largest_column(const Eigen::Matrix3Xd& dx);

struct NewtonOptions {
  double tolerance_mm = 1e-5;  ///< converged when a correction moves no node further
  int most_iterations = 25;
  double near_mm = 0.2;  ///< corrections below this may use an old factorisation
  bool trust_quadratic =
      false;  ///< take a correction m of a new factorisation as the last where m^2/(1 mm) is
              ///< within the tolerance: the next would be about that
  double farthest_mm = 1e300;  ///< a correction that moves a node further is refused: diverged
  double widest_turn = -0.5;   ///< edges that turn further than this cosine have folded
};

/// How full Newton steps ended.
enum class NewtonOutcome { converged, folded, diverged, not_finite, not_converged };

struct NewtonReport {
  NewtonOutcome outcome = NewtonOutcome::not_converged;
  int iterations = 0;        ///< corrections, with a new factorisation or an old one
  double first_move_mm = 0;  ///< of the first correction: how good the guess was
  double last_move_mm = 0;
  double factored_move_mm =
      0;                  ///< since the last factorisation, the first correction with it included
  double residual_N = 0;  ///< at the state left, once converged
  Inertia inertia;        ///< of the last factorisation (mixed form)
};

/// Full mixed Newton steps from `state`, pinned nodes held; a factorisation is used again for as
/// long as its corrections shrink tenfold. On success `state` is the equilibrium, else it is the
/// last iterate and the report says what happened.
NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options);

}  // namespace gridshell
