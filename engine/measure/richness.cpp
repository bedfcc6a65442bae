#include "engine/measure/richness.h"

#include <cmath>

namespace gridshell {
namespace {

/// Variance of the estimate [Chao 1987, eq. 8; without f2 the bias-corrected form].
double variance(double f1, double f2, double estimate) {
  if (f2 > 0) {
    const double r = f1 / f2;
    return f2 * (r * r / 2 + r * r * r + r * r * r * r / 4);
  }
  return f1 * (f1 - 1) / 2 + f1 * (2 * f1 - 1) * (2 * f1 - 1) / 4 -
         f1 * f1 * f1 * f1 / (4 * estimate);
}

}  // namespace

Richness chao1(const std::vector<int>& counts) {
  Richness found;
  for (const int count : counts) {
    found.seen += count > 0;
    found.once += count == 1;
    found.twice += count == 2;
  }
  const double f1 = found.once, f2 = found.twice;
  const double unseen = f2 > 0 ? f1 * f1 / (2 * f2) : f1 * (f1 - 1) / 2;
  found.estimate = found.seen + unseen;
  found.low = found.high = found.seen;
  if (unseen <= 0) return found;
  const double spread =
      std::exp(1.96 * std::sqrt(std::log1p(variance(f1, f2, found.estimate) / (unseen * unseen))));
  found.low += unseen / spread;
  found.high += unseen * spread;
  return found;
}

}  // namespace gridshell
