#include "engine/rod/joint_shear.h"

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

double angle(const PairGeometry& at) {
  return std::acos(std::clamp(at.e.tangent.dot(at.f.tangent), -1.0, 1.0));
}

}  // namespace

double JointShear::value(const PairGeometry& at) const {
  const double beyond = angle(at) - rest;
  return 0.5 * stiffness * beyond * beyond;
}

double JointShear::add(const PairGeometry& at, PairEnergy& out) const {
  const double beyond = angle(at) - rest, c = at.e.tangent.dot(at.f.tangent),
               slope = 1 / std::sqrt(1 - c * c);
  add_cosine(-stiffness * beyond * slope, stiffness * slope * slope * (1 - beyond * c * slope),
             at.e, at.f, out);
  return 0.5 * stiffness * beyond * beyond;
}

}  // namespace gridshell
