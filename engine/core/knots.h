// Where a value lies among knots.
#pragma once

#include <algorithm>
#include <cstddef>

namespace gridshell {

/// The k with knots[k] <= t < knots[k + 1], of knots that rise; the first piece below them all, the
/// last above.
template <class Knots>
std::size_t piece_at(const Knots& knots, double t) {
  return std::size_t(std::upper_bound(knots.begin() + 1, knots.end() - 1, t) - knots.begin()) - 1;
}

}  // namespace gridshell
