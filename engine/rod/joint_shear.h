// The resistance of a joint to shear.
#pragma once

#include <cmath>

#include "engine/rod/energies.h"
#include "engine/rod/pair.h"

namespace gridshell {

/// E = k/8 sum over the four pairs of edges at a joint of (angle - rest)^2, one pair each.
struct JointShear {
  static constexpr Term term = Term::shear;
  double stiffness = 0;  ///< k/4, N mm/rad
  double rest = M_PI / 2;

  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
};

}  // namespace gridshell
