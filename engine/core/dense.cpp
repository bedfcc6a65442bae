#include "engine/core/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace gridshell {
namespace {

template <int n>
EigenPairs<n> pairs_of(const Eigen::Matrix<double, n, n>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> own(symmetric);
  return {own.eigenvalues(), own.eigenvectors()};
}

}  // namespace

EigenPairs<2> eigen_pairs(const Eigen::Matrix2d& symmetric) { return pairs_of<2>(symmetric); }
EigenPairs<3> eigen_pairs(const Eigen::Matrix3d& symmetric) { return pairs_of<3>(symmetric); }
EigenPairs<Eigen::Dynamic> eigen_pairs(const Eigen::MatrixXd& symmetric) {
  return pairs_of<Eigen::Dynamic>(symmetric);
}

EigenPairs<Eigen::Dynamic> eigen_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> own(A, B);
  return {own.eigenvalues(), own.eigenvectors()};
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) { return A.inverse(); }

Eigen::Vector3d solved(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) {
  return A.partialPivLu().solve(b);
}

Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::VectorXd solved_definite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
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
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(y * x.transpose() / double(x.cols()),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (!mirrors && svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign[2] = -1;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace gridshell
