#include "engine/core/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <utility>

namespace gridshell {

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) { return A.inverse(); }

Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::VectorXd definite_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.ldlt().solve(b);
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.colPivHouseholderQr().solve(B);
}

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  return decomposition.compute(A).solve(b);
}

Eigen::Index rank_of(const Eigen::MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(threshold);
  return qr.compute(A).rank();
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), A.cols());
}

Eigen::Matrix3d best_turn(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y, bool mirrors) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < x.cols(); ++k) covariance += y.col(k) * x.col(k).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (!mirrors && svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign[2] = -1;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double c = a.dot(b);
  // half a turn about any perpendicular axis
  if (c < -1 + 1e-12) return Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, a.unitOrthogonal()));
  Eigen::Quaterniond turn;
  const double s = std::sqrt(2 * (1 + c));
  turn.w() = 0.5 * s;
  turn.vec() = a.cross(b) / s;
  return turn;
}

Chains turn_to_one_side(const Chains& chains, std::vector<Eigen::Vector3d>& normals) {
  Chains neighbours(normals.size()), pieces;
  for (const auto& chain : chains)
    for (std::size_t k = 1; k < chain.size(); ++k) {
      neighbours[chain[k - 1]].push_back(chain[k]);
      neighbours[chain[k]].push_back(chain[k - 1]);
    }
  std::vector<char> seen(normals.size(), 0);
  for (std::size_t first = 0; first < normals.size(); ++first) {
    if (std::exchange(seen[first], 1)) continue;
    auto& piece = pieces.emplace_back(1, first);
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const std::size_t next : neighbours[piece[k]]) {
        if (std::exchange(seen[next], 1)) continue;
        if (normals[next].dot(normals[piece[k]]) < 0) normals[next] *= -1;
        piece.push_back(next);
      }
  }
  return pieces;
}

void solve_tridiagonal(const Eigen::VectorXd& lower, Eigen::VectorXd diagonal,
                       const Eigen::VectorXd& upper, Eigen::Ref<Eigen::MatrixXd> b) {
  for (Eigen::Index k = 1; k < b.cols(); ++k) {
    const double factor = lower[k] / diagonal[k - 1];
    diagonal[k] -= factor * upper[k - 1];
    b.col(k) -= factor * b.col(k - 1);
  }
  for (Eigen::Index k = b.cols(); k-- > 0;) {
    if (k + 1 < b.cols()) b.col(k) -= upper[k] * b.col(k + 1);
    b.col(k) /= diagonal[k];
  }
}

Eigen::VectorXd polynomial_weights(const std::vector<double>& known, double t,
                                   std::size_t left_out) {
  Eigen::VectorXd all(Eigen::Index(known.size()));
  for (std::size_t k = 0; k < known.size(); ++k) {
    double weight = k == left_out ? 0 : 1;
    for (std::size_t j = 0; j < known.size(); ++j)
      if (j != k && j != left_out) weight *= (t - known[j]) / (known[k] - known[j]);
    all[Eigen::Index(k)] = weight;
  }
  return all;
}

Eigen::MatrixX2d slope_weights(const std::vector<double>& known, double t) {
  Eigen::MatrixX2d all(Eigen::Index(known.size()), 2);
  const Eigen::VectorXd basis = polynomial_weights(known, t);
  for (std::size_t k = 0; k < known.size(); ++k) {
    double slope = 0;  // of the Lagrange polynomial at its own point
    for (std::size_t j = 0; j < known.size(); ++j)
      if (j != k) slope += 1 / (known[k] - known[j]);
    const double square = std::pow(basis[Eigen::Index(k)], 2), offset = t - known[k];
    all.row(Eigen::Index(k)) << (1 - 2 * offset * slope) * square, offset * square;
  }
  return all;
}

}  // namespace gridshell
