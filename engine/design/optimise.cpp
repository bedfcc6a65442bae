#include "engine/design/optimise.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

constexpr double jump = 0.1;  // of d: Newton's way from a prediction that is believed
/// A norm, from which damping (of the mean curvature) its steps begin, and at which relative fall
/// of the objective it has done its work.
struct Stage {
  double norm, damping, flat_enough;
};
constexpr double least_damping = 1e-4, most_damping = 1e4;

class Optimiser {
 public:
  Optimiser(MovedShell& shell, DesignTarget& target, const DesignVariables& variables,
            const OptimiseOptions& options, double spacing_mm, const Watch& watch)
      : shell_(shell),
        target_(target),
        variables_(variables),
        options_(options),
        watch_(watch),
        jump_mm_(jump * spacing_mm) {
    q_ = Eigen::VectorXd::Zero(variables.count());
    eigenvalue_ = shell.smallest_eigenvalue();
    allowed_ = options.min_stability * eigenvalue_;
    most_force_ =
        options.max_leg_force_N > 0 ? std::max(options.max_leg_force_N, largest_force()) : INFINITY;
  }

  /// One iteration; whether the stage may go on. One that is stopped never was.
  bool step(const Stage& stage, const std::function<void(const DesignStep&)>& seen) {
    const double p = stage.norm;
    const auto rates = variables_.rates_at(q_);
    if (!fresh_) moved_ = shell_.sensitivity(variables_.all(), rates, variables_.basis(), watch_);
    if (watch_.cancelled()) return false;
    fresh_ = true;
    const Objective now = objective(target_.distances(shell_.joints()), q_, shell_.leg_forces(),
                                    variables_.basis(), moved_, p, options_.weights);
    Eigen::MatrixXd damped = now.curvature;
    damped.diagonal().array() += damping_ * now.curvature.diagonal().mean();
    const Eigen::VectorXd wanted = -damped.ldlt().solve(now.gradient);
    const Eigen::VectorXd q =
        variables_.limited(q_ + variables_.basis() * wanted, options_.move_limit_mm);
    const std::string refused = attempt(q, now.value, p);
    if (!refused.empty() && watch_.cancelled()) return false;
    DesignStep step = described(p, refused.empty() ? q : q_);
    step.taken = refused.empty();
    step.refused = refused;
    if (step.taken) {
      // how much of what the linearised problem promised came true says how far it holds
      const Eigen::VectorXd dz = variables_.basis().transpose() * (q - q_);
      const double promised = -now.gradient.dot(dz) - 0.5 * dz.dot(now.curvature * dz);
      const double kept = (now.value - step.objective) / promised;
      damping_ = std::max(damping_ * (kept > 0.75 ? 0.25 : kept < 0.4 ? 2.0 : 0.7), least_damping);
      q_ = q;
      fresh_ = false;
    } else {
      damping_ *= 5;
    }
    steps_.push_back(step);
    if (seen) seen(step);
    if (!step.taken) return damping_ < most_damping;
    return now.value - step.objective > stage.flat_enough * now.value;
  }

  void begin() { steps_.push_back(described(2, q_)); }
  int iterations() const { return int(steps_.size()) - 1; }
  void begin_stage(const Stage& stage) { damping_ = stage.damping; }
  std::vector<DesignStep>& steps() { return steps_; }

 private:
  double largest_force() const { return shell_.leg_forces().cwiseAbs().maxCoeff(); }

  DesignStep described(double p, const Eigen::VectorXd& q) {
    const Distances distances = target_.distances(shell_.joints());
    DesignStep step;
    step.iteration = int(steps_.size());
    step.norm = p;
    step.q = q;
    step.objective = objective_value(distances, q, shell_.leg_forces(), p, options_.weights);
    step.max_mm = distances.size().maxCoeff();
    step.mean_mm = distances.size().mean();
    step.eigenvalue = eigenvalue_;
    step.largest_move_mm = variables_.largest_move_mm(q);
    return step;
  }

  /// Moves the shell to q, or says why not and leaves it where it was.
  std::string attempt(const Eigen::VectorXd& q, double value, double p) {
    const MovedShell::Stand before = shell_.stand();
    if (auto moved = shell_.move(variables_.ends_at(q), jump_mm_, watch_); !moved)
      return moved.error().message;
    const std::string wrong = wrong_with(q, value, p);
    if (!wrong.empty()) shell_.back_to(before);
    return wrong;
  }

  std::string wrong_with(const Eigen::VectorXd& q, double value, double p) {
    const double there = objective_value(target_.distances(shell_.joints()), q, shell_.leg_forces(),
                                         p, options_.weights);
    if (!(there < value)) return "the objective did not fall";
    if (largest_force() > most_force_)
      return fmt::format("a leg's force of {:.3g} N is above its limit", largest_force());
    const double eigenvalue = shell_.smallest_eigenvalue(watch_);
    if (watch_.cancelled()) return "it was stopped";
    if (eigenvalue < allowed_)
      return fmt::format("the smallest eigenvalue of {:.3g} N/mm^2 is below its limit of {:.3g}",
                         eigenvalue, allowed_);
    eigenvalue_ = eigenvalue;
    return "";
  }

  MovedShell& shell_;
  DesignTarget& target_;
  const DesignVariables& variables_;
  OptimiseOptions options_;
  const Watch& watch_;
  double jump_mm_;
  double eigenvalue_ = 0;  // of the state
  double allowed_ = 0, most_force_ = 0;
  double damping_ = 1;
  Sensitivity moved_;
  bool fresh_ = false;  // moved_ is that of the state
  Eigen::VectorXd q_;
  std::vector<DesignStep> steps_;
};

}  // namespace

std::vector<DesignStep> optimise(MovedShell& shell, DesignTarget& target,
                                 const DesignVariables& variables, const OptimiseOptions& options,
                                 double spacing_mm, const Watch& watch,
                                 const std::function<void(const DesignStep&)>& seen) {
  Optimiser run(shell, target, variables, options, spacing_mm, watch);
  run.begin();
  // towards the largest distance the way is more crooked
  for (const Stage& stage : {Stage{2, 0.3, 0.03}, {options.norm, 1, 0.002}}) {
    run.begin_stage(stage);
    while (run.iterations() < options.most_iterations && !watch.cancelled())
      if (!run.step(stage, seen)) break;
    if (options.norm == 2 || watch.cancelled()) break;
  }
  return std::move(run.steps());
}

}  // namespace gridshell
