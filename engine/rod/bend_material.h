// Bending of a rod with principal axes and a curvature at rest, at a node between two edges.
#pragma once

#include "engine/rod/twist.h"

namespace gridshell {

/// E = 1/2 (w - w_0)^T diag(EI1, EI2)/l (w - w_0), w the curvature binormal's components in the
/// material frame half way between those of e and f: e's frame turned by half the twist,
///   w_1 + i w_2 = kb.(m1 + i m2)_e exp(-i tau/2).
/// [Bergou 2008] averages the energies of both frames, [Bergou 2010] the frames; the frame half way
/// keeps a round rod's energy free of its twist, whatever that is, and lets a rod with curvature
/// and twist at rest be a helix without energy.
struct MaterialBend {
  Eigen::Vector2d stiffness;  ///< EI1/l, EI2/l (mJ)
  Eigen::Vector2d rest;       ///< w_0 = l * curvature at rest
};

/// mu: columns m1, m2 of e turned by half the twist, in 3D.
using HalfwayFrame = Eigen::Matrix<double, 3, 2>;

/// The frame half way: e's reference director turned by angle + tau/2 about e's tangent.
inline HalfwayFrame halfway_frame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& director,
                                  double angle) {
  const Eigen::Vector3d across = tangent.cross(director);
  const double c = std::cos(angle), s = std::sin(angle);
  HalfwayFrame frame;
  frame << c * director + s * across, c * across - s * director;
  return frame;
}

inline double material_bend_value(const MaterialBend& bend, const Eigen::Vector2d& w) {
  return 0.5 * (bend.stiffness.array() * (w - bend.rest).array().square()).sum();
}

/// Y.kb'' for a fixed Y normal to t, as a symmetric matrix (increments), added to `out`.
inline void add_binormal_curvature(const Eigen::Vector3d& Y, const CurvatureBinormal& b,
                                   PairMatrix& out) {
  const double k = Y.dot(b.kb), i = 1 / b.chi;
  const Eigen::Vector3d yp = b.by_p.transpose() * Y, yq = b.by_q.transpose() * Y;
  const Eigen::Vector3d hp = b.P * b.s, hq = b.Q * b.t;  // slopes of chi
  const Eigen::Vector3d wp = b.P * (2 * k * b.s - 4 * b.s.cross(Y)) * i;
  const Eigen::Vector3d wq = b.Q * (2 * k * b.t - 4 * Y.cross(b.t)) * i;
  out.block<3, 3>(0, 0) +=
      -k * i * b.P + symmetric_product(b.t, wp) - 2 * i * symmetric_product(yp, hp);
  out.block<3, 3>(3, 3) +=
      -k * i * b.Q + symmetric_product(b.s, wq) - 2 * i * symmetric_product(yq, hq);
  const Eigen::Matrix3d pq =
      -i * (b.P * (2 * cross_matrix(Y) + k * Eigen::Matrix3d::Identity()) * b.Q +
            yp * hq.transpose() + hp * yq.transpose());
  out.block<3, 3>(0, 3) += pq;
  out.block<3, 3>(3, 0) += pq.transpose();
}

/// Adds gradient and Hessian in increments; returns the value. With phi' = theta_e' + tau'/2,
///   w'  = mu.kb' - i phi' w,
///   w'' = mu.kb'' + (mu.p)(kb.p) - 2i phi' mu.kb' - i phi'' w - phi'^2 w.
inline double add_material_bend(const MaterialBend& bend, const HalfwayFrame& mu,
                                const CurvatureBinormal& b, PairEnergy& out) {
  const Eigen::Vector2d w = mu.transpose() * b.kb;
  const Eigen::Vector2d g = bend.stiffness.array() * (w - bend.rest).array();
  PairVector phi;
  phi << 0.25 * b.kb, 0.25 * b.kb, 0.5, 0.5;
  Eigen::Matrix<double, 8, 2> along = Eigen::Matrix<double, 8, 2>::Zero();  // mu.kb'
  along.topRows<3>() = b.by_p.transpose() * mu;
  along.middleRows<3>(3) = b.by_q.transpose() * mu;
  Eigen::Matrix<double, 8, 2> slope = along;
  slope.col(0) += w[1] * phi;
  slope.col(1) -= w[0] * phi;
  out.gradient += slope * g;
  out.hessian.noalias() += slope * bend.stiffness.asDiagonal() * slope.transpose();

  // the second derivatives of w, weighted by g
  const Eigen::Vector3d Y = mu * g;
  add_binormal_curvature(Y, b, out.hessian);
  out.hessian.block<3, 3>(0, 0) += symmetric_product(Y, b.kb);
  const PairVector across = g[0] * along.col(1) - g[1] * along.col(0);
  out.hessian += phi * across.transpose() + across * phi.transpose();
  out.hessian -= g.dot(w) * phi * phi.transpose();
  add_twist_curvature(0.5 * (g[0] * w[1] - g[1] * w[0]), b, out.hessian);
  return material_bend_value(bend, w);
}

/// Bending of a section with axes, or of a rod curved at rest, between two edges that follow one
/// another.
struct SectionBending {
  static constexpr Term term = Term::bend;
  MaterialBend bend;

  double value(const PairGeometry& at) const {
    return material_bend_value(
        bend, frame(at).transpose() * curvature_binormal(at.e.tangent, at.f.tangent));
  }
  double add(const PairGeometry& at, PairEnergy& out) const {
    PairEnergy here;
    const double value = add_material_bend(
        bend, frame(at), binormal_with_derivatives(at.e.tangent, at.f.tangent), here);
    scale_to_edges(at.e.length, at.f.length, here);
    out += here;
    return value;
  }

 private:
  static HalfwayFrame frame(const PairGeometry& at) {
    return halfway_frame(at.e.tangent, at.director_e, at.angle_e + at.twist() / 2);
  }
};

}  // namespace gridshell
