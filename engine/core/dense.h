// Small dense problems. Eigen's decompositions are compiled once, in dense.cpp and dense_eigen.cpp:
// a file that uses one itself takes seconds longer to compile.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace gridshell {

/// Eigenvalues of a symmetric matrix in ascending order, and its unit eigenvectors as columns.
struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

EigenPairs eigen_pairs(const Eigen::MatrixXd& symmetric);

/// Those of A v = lambda B v, A symmetric, B symmetric and positive definite.
EigenPairs eigen_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// A^-1 and A^-1 b of a square A that has an inverse.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^-1 b of a symmetric positive definite A.
Eigen::VectorXd definite_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// X that makes |A X - B| least, A of full rank.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The shortest x of those that make |A x - b| least; pivots below `threshold` of the largest count
/// as zero.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       double threshold);

/// The rank of A, with that threshold.
Eigen::Index rank_of(const Eigen::MatrixXd& A, double threshold);

/// As many orthonormal columns as those of A span.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);

/// R that makes |R x - y| least, columns of x and y being points about their means [Kabsch 1976]: a
/// rotation, or, where mirrors count too, a reflection.
Eigen::Matrix3d best_turn(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y, bool mirrors);

/// Weights at t of the polynomial through values at `known` [Lagrange]; 0 for one left out.
Eigen::VectorXd polynomial_weights(const std::vector<double>& known, double t,
                                   std::size_t left_out = std::size_t(-1));

/// Weights at t of the polynomial through values and slopes at `known` [Hermite]: of the values in
/// the first column, of the slopes in the second.
Eigen::MatrixX2d slope_weights(const std::vector<double>& known, double t);

/// The shortest rotation that takes the direction of `from` to that of `to`.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace gridshell
