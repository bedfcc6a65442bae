// The shell of a design on one mesh: its ends are changed, with its sensitivities to them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/design/variables.h"
#include "engine/elastic/model.h"
#include "engine/scene/scene.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// First-order change of the shell with the ends, per unit of each change.
struct Sensitivity {
  std::vector<Eigen::Matrix3Xd> x;  ///< displacements of all columns, one matrix per change, mm
  Eigen::MatrixXd leg_force;        ///< change of the leg forces, ends x changes, N
};

/// An equilibrium g(x, q) = dE/dx = 0 of the bend model and its sensitivity to pins, legs,
/// prescribed directions and diameters q: dx/dq = -H^-1 dg/dq with the current factor.
class DesignShell {
 public:
  /// Starts from a state of the scene's model on a mesh, in equilibrium with the scene's ends.
  /// Errors: bad_input, no_equilibrium, cancelled.
  static Result<std::unique_ptr<DesignShell>> make(const Scene& scene, int edges_per_segment,
                                                   const RodMesh& mesh, const Model& model,
                                                   const State& state,
                                                   const Watch& watch = unwatched);

  /// Changes the ends: the new state is predicted by its sensitivity and corrected by Newton's
  /// method, at most `farthest_mm` from the prediction. Errors (no_equilibrium): no convergence, a
  /// snap, an unstable state; cancelled; the shell is then unchanged.
  Result<void> move(const ShellEnds& ends, double farthest_mm, const Watch& watch = unwatched);

  /// Changes the ends in as many equal steps as necessary, each at least 1/64 of the change.
  Result<void> move_in_steps(const ShellEnds& ends, double farthest_mm,
                             const Watch& watch = unwatched);

  /// A saved state of the shell.
  struct ShellPosition {
    State state;
    ShellEnds ends;
  };
  ShellPosition position() const { return {state_, ends_}; }
  void back_to(const ShellPosition& to);

  /// -H^-1 dg/dq for every column of `changes`, a combination of variables with `rates`. After a
  /// cancel the result must not be used.
  Sensitivity sensitivity(const std::vector<DesignVariable>& variables,
                          const std::vector<DesignVariables::Rate>& rates,
                          const Eigen::MatrixXd& changes, const Watch& watch = unwatched);
  /// Smallest eigenvalue of H v = lambda L v, N/mm^2: H is the Hessian, L the length of rod lumped
  /// at the nodes. NaN if it does not converge or after a cancel.
  double smallest_eigenvalue(const Watch& watch = unwatched);

  const RodMesh& mesh() const { return mesh_; }
  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  const ShellEnds& ends() const { return ends_; }
  Eigen::Matrix3Xd joints() const;
  /// Axial force of every leg at its edge point, N.
  Eigen::VectorXd leg_forces() const;
  const Energies& energies() const { return system_->assembly().energies; }
  double residual() const { return system_->residual(); }
  /// Forces and tangents of the current state under its loads.
  const Assembly& forces() const { return system_->assembly(); }

 private:
  DesignShell(const Scene& scene, RodMesh mesh);
  void find_legs();
  void set_legs(const ShellEnds& ends);
  void set_diameters(const ShellEnds& ends);
  void impose(const ShellEnds& ends, Eigen::Matrix3Xd& x) const;
  /// A change of the ends: prescribed columns, mm, leg lengths (one per end), mm, and logarithms of
  /// diameters (one per rod).
  struct Change {
    Eigen::Matrix3Xd prescribed;
    Eigen::VectorXd longer, thicker;
  };
  Eigen::Matrix3Xd follow(const Change& change) const;
  Result<void> settle(const ShellEnds& ends, double farthest_mm, const Watch& watch);
  void add_leg_gradient(int end, double change, Eigen::Matrix3Xd& minus_dg) const;
  void add_diameter_gradient(std::size_t rod, double change, Eigen::Matrix3Xd& minus_dg) const;
  void add_bend_gradient(int bend, double fraction, Eigen::Matrix3Xd& minus_dg) const;

  const Scene& scene_;
  RodMesh mesh_;
  Model model_;
  State state_;
  ShellEnds ends_;
  std::unique_ptr<Linearisation> system_;
  struct Leg {
    std::vector<int> edges;
    int at_end = -1;           ///< the edge at the edge point
    std::vector<int> bends;    ///< bends with at least one of its edges
    int ghost = -1, far = -1;  ///< nodes outside its edge point: ghost, far end of a tail
    double weight_N_per_mm = 0;

    /// How many of a bend's two edges belong to the leg.
    int edges_of(const ModelBend& bend) const {
      return int(std::ranges::count(edges, bend.e) + std::ranges::count(edges, bend.f));
    }
  };
  std::vector<Leg> legs_;                ///< one per end
  std::vector<std::vector<int>> bends_;  ///< bends of each rod
  Eigen::VectorXd diameter_;             ///< current diameters of the model, one per rod, mm
};

}  // namespace gridshell
