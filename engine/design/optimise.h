// Levenberg-Marquardt on the ends of a shell.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/watch.h"
#include "engine/design/moved_shell.h"
#include "engine/design/objective.h"
#include "engine/design/target.h"
#include "engine/design/variables.h"

namespace gridshell {

struct OptimiseOptions {
  double norm = 8;             ///< p of the last stage; the first is 2
  double move_limit_mm = 5;    ///< of a pin or a leg
  double min_stability = 0.5;  ///< of the smallest eigenvalue, over that of the begin
  double max_leg_force_N = 0;  ///< 0: any
  int most_iterations = 25;
  ObjectiveWeights weights;
};

/// One iteration: what was tried and what came of it.
struct DesignStep {
  int iteration = 0;
  double norm = 2;
  double objective = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints
  double eigenvalue = 0;           ///< N/mm^2
  double largest_move_mm = 0;
  bool taken = false;
  std::string refused;  ///< why it was not; empty where it was
  Eigen::VectorXd q;    ///< the variables after it
};

/// Makes the objective small, with p = 2 first and then the norm asked for: damped steps of the
/// linearised problem, each predicted by x + S dq and brought to rest by Newton's method. A step
/// counts only if it converged, without a jump and a negative pivot, with the smallest eigenvalue
/// and the leg forces within their limits, and if the objective fell. `seen` after every step,
/// while the shell stands in it where it was taken. The shell ends at the optimum; cancelled,
/// between two steps or within one, in the last that was taken. All steps, the begin first.
std::vector<DesignStep> optimise(MovedShell& shell, DesignTarget& target,
                                 const DesignVariables& variables, const OptimiseOptions& options,
                                 double spacing_mm, const Watch& watch,
                                 const std::function<void(const DesignStep&)>& seen = {});

}  // namespace gridshell
