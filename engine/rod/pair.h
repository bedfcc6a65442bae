// What energies of two edges share: their eight local unknowns and the curvature binormal with its
// derivatives.
#pragma once

#include <Eigen/Core>

#include "engine/rod/edge.h"

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

  PairEnergy& operator+=(const PairEnergy& other);
};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// (a b^T + b a^T)/2
Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// kb = 2 t x s/chi, chi = 1 + t.s of unit tangents t (of e) and s (of f).
struct CurvatureBinormal {
  Eigen::Vector3d t, s, kb;
  double chi = 2;
};

/// Its derivative by the increments p = de/|e|, q = df/|f|:
/// by_p = -(2 [s]x + kb s^T) (I - t t^T)/chi, by_q = (2 [t]x - kb t^T) (I - s s^T)/chi.
struct BinormalSlopes : CurvatureBinormal {
  Eigen::Matrix3d P, Q;  ///< I - t t^T, I - s s^T
  Eigen::Matrix3d by_p, by_q;
};

CurvatureBinormal curvature_binormal(const Eigen::Vector3d& t, const Eigen::Vector3d& s);

BinormalSlopes binormal_with_slopes(const Eigen::Vector3d& t, const Eigen::Vector3d& s);

/// From increments p, q to edge vectors: e counts 1/|e|, f counts 1/|f|.
void scale_to_edges(double length_e, double length_f, PairEnergy& out);

/// E(c), c = t.s, given E' and E'' (edge vectors, after scale_to_edges): bending of a round rod,
/// shear of a joint.
void add_cosine(double by_c, double by_cc, const EdgeGeometry& e, const EdgeGeometry& f,
                PairEnergy& out);

}  // namespace gridshell
