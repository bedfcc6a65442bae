// Stretching of an edge, and bending of a round, straight rod between two edges.
#pragma once

#include <Eigen/Core>

#include "engine/core/block3.h"
#include "engine/elastic/element_energies.h"

namespace gridshell {

/// E = EA/2 (|e|/l - 1)^2 l of an edge vector e, with axial force N = dE/d|e| = EA (|e|/l - 1).
/// With the tangent t the Hessian is EA/l t t^T + N/|e| (I - t t^T): material and geometric
/// stiffness.
struct StretchEnergy {
  double value = 0;
  double force = 0;  ///< N, positive in tension
};

inline StretchEnergy stretch(double EA, double rest_length, double length) {
  const double strain = length / rest_length - 1;
  return {0.5 * EA * strain * strain * rest_length, EA * strain};
}

// Bending of a naturally straight isotropic rod at a node between two edges [Bergou 2008].

/// E = EI/(2l) |kb|^2 = (2EI/l) (1 - c)/(1 + c), c = t_e . t_f, with the curvature binormal
/// kb = 2 t_e x t_f / (1 + c) and l the mean natural length of the two edges. E grows without bound
/// as the edges fold onto one another (c -> -1).
/// `stiffness` is 2EI/l (mJ).
struct BendEnergy {
  double value = 0;
  Eigen::Vector3d gradient_e, gradient_f;     ///< with respect to the edge vectors e, f (N)
  Block3 hessian_ee, hessian_ef, hessian_ff;  ///< N/mm
};

inline double bend_value(double stiffness, const EdgeGeometry& e, const EdgeGeometry& f) {
  const double c = e.tangent.dot(f.tangent);
  return stiffness * (1 - c) / (1 + c);
}

/// Value and gradient only.
inline void bend_gradient(double stiffness, const EdgeGeometry& e, const EdgeGeometry& f,
                          BendEnergy& out) {
  const double c = e.tangent.dot(f.tangent), w = 1 / (1 + c);
  const double by_c = -2 * stiffness * w * w;
  out.value = stiffness * (1 - c) * w;
  out.gradient_e = (by_c / e.length) * (f.tangent - c * e.tangent);
  out.gradient_f = (by_c / f.length) * (e.tangent - c * f.tangent);
}

/// Value, gradient and Hessian. With p = dc/de = (t_f - c t_e)/|e|, q = dc/df:
/// H_ee = E'' p p^T - E'/|e| (p t_e^T + t_e p^T) - E' c/|e|^2 (I - t_e t_e^T),
/// H_ef = E'' p q^T + E'/(|e||f|) (I - t_e t_e^T)(I - t_f t_f^T).
inline void bend_hessian(double stiffness, const EdgeGeometry& e, const EdgeGeometry& f,
                         BendEnergy& out) {
  const Eigen::Vector3d& te = e.tangent;
  const Eigen::Vector3d& tf = f.tangent;
  const double c = te.dot(tf), w = 1 / (1 + c);
  const double by_c = -2 * stiffness * w * w, by_cc = 4 * stiffness * w * w * w;
  const double ie = 1 / e.length, jf = 1 / f.length;
  const Eigen::Vector3d p = (tf - c * te) * ie, q = (te - c * tf) * jf;
  out.value = stiffness * (1 - c) * w;
  out.gradient_e = by_c * p;
  out.gradient_f = by_c * q;

  // terms of rank one with a common factor are combined into one outer product
  Column along_p, along_q, along_e, along_f;
  load(p, along_p);
  load(q, along_q);
  load(te, along_e);
  load(tf, along_f);
  const double ce = by_c * c * ie * ie, cf = by_c * c * jf * jf, cross = by_c * ie * jf;
  out.hessian_ee = out.hessian_ef = out.hessian_ff = {};
  add_product(along_p, by_cc * p - (by_c * ie) * te, out.hessian_ee);
  add_product(along_e, ce * te - (by_c * ie) * p, out.hessian_ee);
  add_diagonal(-ce, out.hessian_ee);
  add_product(along_q, by_cc * q - (by_c * jf) * tf, out.hessian_ff);
  add_product(along_f, cf * tf - (by_c * jf) * q, out.hessian_ff);
  add_diagonal(-cf, out.hessian_ff);
  add_product(along_p, by_cc * q, out.hessian_ef);
  add_product(cross * (c * along_e - along_f), tf, out.hessian_ef);
  add_product(-cross * along_e, te, out.hessian_ef);
  add_diagonal(cross, out.hessian_ef);
}

}  // namespace gridshell
