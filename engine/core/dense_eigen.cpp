#include <Eigen/Eigenvalues>

#include "engine/core/dense.h"

namespace gridshell {

namespace {

EigenPairs pairs_of(const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& own) {
  return {own.eigenvalues(), own.eigenvectors()};
}

}  // namespace

EigenPairs eigen_pairs(const Eigen::MatrixXd& symmetric) {
  return pairs_of(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric));
}

EigenPairs eigen_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return pairs_of(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B));
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace gridshell
