// Small dense problems. Eigen's decompositions are compiled only in dense.cpp and dense_eigen.cpp:
// a file that uses one directly takes seconds longer to compile.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace gridshell {

/// Eigenvalues of a symmetric matrix in ascending order, and its unit eigenvectors as columns.
struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Eigenvalues and eigenvectors of a symmetric matrix.
EigenPairs eigen_pairs(const Eigen::MatrixXd& symmetric);

/// Eigenvalues and eigenvectors of A v = lambda B v, A symmetric, B symmetric and positive
/// definite.
EigenPairs eigen_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Eigenvalues of a symmetric matrix in ascending order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// A^-1 of a square, invertible A.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
/// A^-1 b of a square, invertible A.
Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^-1 b of a symmetric, positive definite A.
Eigen::VectorXd definite_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Solves row k of a tridiagonal system: lower[k] x[k - 1] + diagonal[k] x[k] + upper[k] x[k + 1] =
/// b[k], by elimination without pivoting [Thomas]; lower[0] and the last of upper are not read.
/// `b`: one column per row of the system, on return the x.
void solve_tridiagonal(const Eigen::VectorXd& lower, Eigen::VectorXd diagonal,
                       const Eigen::VectorXd& upper, Eigen::Ref<Eigen::MatrixXd> b);

/// The X that minimises |A X - B|, A of full rank.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The shortest x of those that minimise |A x - b|; pivots below `threshold` of the largest count
/// as zero.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       double threshold);

/// The rank of A; pivots below `threshold` of the largest count as zero.
Eigen::Index rank_of(const Eigen::MatrixXd& A, double threshold);

/// An orthonormal basis of the span of the columns of A, which must be linearly independent.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);

/// The R that minimises |R x - y|, the columns of x and y being points relative to their means
/// [Kabsch 1976]: a rotation or, with `mirrors`, possibly a reflection.
Eigen::Matrix3d best_turn(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y, bool mirrors);

/// Weights at t of the polynomial through values at `known` [Lagrange]. `left_out`: index of a
/// value that is not used; its weight is 0.
Eigen::VectorXd polynomial_weights(const std::vector<double>& known, double t,
                                   std::size_t left_out = std::size_t(-1));

/// Weights at t of the polynomial through values and slopes at `known` [Hermite]: those of the
/// values are in the first column, those of the slopes in the second.
Eigen::MatrixX2d slope_weights(const std::vector<double>& known, double t);

/// The shortest rotation that takes the direction of `from` to that of `to`.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The angle between two vectors, 0 to pi; accurate near both.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

using Chains = std::vector<std::vector<std::size_t>>;
/// Inverts normals so that those of neighbours in a chain of their indices have a positive scalar
/// product. Returns the pieces in which chains connect them.
Chains turn_to_one_side(const Chains& chains, std::vector<Eigen::Vector3d>& normals);

}  // namespace gridshell
