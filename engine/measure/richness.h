// How many kinds there are, from how often those that were met were met.
#pragma once

#include <vector>

namespace gridshell {

/// An estimate with its interval of 95 %.
struct Richness {
  int seen = 0;  ///< kinds met at all
  int once = 0, twice = 0;
  double estimate = 0;  ///< of all there are that this way of looking can meet: a lower bound
  double low = 0, high = 0;
};

/// S + f1^2/(2 f2), f1 and f2 the kinds met once and twice; f1 (f1 - 1)/2 more where none was met
/// twice. The interval is that of a log-normal number of kinds unseen [Chao 1987].
Richness chao1(const std::vector<int>& counts);

}  // namespace gridshell
