// Stretching of an edge.
#pragma once

namespace gridshell {

/// E = EA/2 (|e|/l - 1)^2 l, with axial force N = dE/d|e| = EA (|e|/l - 1). Along the tangent t the
/// Hessian is EA/l t t^T + N/|e| (I - t t^T): material and geometric stiffness.
struct StretchEnergy {
  double value = 0;
  double force = 0;  ///< N, positive in tension
};

inline StretchEnergy stretch(double EA, double rest_length, double length) {
  const double strain = length / rest_length - 1;
  return {0.5 * EA * strain * strain * rest_length, EA * strain};
}

}  // namespace gridshell
