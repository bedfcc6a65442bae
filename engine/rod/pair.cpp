#include "engine/rod/pair.h"

#include <Eigen/Geometry>

namespace gridshell {

PairEnergy& PairEnergy::operator+=(const PairEnergy& other) {
  gradient += other.gradient;
  hessian += other.hessian;
  return *this;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Matrix3d m = 0.5 * a * b.transpose();
  return m + m.transpose();
}

CurvatureBinormal curvature_binormal(const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
  const double chi = 1 + t.dot(s);
  return {t, s, 2 / chi * t.cross(s), chi};
}

BinormalSlopes binormal_with_slopes(const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
  BinormalSlopes b{curvature_binormal(t, s), {}, {}, {}, {}};
  b.P = Eigen::Matrix3d::Identity() - t * t.transpose();
  b.Q = Eigen::Matrix3d::Identity() - s * s.transpose();
  b.by_p.noalias() = -(2 * cross_matrix(s) + b.kb * s.transpose()) / b.chi * b.P;
  b.by_q.noalias() = (2 * cross_matrix(t) - b.kb * t.transpose()) / b.chi * b.Q;
  return b;
}

void scale_to_edges(double length_e, double length_f, PairEnergy& out) {
  PairVector scale;
  scale << Eigen::Vector3d::Constant(1 / length_e), Eigen::Vector3d::Constant(1 / length_f), 1, 1;
  out.gradient.array() *= scale.array();
  out.hessian = (scale.asDiagonal() * out.hessian * scale.asDiagonal()).eval();
}

void add_cosine(double by_c, double by_cc, const EdgeGeometry& e, const EdgeGeometry& f,
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
