// Small algorithms. Uniform random numbers that are equal on every machine for the same generator;
// those of std::uniform_real_distribution differ between libraries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

namespace gridshell {

/// Richardson extrapolation of a quantity whose error is of second order, from a mesh and one with
/// edges twice as long: (4 fine - coarse)/3 [Richardson 1911].
template <class Value>
Value richardson(const Value& fine, const Value& coarse) {
  return (4 * fine - coarse) / 3;
}

/// The next uniform random number in [-1, 1).
inline double symmetric_uniform(std::mt19937& random) {
  return double(random()) / double(1u << 31) - 1;
}

// Search in knots.

/// The k with knots[k] <= t < knots[k + 1], for at least two ascending knots; the first piece if t
/// is below all of them, the last if it is above.
template <class Knots>
std::size_t piece_at(const Knots& knots, double t) {
  return std::size_t(std::upper_bound(knots.begin() + 1, knots.end() - 1, t) - knots.begin()) - 1;
}

/// Sets a variable to `value` and, at the end of the scope, also after an exception, to its
/// previous value.
template <class T>
class SetForScope {
 public:
  SetForScope(T& variable, T value) : variable_(variable), before_(variable) { variable = value; }
  ~SetForScope() { variable_ = before_; }
  SetForScope(const SetForScope&) = delete;
  SetForScope& operator=(const SetForScope&) = delete;

 private:
  T& variable_;
  T before_;
};

// Points of rods.

/// Number of rods that pass through a point, and of rods that end at it.
struct PointUse {
  int passes = 0, ends = 0;
};

/// The use of each of `points` points. A rod is a list of points; a ring, which ends with its first
/// one, passes through it.
inline std::vector<PointUse> uses_of(std::size_t points,
                                     const std::vector<std::vector<int>>& rods) {
  std::vector<PointUse> uses(points);
  for (const std::vector<int>& rod : rods) {
    for (std::size_t k = 1; k + 1 < rod.size(); ++k) ++uses[std::size_t(rod[k])].passes;
    if (rod.front() == rod.back())
      ++uses[std::size_t(rod.front())].passes;
    else
      for (const int end : {rod.front(), rod.back()}) ++uses[std::size_t(end)].ends;
  }
  return uses;
}

// Disjoint sets.

/// The numbers 0 to size - 1 in disjoint sets, at first one each [Galler, Fischer 1964].
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : of_(size) { std::iota(of_.begin(), of_.end(), 0); }

  /// The smallest number of the set that contains k: it identifies the set.
  int find(int k) {
    while (of_[std::size_t(k)] != k)
      k = of_[std::size_t(k)] = of_[std::size_t(of_[std::size_t(k)])];
    return k;
  }
  /// Joins the sets of a and b.
  void join(int a, int b) {
    a = find(a), b = find(b);
    of_[std::size_t(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> of_;
};

}  // namespace gridshell
