// The spin of a rod at a joint that passes twist: its director beside the joint's normal.
#pragma once

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

namespace gridshell {

/// phi = theta_e - alpha - side pi/2, in (-pi, pi]: the angle about t from the joint's normal to
/// the rod's director m1. alpha is that of the other rod's tangent s in the reference frame d1, d2
/// of e; the normal is side * t x s, `side` +1 or -1.
double joint_spin(int side, double theta, const EdgeGeometry& e, const Eigen::Vector3d& director,
                  const EdgeGeometry& f);

/// E = stiffness/2 phi^2 (mJ): returns it and adds gradient and Hessian by edge vectors and angles.
/// With the complex director d = d1 + i d2 and z = d/(s.d), alpha = Im log(s.d), and d carried in
/// time d(t') = d - (d.t')/(1 + t.t') (t + t'),
///   (s.d)'/(s.d)  = z.Qq - c z.p,
///   (s.d)''/(s.d) = 2 [c (t.p)(z.p) - (s.q)(z.Qq) - (z.p)(t.Qq + s.Pp/2)] + a real part,
/// p = de/|e|, q = df/|f|.
double add_joint_spin(double stiffness, int side, double theta, const EdgeGeometry& e,
                      const Eigen::Vector3d& director, const EdgeGeometry& f, PairEnergy& out);

/// The joint's resistance to the spin of the first of two edges beside the normal: of four pairs of
/// edges at a joint each holds both rods, k/8 phi^2 a rod and pair, so that k is the joint's.
struct JointSpin {
  static constexpr Term term = Term::joint;
  double stiffness = 0;  ///< k/4, N mm/rad
  int side = 1;          ///< +1: the normal is t_e x t_f; -1: t_f x t_e

  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
};

}  // namespace gridshell
