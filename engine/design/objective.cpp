#include "engine/design/objective.h"

#include <cmath>

namespace gridshell {
namespace {

double mean_power(const Eigen::VectorXd& size, double p) { return size.array().pow(p).mean(); }

/// How the distances change with z: 3 joints x changes.
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

/// With w_k = |r_k|^(p-2) M^(2/p-1)/n, M = mean |r|^p: gradient sum w J^T r, curvature
/// sum w (J^T J + (p-2) (J^T e)(J^T e)^T) + (2-p) M^(-2/p) gradient gradient^T, e = r/|r|.
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

}  // namespace gridshell
