// Sets that grow together.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace gridshell {

/// The numbers 0 to size - 1, each a set of its own until sets are joined [Galler, Fischer 1964].
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : of_(size) { std::iota(of_.begin(), of_.end(), 0); }

  /// The smallest number of the set that holds k: it names the set.
  int find(int k) {
    while (of_[std::size_t(k)] != k)
      k = of_[std::size_t(k)] = of_[std::size_t(of_[std::size_t(k)])];
    return k;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    of_[std::size_t(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> of_;
};

}  // namespace gridshell
