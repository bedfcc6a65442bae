#include "engine/rod/twist.h"

namespace gridshell {

void add_twist_curvature(double weight, const CurvatureBinormal& b, PairMatrix& out) {
  const Eigen::Vector3d mean = (b.t + b.s) / b.chi;
  const auto add_own = [&](int at, const Eigen::Vector3d& a) {
    out.block<3, 3>(at, at) -= symmetric_product(0.5 * weight * a, b.kb);
  };
  add_own(0, b.t + mean);
  add_own(3, b.s + mean);
  const Eigen::Matrix3d across =
      cross_matrix(0.5 * weight * mean) - symmetric_product(0.5 * weight * mean, b.kb);
  out.block<3, 3>(0, 3) += across;
  out.block<3, 3>(3, 0) += across.transpose();
}

void add_twist(double stiffness, double excess, const CurvatureBinormal& b, PairEnergy& out) {
  PairVector slope;
  slope << 0.5 * b.kb, 0.5 * b.kb, -1, 1;
  out.gradient += stiffness * excess * slope;
  out.hessian.noalias() += (stiffness * slope) * slope.transpose();
  add_twist_curvature(stiffness * excess, b, out.hessian);
}

double Torsion::add(const PairGeometry& at, PairEnergy& out) const {
  PairEnergy here;
  add_twist(stiffness, excess(at), curvature_binormal(at.e.tangent, at.f.tangent), here);
  scale_to_edges(at.e.length, at.f.length, here);
  out += here;
  return value(at);
}

}  // namespace gridshell
