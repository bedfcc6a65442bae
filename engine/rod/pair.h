// What energies of two edges share: their eight local unknowns and the curvature binormal with its
// derivatives.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/rod/bend.h"

namespace gridshell {

/// What an energy of two edges e, f may read of a state.
struct PairGeometry {
  EdgeGeometry e, f;
  double angle_e = 0, angle_f = 0;         ///< theta of each edge, rad
  Eigen::Vector3d director_e, director_f;  ///< of their reference frames
  double reference_twist = 0;              ///< m_ref from e to f, of edges that follow one another

  /// tau = theta_f - theta_e + m_ref
  double twist() const { return angle_f - angle_e + reference_twist; }
};

using PairVector = Eigen::Matrix<double, 8, 1>;
using PairMatrix = Eigen::Matrix<double, 8, 8>;

/// Energy of two edges e, f by (e, f, theta_e, theta_f): edge vectors and angles. The derivatives
/// hold the reference frames as carried along straight lines from the present edges (parallel in
/// time), so the Hessian is symmetric and is that of the energy itself.
struct PairEnergy {
  PairVector gradient = PairVector::Zero();
  PairMatrix hessian = PairMatrix::Zero();

  PairEnergy& operator+=(const PairEnergy& other) {
    gradient += other.gradient;
    hessian += other.hessian;
    return *this;
  }
};

inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// (a b^T + b a^T)/2
inline Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Matrix3d m = 0.5 * a * b.transpose();
  return m + m.transpose();
}

/// kb = 2 t x s/chi, chi = 1 + t.s of unit tangents t (of e) and s (of f), and its derivative by
/// the increments p = de/|e|, q = df/|f|:
/// by_p = -(2 [s]x + kb s^T) (I - t t^T)/chi, by_q = (2 [t]x - kb t^T) (I - s s^T)/chi.
struct CurvatureBinormal {
  Eigen::Vector3d t, s, kb;
  double chi = 2;
  Eigen::Matrix3d P, Q;  ///< I - t t^T, I - s s^T
  Eigen::Matrix3d by_p, by_q;
};

inline Eigen::Vector3d curvature_binormal(const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
  return 2 / (1 + t.dot(s)) * t.cross(s);
}

inline CurvatureBinormal binormal_with_derivatives(const Eigen::Vector3d& t,
                                                   const Eigen::Vector3d& s) {
  CurvatureBinormal b;
  b.t = t;
  b.s = s;
  b.chi = 1 + t.dot(s);
  b.kb = 2 / b.chi * t.cross(s);
  b.P = Eigen::Matrix3d::Identity() - t * t.transpose();
  b.Q = Eigen::Matrix3d::Identity() - s * s.transpose();
  b.by_p.noalias() = -(2 * cross_matrix(s) + b.kb * s.transpose()) / b.chi * b.P;
  b.by_q.noalias() = (2 * cross_matrix(t) - b.kb * t.transpose()) / b.chi * b.Q;
  return b;
}

/// From increments p, q to edge vectors: e counts 1/|e|, f counts 1/|f|.
inline void scale_to_edges(double length_e, double length_f, PairEnergy& out) {
  PairVector scale;
  scale << Eigen::Vector3d::Constant(1 / length_e), Eigen::Vector3d::Constant(1 / length_f), 1, 1;
  out.gradient.array() *= scale.array();
  out.hessian = (scale.asDiagonal() * out.hessian * scale.asDiagonal()).eval();
}

/// E(c), c = t.s, given E' and E'' (edge vectors, after scale_to_edges): bending of a round rod,
/// shear of a joint.
inline void add_cosine(double by_c, double by_cc, const EdgeGeometry& e, const EdgeGeometry& f,
                       PairEnergy& out) {
  const Eigen::Vector3d &t = e.tangent, &s = f.tangent;
  const double c = t.dot(s), i = 1 / e.length, j = 1 / f.length;
  const Eigen::Vector3d p = i * (s - c * t), q = j * (t - c * s);
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - t * t.transpose(),
                        Q = Eigen::Matrix3d::Identity() - s * s.transpose();
  out.gradient.head<3>() += by_c * p;
  out.gradient.segment<3>(3) += by_c * q;
  out.hessian.block<3, 3>(0, 0) +=
      by_cc * p * p.transpose() - 2 * by_c * i * symmetric_product(p, t) - by_c * c * i * i * P;
  out.hessian.block<3, 3>(3, 3) +=
      by_cc * q * q.transpose() - 2 * by_c * j * symmetric_product(q, s) - by_c * c * j * j * Q;
  const Eigen::Matrix3d ef = by_cc * p * q.transpose() + by_c * i * j * P * Q;
  out.hessian.block<3, 3>(0, 3) += ef;
  out.hessian.block<3, 3>(3, 0) += ef.transpose();
}

}  // namespace gridshell
