// The legs of a circle of n rods a direction as the paper counts them, of d [Baek 2018, 'Elastic
// Gridshells with Circular Boundaries'].
#pragma once

#include <algorithm>
#include <cmath>

namespace gridshell::record {

/// L_d = R_o/d - (n - 1)/2: from the outermost rod to the boundary, on an axis.
inline double longest_leg(double radius_over_d, int rods) {
  return radius_over_d - 0.5 * (rods - 1);
}

/// l_d = sqrt((R_o/d)^2 - ((n - 1)/2)^2) - (n - 1)/2: from the corner of the grid along the
/// outermost rod; below 0 where the corner lies outside of the boundary.
inline double shortest_leg(double radius_over_d, int rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::sqrt(std::max(0.0, radius_over_d * radius_over_d - outermost * outermost)) -
         outermost;
}

/// The L_d at which the shortest leg is `leg`: what shortest_leg() inverts.
inline double longest_leg_at(double leg, double rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::hypot(leg + outermost, outermost) - outermost;
}

}  // namespace gridshell::record
