// The resistance of a joint to shear.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

namespace gridshell {

/// E = k/8 sum over the four pairs of edges at a joint of (angle - rest)^2, one pair each.
struct JointShear {
  static constexpr Term term = Term::shear;
  double stiffness = 0;  ///< k/4, N mm/rad
  double rest = M_PI / 2;

  double value(const PairGeometry& at) const {
    const double beyond = angle(at) - rest;
    return 0.5 * stiffness * beyond * beyond;
  }
  double add(const PairGeometry& at, PairEnergy& out) const {
    const double beyond = angle(at) - rest, c = at.e.tangent.dot(at.f.tangent),
                 slope = 1 / std::sqrt(1 - c * c);
    add_cosine(-stiffness * beyond * slope, stiffness * slope * slope * (1 - beyond * c * slope),
               at.e, at.f, out);
    return 0.5 * stiffness * beyond * beyond;
  }

 private:
  static double angle(const PairGeometry& at) {
    return std::acos(std::clamp(at.e.tangent.dot(at.f.tangent), -1.0, 1.0));
  }
};

}  // namespace gridshell
