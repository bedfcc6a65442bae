#include "engine/rod/twist.h"

namespace gridshell {

PairVector twist_slope(const CurvatureBinormal& b) {
  PairVector slope;
  slope << 0.5 * b.kb, 0.5 * b.kb, -1, 1;
  return slope;
}

void add_twist_curvature(double weight, const CurvatureBinormal& b, PairMatrix& out) {
  const Eigen::Matrix3d pp = b.by_p.transpose() * b.P, qq = b.by_q.transpose() * b.Q;
  out.block<3, 3>(0, 0) += weight * (0.25 * (pp + pp.transpose()) - symmetric_product(b.t, b.kb));
  out.block<3, 3>(3, 3) += weight * (0.25 * (qq + qq.transpose()) - symmetric_product(b.s, b.kb));
  const Eigen::Matrix3d pq = 0.25 * weight * (b.by_p.transpose() * b.Q + b.P * b.by_q);
  out.block<3, 3>(0, 3) += pq;
  out.block<3, 3>(3, 0) += pq.transpose();
}

void add_twist(double stiffness, double excess, const CurvatureBinormal& b, PairEnergy& out) {
  const PairVector slope = twist_slope(b);
  out.gradient += stiffness * excess * slope;
  out.hessian.noalias() += stiffness * slope * slope.transpose();
  add_twist_curvature(stiffness * excess, b, out.hessian);
}

double Torsion::add(const PairGeometry& at, PairEnergy& out) const {
  PairEnergy here;
  add_twist(stiffness, excess(at), binormal_with_derivatives(at.e.tangent, at.f.tangent), here);
  scale_to_edges(at.e.length, at.f.length, here);
  out += here;
  return value(at);
}

}  // namespace gridshell
