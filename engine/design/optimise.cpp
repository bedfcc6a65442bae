#include "engine/design/optimise.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/design/design_shell.h"
#include "engine/scene/net_design.h"

namespace gridshell {

Eigen::VectorXd Distances::size() const { return vector.colwise().norm(); }

Result<DesignTarget> DesignTarget::make(std::shared_ptr<const ChebyshevNet> net,
                                        Eigen::Matrix2Xd uv, preset::Target kind) {
  TRY(positions, points_on(*net, uv));
  DesignTarget target;
  target.net_ = std::move(net);
  target.kind_ = kind;
  target.uv_ = std::move(uv);
  target.positions_ = std::move(*positions);
  return target;
}

Eigen::Matrix3Xd DesignTarget::nearest(const Eigen::Matrix3Xd& joints) {
  return joints - distances(joints).vector;
}

Distances DesignTarget::distances(const Eigen::Matrix3Xd& joints) {
  if (kind_ == preset::Target::net) return {joints - positions_, {}};
  constexpr int most_iterations = 30;
  constexpr double near_mm = 1e-10;
  Distances found{Eigen::Matrix3Xd(3, joints.cols()), Eigen::Matrix3Xd(3, joints.cols())};
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    const Eigen::Vector3d joint = joints.col(k);
    auto at = net_->at(uv_(0, k), uv_(1, k));
    // the net exists at the point that was found last
    for (int iteration = 0; at && iteration < most_iterations; ++iteration) {
      const Eigen::Vector3d off = joint - at->position;
      const double c = at->tangent_u.dot(at->tangent_v);
      Eigen::Matrix2d metric;
      metric << 1, c, c, 1;
      const Eigen::Vector2d step =
          metric.inverse() * Eigen::Vector2d(off.dot(at->tangent_u), off.dot(at->tangent_v));
      const Eigen::Vector2d there = uv_.col(k) + step;
      const auto next = net_->at(there.x(), there.y());
      if (!next) break;
      uv_.col(k) = there;
      at = next;
      if (step.norm() < near_mm) break;
    }
    const Eigen::Vector3d normal = at->normal();
    found.normal.col(k) = normal;
    found.vector.col(k) = normal.dot(joint - at->position) * normal;
  }
  return found;
}

namespace {

double mean_power(const Eigen::VectorXd& size, double p) { return size.array().pow(p).mean(); }

/// Derivatives of the distance vectors by z, (3 joints) x changes.
Eigen::MatrixXd distance_rates(const Distances& distances, const Sensitivity& moved) {
  const Eigen::Index joints = distances.vector.cols();
  Eigen::MatrixXd rates(3 * joints, Eigen::Index(moved.x.size()));
  for (std::size_t c = 0; c < moved.x.size(); ++c)
    for (Eigen::Index k = 0; k < joints; ++k) {
      Eigen::Vector3d rate = moved.x[c].col(k);
      if (distances.normal.size() > 0)
        rate = distances.normal.col(k) * distances.normal.col(k).dot(rate);
      rates.block<3, 1>(3 * k, Eigen::Index(c)) = rate;
    }
  return rates;
}

/// Adds the term of the distances. With w_k = |r_k|^(p-2) M^(2/p-1)/n, M = mean |r|^p and e = r/|r|
/// the gradient is sum w J^T r, the curvature
/// sum w (J^T J + (p-2) (J^T e)(J^T e)^T) + (2-p) M^(-2/p) gradient gradient^T.
void add_distances(const Distances& distances, const Sensitivity& moved, double p, Objective& sum) {
  const Eigen::VectorXd size = distances.size();
  const double M = mean_power(size, p), n = double(size.size());
  if (!(M > 0)) return;
  const Eigen::MatrixXd J = distance_rates(distances, moved);
  const double scale = std::pow(M, 2 / p - 1) / n;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(J.cols());
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  for (Eigen::Index k = 0; k < size.size(); ++k) {
    const double w = scale * std::pow(size[k], p - 2);
    const auto rows = J.middleRows<3>(3 * k);
    const Eigen::Vector3d r = distances.vector.col(k);
    gradient += w * rows.transpose() * r;
    curvature += w * rows.transpose() * rows;
    if (size[k] == 0) continue;
    const Eigen::VectorXd along = rows.transpose() * (r / size[k]);
    curvature += w * (p - 2) * along * along.transpose();
  }
  sum.value += 0.5 * std::pow(M, 2 / p);
  sum.gradient += gradient;
  sum.curvature += curvature + (2 - p) * std::pow(M, -2 / p) * gradient * gradient.transpose();
}

constexpr double jump =
    0.1;  // in units of d: largest accepted distance of the Newton result from a prediction
/// A stage: its norm, the initial damping (over the mean curvature), and the relative decrease of
/// the objective at which it ends.
struct Stage {
  double norm, damping, flat_enough;
};
constexpr double least_damping = 1e-4, most_damping = 1e4;

class Optimiser {
 public:
  Optimiser(DesignShell& shell, DesignTarget& target, const DesignVariables& variables,
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

  /// One iteration; returns whether the stage continues. A cancelled iteration has no effect.
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
    const Eigen::VectorXd requested = -definite_solution(damped, now.gradient);
    const Eigen::VectorXd q =
        variables_.limited(q_ + variables_.basis() * requested, options_.move_limit_mm);
    const std::string refused = attempt(q, now.value, p);
    if (!refused.empty() && watch_.cancelled()) return false;
    DesignStep step = described(p, refused.empty() ? q : q_);
    step.taken = refused.empty();
    step.refused = refused;
    if (step.taken) {
      // the ratio of the actual to the predicted decrease measures the linearisation
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

  /// Moves the shell to q. If the step is refused, returns the reason and leaves the shell
  /// unchanged; else an empty text.
  std::string attempt(const Eigen::VectorXd& q, double value, double p) {
    const DesignShell::ShellPosition before = shell_.position();
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
    if (!(eigenvalue >= allowed_))
      return fmt::format("the smallest eigenvalue of {:.3g} N/mm^2 is below its limit of {:.3g}",
                         eigenvalue, allowed_);
    eigenvalue_ = eigenvalue;
    return "";
  }

  DesignShell& shell_;
  DesignTarget& target_;
  const DesignVariables& variables_;
  OptimiseOptions options_;
  const Watch& watch_;
  double jump_mm_;
  double eigenvalue_ = 0;  // smallest one of the current state
  double allowed_ = 0, most_force_ = 0;
  double damping_ = 1;
  Sensitivity moved_;
  bool fresh_ = false;  // whether moved_ belongs to the current state
  Eigen::VectorXd q_;
  std::vector<DesignStep> steps_;
};

}  // namespace

double objective_value(const Distances& distances, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& leg_forces, double p,
                       const ObjectiveWeights& weights) {
  return 0.5 * std::pow(mean_power(distances.size(), p), 2 / p) +
         0.5 * weights.moves * (q / weights.scale).array().square().mean() +
         0.5 * weights.forces * (leg_forces / weights.force_N).array().square().mean();
}

Objective objective(const Distances& distances, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& leg_forces, const Eigen::MatrixXd& basis,
                    const Sensitivity& moved, double p, const ObjectiveWeights& weights) {
  const Eigen::Index m = basis.cols();
  Objective sum{0, Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
  add_distances(distances, moved, p, sum);
  const double mu = weights.moves / (double(q.size()) * weights.scale * weights.scale);
  sum.gradient += mu * basis.transpose() * q;
  sum.curvature += mu * basis.transpose() * basis;
  const double eta =
      weights.forces / (double(leg_forces.size()) * weights.force_N * weights.force_N);
  sum.gradient += eta * moved.leg_force.transpose() * leg_forces;
  sum.curvature += eta * moved.leg_force.transpose() * moved.leg_force;
  sum.value = objective_value(distances, q, leg_forces, p, weights);
  return sum;
}

std::vector<DesignStep> optimise(DesignShell& shell, DesignTarget& target,
                                 const DesignVariables& variables, const OptimiseOptions& options,
                                 double spacing_mm, const Watch& watch,
                                 const std::function<void(const DesignStep&)>& seen) {
  Optimiser run(shell, target, variables, options, spacing_mm, watch);
  run.begin();
  // first p = 2, and not to the end, as the objective of a large p is less smooth
  std::vector<Stage> stages{{2, 0.3, 0.03}, {options.norm, 1, 0.002}};
  if (options.norm == 2) stages.erase(stages.begin());
  for (const Stage& stage : stages) {
    run.begin_stage(stage);
    while (run.iterations() < options.most_iterations && !watch.cancelled())
      if (!run.step(stage, seen)) break;
    if (watch.cancelled()) break;
  }
  return std::move(run.steps());
}

}  // namespace gridshell
