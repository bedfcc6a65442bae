// Numbers drawn evenly, the same ones from the same generator on every machine: those of
// std::uniform_real_distribution differ from library to library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

namespace gridshell {

/// The next one in [-1, 1).
inline double symmetric_uniform(std::mt19937& random) {
  return double(random()) / double(1u << 31) - 1;
}

// Where a value lies among knots.

/// The k with knots[k] <= t < knots[k + 1], of knots that rise; the first piece below them all, the
/// last above.
template <class Knots>
std::size_t piece_at(const Knots& knots, double t) {
  return std::size_t(std::upper_bound(knots.begin() + 1, knots.end() - 1, t) - knots.begin()) - 1;
}

/// Sets `place` to `value` and, at the end of the scope, also by an exception, back to what it was.
template <class T>
class SetForScope {
 public:
  SetForScope(T& place, T value) : place_(place), before_(place) { place = value; }
  ~SetForScope() { place_ = before_; }
  SetForScope(const SetForScope&) = delete;
  SetForScope& operator=(const SetForScope&) = delete;

 private:
  T& place_;
  T before_;
};

// Sets that grow together.

/// The numbers 0 to size - 1, each a set of its own until sets are joined [Galler, Fischer 1964].
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : of_(size) { std::iota(of_.begin(), of_.end(), 0); }

  /// The smallest number of the set that contains k: it identifies the set.
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
