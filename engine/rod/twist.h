// Twisting of a rod at a node between two edges [Bergou 2008, 2010].
#pragma once

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

namespace gridshell {

/// Twist tau = theta_f - theta_e + m_ref. With the frames carried along straight lines, by
/// increments p = de/|e|, q = df/|f|:
///   tau'  = kb.(p + q)/2 + theta_f' - theta_e',
///   tau'' = kb'.(P p + Q q)/2 - (t.p)(kb.p) - (s.q)(kb.q).
/// The printed second derivatives of m_ref are the derivative of kb/(2|e|); that is not symmetric,
/// as carrying a frame round a loop turns it. The symmetric part is the Hessian.
inline PairVector twist_slope(const CurvatureBinormal& b) {
  PairVector slope;
  slope << 0.5 * b.kb, 0.5 * b.kb, -1, 1;
  return slope;
}

/// out += weight * tau'' as a symmetric matrix (increments).
inline void add_twist_curvature(double weight, const CurvatureBinormal& b, PairMatrix& out) {
  const Eigen::Matrix3d pp = b.by_p.transpose() * b.P, qq = b.by_q.transpose() * b.Q;
  out.block<3, 3>(0, 0) += weight * (0.25 * (pp + pp.transpose()) - symmetric_product(b.t, b.kb));
  out.block<3, 3>(3, 3) += weight * (0.25 * (qq + qq.transpose()) - symmetric_product(b.s, b.kb));
  const Eigen::Matrix3d pq = 0.25 * weight * (b.by_p.transpose() * b.Q + b.P * b.by_q);
  out.block<3, 3>(0, 3) += pq;
  out.block<3, 3>(3, 0) += pq.transpose();
}

/// E = stiffness/2 (tau - tau_0)^2, `stiffness` = GJ/l (mJ), `excess` = tau - tau_0; in increments.
inline void add_twist(double stiffness, double excess, const CurvatureBinormal& b,
                      PairEnergy& out) {
  const PairVector slope = twist_slope(b);
  out.gradient += stiffness * excess * slope;
  out.hessian.noalias() += stiffness * slope * slope.transpose();
  add_twist_curvature(stiffness * excess, b, out.hessian);
}

/// Torsion between two edges that follow one another on a rod.
struct Torsion {
  static constexpr Term term = Term::twist;
  double stiffness = 0;  ///< GJ/l, mJ
  double rest = 0;       ///< tau_0, rad

  double excess(const PairGeometry& at) const { return at.twist() - rest; }
  double value(const PairGeometry& at) const { return 0.5 * stiffness * excess(at) * excess(at); }
  double add(const PairGeometry& at, PairEnergy& out) const {
    PairEnergy here;
    add_twist(stiffness, excess(at), binormal_with_derivatives(at.e.tangent, at.f.tangent), here);
    scale_to_edges(at.e.length, at.f.length, here);
    out += here;
    return value(at);
  }
};

}  // namespace gridshell
