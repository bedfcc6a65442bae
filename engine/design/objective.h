// What a design makes small, with its slope and curvature.
#pragma once

#include <Eigen/Core>

#include "engine/design/moved_shell.h"
#include "engine/design/target.h"

namespace gridshell {

/// Weights of what stands beside the distances: without the forces legs are compressed until they
/// buckle.
struct ObjectiveWeights {
  double moves = 0.03;   ///< mu
  double forces = 0.01;  ///< eta
  double scale = 1;      ///< of a variable: mm, rad
  double force_N = 0.1;  ///< of a leg
};

/// 1/2 (mean |r|^p)^(2/p) + 1/2 mu mean((q/scale)^2) + 1/2 eta mean((N_leg/force)^2), r the
/// distances of the joints in mm, q the variables from where they began, by z (q = basis z): value,
/// gradient, and the curvature that is left when r and N are taken as linear in z.
struct Objective {
  double value = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// The value alone.
double objective_value(const Distances& distances, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& leg_forces, double p,
                       const ObjectiveWeights& weights);

/// `moved`: how joints and leg forces change with z.
Objective objective(const Distances& distances, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& leg_forces, const Eigen::MatrixXd& basis,
                    const Sensitivity& moved, double p, const ObjectiveWeights& weights);

}  // namespace gridshell
