// Direct factorisation of the Hessian of the free columns, with its inertia.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/team.h"
#include "engine/elastic/block_hessian.h"

namespace gridshell {

struct Model;

/// Number of negative pivots of H + shift I, and the sizes of its pivots, from a factorisation.
struct Inertia {
  int negative_pivots = 0;  ///< eigenvalues below zero, by Sylvester's law
  bool usable = false;      ///< false: a zero or non-finite pivot; nothing can be solved with it
  double smallest_pivot = 0, largest_pivot = 0;  ///< in absolute value

  bool positive_definite() const { return usable && negative_pivots == 0; }
  /// Takes one pivot into account.
  void take(double pivot) {
    const double size = pivot < 0 ? -pivot : pivot;
    if (!(size > 1e-300 && size < 1e300)) usable = false;
    negative_pivots += pivot < 0;
    smallest_pivot = size < smallest_pivot ? size : smallest_pivot;
    largest_pivot = size > largest_pivot ? size : largest_pivot;
  }
  Inertia& operator+=(const Inertia& other) {
    negative_pivots += other.negative_pivots;
    usable &= other.usable;
    smallest_pivot = std::min(smallest_pivot, other.smallest_pivot);
    largest_pivot = std::max(largest_pivot, other.largest_pivot);
    return *this;
  }
  static Inertia of_nothing() { return {0, true, 1e300, 0}; }
};

struct FactorNumbers;

/// A direct solver: its constructor does the symbolic analysis, factor() computes the numbers as
/// often as needed. Not thread-safe; one per thread.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Factorises the rows and columns of the free unknowns in `hessian` + `shift` I.
  virtual Inertia factor(const BlockHessian& hessian, double shift) = 0;

  /// Stops the factorisation when more pivots than this are negative: the factor cannot be used to
  /// solve then, and Inertia counts the pivots met so far. A solver may continue to the end.
  int most_negative = std::numeric_limits<int>::max();

  /// Threads for large matrices; results do not depend on their number.
  Team* team = nullptr;

  /// Memory of the factor's numbers, which several solvers may use in turn. Empty: own memory. A
  /// solver may have further memory of its own.
  std::shared_ptr<FactorNumbers> numbers;
  /// Whether the last factor still exists: another solver with the same memory may have overwritten
  /// it.
  virtual bool has_factor() const { return true; }

  /// Solves for right-hand sides at the free columns, in place; constrained components of the
  /// result are zero. It requires a usable factor() that still exists.
  virtual void solve(Eigen::Matrix3Xd& right_hand_side) const = 0;

  /// Frees the solver's memory; the next factor() allocates it again.
  virtual void free_memory() {}

  /// Number of 3x3 blocks in the factor.
  virtual long long blocks() const = 0;
};

/// Solver for a model's Hessians. It contains one solver for the model's pattern and one for the
/// pattern extended by blocks outside it (contact), which is planned again when a new block
/// appears. A plan takes as long as about three factorisations; it is rare, since blocks are
/// retained for edges that only come close. Low-rank corrections of a factor of the pattern would
/// need as many solves as there are contacts.
std::unique_ptr<LinearSolver> make_linear_solver(const Model& model);

/// 3x3-block signed Cholesky L S L^T on a fixed schedule, geometric nested dissection. With 192
/// rods, 4 and 8 edges per segment (613 000 and 1.3 million degrees of freedom), it takes a fourth
/// of the time and two thirds of the memory of make_cholmod(). It ignores blocks outside the
/// pattern and the matrix of rank one.
std::unique_ptr<LinearSolver> make_block_cholesky(const Model& model);

/// `block` at row `row` and column `column` of the model with the constrained rows and columns set
/// to zero, and one on the diagonal.
Eigen::Matrix3d without_fixed(const Model& model, int row, int column,
                              const Eigen::Matrix3d& block);

// Fill-reducing elimination order of the free columns.

/// Neighbours of each free column (by free index) in the Hessian's graph.
std::vector<std::vector<int>> hessian_graph(const Model& model);

/// Nested dissection by the columns' flat positions [George 1973]. Columns inside a segment are
/// eliminated first. Then the plane is cut again and again along u or v where the fewest columns
/// touch both sides; these are eliminated after both sides. Small pieces are ordered by minimum
/// degree. Returns order[k] = free index of the k-th column to eliminate. Deterministic.
std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph);

}  // namespace gridshell
