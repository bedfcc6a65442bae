// Cross-section and material of a rod.
#pragma once

#include <cmath>

namespace gridshell {

/// Stiffness of a round, naturally straight rod: EA (N) and EI (N mm^2).
struct RodSection {
  double EA = 0;
  double EI = 0;
};

/// A solid circular section of diameter D (mm) and Young's modulus E (GPa):
/// EA = E pi D^2/4, EI = E pi D^4/64.
inline RodSection circular_section(double diameter_mm, double young_GPa) {
  const double young_MPa = 1e3 * young_GPa;
  const double area = M_PI * diameter_mm * diameter_mm / 4;
  return {young_MPa * area, young_MPa * area * diameter_mm * diameter_mm / 16};
}

}  // namespace gridshell
