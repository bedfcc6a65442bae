#include "engine/record/summary.h"

#include <algorithm>

namespace gridshell::record {

void Summary::take_state(const Frame& last) {
  negative_pivots = std::max(last.negative_pivots, 0);
  stable = last.negative_pivots == 0;
  residual_N = last.residual_N;
  error_estimate_mm = last.error_estimate_mm;
  energies = last.energies;
  height_mm = last.height_mm;
  total_K = last.total_K;
}

}  // namespace gridshell::record
