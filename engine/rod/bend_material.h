// Bending of a rod with principal axes and a curvature at rest, at a node between two edges.
#pragma once

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

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
HalfwayFrame halfway_frame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& director,
                           double angle);

double material_bend_value(const MaterialBend& bend, const Eigen::Vector2d& w);

/// Y.kb'' for a fixed Y normal to t, as a symmetric matrix (increments), added to `out`.
void add_binormal_curvature(const Eigen::Vector3d& Y, const BinormalSlopes& b, PairMatrix& out);

/// Adds gradient and Hessian in increments; returns the value. With phi' = theta_e' + tau'/2,
///   w'  = mu.kb' - i phi' w,
///   w'' = mu.kb'' + (mu.p)(kb.p) - 2i phi' mu.kb' - i phi'' w - phi'^2 w.
double add_material_bend(const MaterialBend& bend, const HalfwayFrame& mu, const BinormalSlopes& b,
                         PairEnergy& out);

/// Bending of a section with axes, or of a rod curved at rest, between two edges that follow one
/// another.
struct SectionBending {
  static constexpr Term term = Term::bend;
  MaterialBend bend;

  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
};

}  // namespace gridshell
