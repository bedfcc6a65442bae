// Target and objective of a design, and its optimisation.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "engine/core/watch.h"
#include "engine/design/variables.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

class DesignShell;
struct Sensitivity;

/// The distance of each joint from the target as a vector, 3 x joints, mm, and the projection of a
/// joint's displacement that changes it: the identity if the joint's position on the net is the
/// target, the projection on the surface's normal if the surface is.
struct Distances {
  Eigen::Matrix3Xd vector;
  Eigen::Matrix3Xd normal;  ///< unit; empty: every move counts

  Eigen::VectorXd size() const;
};

/// The target of a design: the positions of joints on a net, or the net's surface.
class DesignTarget {
 public:
  /// The target for joints at (u, v) of a net. Errors: those of the net there.
  static Result<DesignTarget> make(std::shared_ptr<const ChebyshevNet> net, Eigen::Matrix2Xd uv,
                                   preset::Target kind);

  /// Distances of joints (3 x joints, mm). The nearest point of a surface is found by Newton's
  /// method on the net, from the last one found; outside the net its tangent plane replaces the
  /// surface.
  Distances distances(const Eigen::Matrix3Xd& joints);
  /// The nearest points of the target, 3 x joints, mm.
  Eigen::Matrix3Xd nearest(const Eigen::Matrix3Xd& joints);

 private:
  std::shared_ptr<const ChebyshevNet> net_;
  preset::Target kind_ = preset::Target::surface;
  Eigen::Matrix2Xd uv_;         // (u, v) of the nearest points
  Eigen::Matrix3Xd positions_;  // positions of the joints on the net, mm
};

// The objective of a design, with gradient and curvature.

/// Weights of the terms in addition to the distances: without the forces, legs are compressed until
/// they buckle.
struct ObjectiveWeights {
  double moves = 0.03;   ///< mu
  double forces = 0.01;  ///< eta
  double scale = 1;      ///< unit of a variable: mm, rad
  double force_N = 0.1;  ///< unit of the force of a leg
};

/// The objective 1/2 (mean |r|^p)^(2/p) + 1/2 mu mean((q/scale)^2) + 1/2 eta mean((N_leg/force)^2)
/// and its derivatives by z (q = basis z). r are the distances of the joints, mm, q the changes of
/// the variables. The curvature is that for r and N linear in z.
struct Objective {
  double value = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// The value alone.
double objective_value(const Distances& distances, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& leg_forces, double p,
                       const ObjectiveWeights& weights);

/// The objective with derivatives; `moved`: the sensitivities by z.
Objective objective(const Distances& distances, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& leg_forces, const Eigen::MatrixXd& basis,
                    const Sensitivity& moved, double p, const ObjectiveWeights& weights);

// Levenberg-Marquardt on the ends of a shell.

struct OptimiseOptions {
  double norm = 8;             ///< p of the last stage; the first is 2
  double move_limit_mm = 5;    ///< largest change of a pin or a leg
  double min_stability = 0.5;  ///< least ratio of the smallest eigenvalue to the initial one
  double max_leg_force_N = 0;  ///< 0: any
  int most_iterations = 25;
  ObjectiveWeights weights;
};

/// One iteration of the optimisation.
struct DesignStep {
  int iteration = 0;
  double norm = 2;
  double objective = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints
  double eigenvalue = 0;           ///< N/mm^2
  double largest_move_mm = 0;
  bool taken = false;   ///< whether the step was accepted
  std::string refused;  ///< reason if it was not; else empty
  Eigen::VectorXd q;    ///< variables after the iteration
};

/// Minimises the objective, with p = 2 first and then the requested norm, by damped steps of the
/// linearised problem; each is predicted by x + S dq and corrected by Newton's method. A step is
/// accepted only if it converged without a snap and without negative pivots, with the smallest
/// eigenvalue and the leg forces within their limits, and if the objective decreased. `seen` is
/// called after every step, with the shell in its state. The shell ends at the optimum or, after a
/// cancel, in the last accepted step. Returns all steps, the initial state first.
std::vector<DesignStep> optimise(DesignShell& shell, DesignTarget& target,
                                 const DesignVariables& variables, const OptimiseOptions& options,
                                 double spacing_mm, const Watch& watch,
                                 const std::function<void(const DesignStep&)>& seen = {});

}  // namespace gridshell
