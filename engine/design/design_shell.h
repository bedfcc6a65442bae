// The symmetries that a shell has and a design keeps, what of it is varied, and the shell on one
// mesh whose ends are moved, with its sensitivities to them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/elastic/model.h"
#include "engine/preset/preset.h"
#include "engine/scene/rod_ends.h"
#include "engine/scene/scene.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// A rigid motion that maps the shell to itself: x maps to turn x + shift, and the end k of a rod
/// (2r the start, 2r + 1 the end of rod r) to the position of end to[k].
struct ShellSymmetry {
  std::vector<int> to;
  Eigen::Matrix3d turn;
};

/// Those of the eight symmetries of the square grid that preserve the footprint, the positions of
/// ends and joints (3 x joints, mm) and the upward direction; the identity is the first. `near_mm`:
/// largest distance of equal positions.
std::vector<ShellSymmetry> symmetries_of(const Scene& scene, const Eigen::Matrix3Xd& joints,
                                         double near_mm);

// What a design changes, as numbers.

/// One variable at one end: displacement of a pin along `way` (mm), change of a leg's length (mm),
/// or rotation of a prescribed direction towards `way` (the new direction is the old one plus the
/// sum of q `way`, normalised: rad for small ones). For a rod, at its start: the diameter, the old
/// one times exp(q/10).
struct DesignVariable {
  preset::Vary kind = preset::Vary::pins;
  int end = 0;
  int component = 0;  ///< of those of its kind at its end
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
};

/// All variables of a design. They change together so that the symmetries of the shell stay: q =
/// basis z, the basis orthonormal, with as many z as the symmetries leave free.
class DesignVariables {
 public:
  /// The variables `vary` at all constrained ends of the scene.
  DesignVariables(const Scene& scene, const std::vector<preset::Vary>& vary,
                  const std::vector<ShellSymmetry>& symmetries);

  const std::vector<DesignVariable>& all() const { return all_; }
  Eigen::Index count() const { return Eigen::Index(all_.size()); }
  const Eigen::MatrixXd& basis() const { return basis_; }
  /// The ends that q makes of those of the scene.
  ShellEnds ends_at(const Eigen::VectorXd& q) const;
  /// How the ends change with the variables: of each its pin, leg, direction and the logarithm of
  /// its diameter move by d times these, at q.
  struct Rate {
    Eigen::Vector3d at, direction;
    double leg, ln_diameter;
  };
  std::vector<Rate> rates_at(const Eigen::VectorXd& q) const;
  /// q with no pin and no leg further than `most_mm` from where it was, no rod thicker or thinner
  /// than twice or half.
  Eigen::VectorXd limited(const Eigen::VectorXd& q, double most_mm) const;
  /// Largest move of a pin or a leg, mm, and turn of a direction, degrees.
  double largest_move_mm(const Eigen::VectorXd& q) const;
  double largest_turn_deg(const Eigen::VectorXd& q) const;
  /// Largest change of a diameter, over the one before.
  double largest_thickening(const Eigen::VectorXd& q) const;

 private:
  ShellEnds begin_;
  std::vector<DesignVariable> all_;
  Eigen::MatrixXd basis_;
};

/// How a change of the ends moves the shell, per unit of each change, to first order.
struct Sensitivity {
  std::vector<Eigen::Matrix3Xd> x;  ///< of all columns, mm
  Eigen::MatrixXd leg_force;        ///< ends x changes, N
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
  ShellPosition stand() const { return {state_, ends_}; }
  void back_to(const ShellPosition& stand);

  /// dg/dq of changes (one a column of `changes`, over variables with `rates`) times -H^-1; of a
  /// watch that is cancelled it says nothing.
  Sensitivity sensitivity(const std::vector<DesignVariable>& variables,
                          const std::vector<DesignVariables::Rate>& rates,
                          const Eigen::MatrixXd& changes, const Watch& watch = unwatched);
  /// Smallest eigenvalue of the Hessian against the rods' length lumped on the nodes, N/mm^2. Of a
  /// watch that is cancelled it says nothing.
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
  /// What changes at once: columns, legs (one an end), logarithms of diameters (one a rod).
  struct Change {
    Eigen::Matrix3Xd prescribed;
    Eigen::VectorXd longer, thicker;
  };
  Eigen::Matrix3Xd follow(const Change& change) const;
  Result<void> settle(const ShellEnds& ends, double farthest_mm, const Watch& watch);
  void add_leg_gradient(int end, double change, Eigen::Matrix3Xd& minus_dg) const;
  void add_diameter_gradient(std::size_t rod, double change, Eigen::Matrix3Xd& minus_dg) const;
  void add_bend_gradient(int bend, double share, Eigen::Matrix3Xd& minus_dg) const;

  const Scene& scene_;
  RodMesh mesh_;
  Model model_;
  State state_;
  ShellEnds ends_;
  std::unique_ptr<Linearisation> system_;
  struct Leg {
    std::vector<int> edges;
    int at_end = -1;           ///< the edge at the edge point
    std::vector<int> bends;    ///< that one of its edges takes part in
    int ghost = -1, far = -1;  ///< nodes outside its edge point

    /// How many of the bend's two edges are among them.
    int edges_of(const ModelBend& bend) const {
      return int(std::ranges::count(edges, bend.e) + std::ranges::count(edges, bend.f));
    }
  };
  std::vector<Leg> legs_;                ///< one an end
  std::vector<std::vector<int>> bends_;  ///< of each rod
  Eigen::VectorXd diameter_;             ///< that the model has, one a rod
};

}  // namespace gridshell
