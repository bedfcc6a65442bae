// Twisting of a rod at a node between two edges [Bergou 2008, 2010].
#pragma once

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

namespace gridshell {

/// Twist tau = theta_f - theta_e + m_ref. With the frames carried along straight lines, by
/// increments p = de/|e|, q = df/|f|:
///   tau'  = kb.(p + q)/2 + theta_f' - theta_e'.
/// The printed second derivatives of m_ref are the derivative of kb/(2|e|); that is not symmetric,
/// as carrying a frame round a loop turns it. The symmetric part is the Hessian: with m = (t +
/// s)/chi and sym(a, b) = (a b^T + b a^T)/2,
///   H_pp = -sym(t + m, kb)/2, H_qq = -sym(s + m, kb)/2, H_pq = ([m]x - sym(m, kb))/2.
/// out += weight * tau'' (increments).
void add_twist_curvature(double weight, const CurvatureBinormal& b, PairMatrix& out);

/// E = stiffness/2 (tau - tau_0)^2, `stiffness` = GJ/l (mJ), `excess` = tau - tau_0; in increments.
void add_twist(double stiffness, double excess, const CurvatureBinormal& b, PairEnergy& out);

/// Torsion between two edges that follow one another on a rod.
struct Torsion {
  static constexpr Term term = Term::twist;
  double stiffness = 0;  ///< GJ/l, mJ
  double rest = 0;       ///< tau_0, rad

  double excess(const PairGeometry& at) const { return at.twist() - rest; }
  double value(const PairGeometry& at) const { return 0.5 * stiffness * excess(at) * excess(at); }
  double add(const PairGeometry& at, PairEnergy& out) const;
};

}  // namespace gridshell
