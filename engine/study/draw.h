// Values drawn at random, the same ones from the same generator on every machine: not by the
// library's distributions, which differ from one to another.
#pragma once

#include <algorithm>
#include <random>

namespace gridshell::study {

class Draw {
 public:
  explicit Draw(std::mt19937& random) : random_(random) {}
  double between(double low, double high) {
    return low + (high - low) * double(random_() >> 5) / double(1 << 27);
  }
  /// From `low` to `high`, both among them.
  int integer(int low, int high) { return std::min(int(between(low, high + 1)), high); }
  bool once_in(int n) { return integer(1, n) == 1; }

 private:
  std::mt19937& random_;
};

}  // namespace gridshell::study
