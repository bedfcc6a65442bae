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

/// What a factorisation found out about H + shift I.
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

/// Symbolic analysis once (constructor), numbers as often as needed. Not thread-safe; one per
/// thread.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Factorises the rows and columns of what is free of `hessian` + `shift` I.
  virtual Inertia factor(const BlockHessian& hessian, double shift) = 0;

  /// Stops the factorisation when more pivots than this are negative: the factor cannot be used to
  /// solve then, and Inertia counts the pivots met so far. A solver may continue to the end.
  int most_negative = std::numeric_limits<int>::max();

  /// Threads for large matrices; results do not depend on their number.
  Team* team = nullptr;

  /// Memory of the factor's numbers; solvers that share it take turns. Empty: own memory. A solver
  /// may have further memory of its own.
  std::shared_ptr<FactorNumbers> numbers;
  /// Whether the last factor still exists; a solver that shares the memory may have overwritten it.
  virtual bool has_factor() const { return true; }

  /// Solves for right-hand sides at the free columns, in place; constrained components of the
  /// result are zero. It requires a usable factor() that still exists.
  virtual void solve(Eigen::Matrix3Xd& right_hand_side) const = 0;

  /// Gives back the memory that it has of its own; the next factor() takes it again.
  virtual void free_memory() {}

  /// 3x3 blocks in the factor.
  virtual long long blocks() const = 0;
};

/// Solver for a model's Hessians: one for its pattern, and one for the pattern with the blocks
/// outside it, which is planned again when a new block appears. A plan takes about three
/// factorisations; it is rare, since blocks are retained for edges that only come close. Low-rank
/// corrections of a factor of the pattern would need as many solves as there are contacts.
std::unique_ptr<LinearSolver> make_linear_solver(const Model& model);

/// 3x3-block signed Cholesky L S L^T on a fixed schedule, geometric nested dissection. With 192
/// rods, 4 and 8 edges per segment (613 000 and 1.3 million degrees of freedom), it takes a fourth
/// of the time and two thirds of the memory of the solver below. It does not support blocks outside
/// the pattern.
std::unique_ptr<LinearSolver> make_block_cholesky(const Model& model);

/// How CHOLMOD factorises, and in which order.
struct CholmodOptions {
  bool supernodal =
      true;  ///< L L^T; where that fails, simplicial L D L^T counts the negative pivots
  bool own_ordering =
      true;  ///< nested_dissection(); false: CHOLMOD's own nested dissection (METIS)
};

/// CHOLMOD [Chen, Davis, Hager, Rajamanickam 2008]: what ours is measured against.
std::unique_ptr<LinearSolver> make_cholmod(const Model& model, const CholmodOptions& options = {});

/// `block` at row `row` and column `column` of the model with the constrained rows and columns set
/// to zero, and one on the diagonal.
Eigen::Matrix3d without_held(const Model& model, int row, int column, const Eigen::Matrix3d& block);

// Fill-reducing elimination order of the free columns.

/// Neighbours of each free column (by free index) in the Hessian's graph.
std::vector<std::vector<int>> hessian_graph(const Model& model);

/// Nested dissection by the columns' flat positions [George 1973]: what lies inside a segment goes
/// first, then the plane is cut again and again along u or v where fewest columns touch both sides;
/// those come last. Small pieces are ordered by minimum degree. Returns order[k] = free index of
/// the k-th column to eliminate. Deterministic.
std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph);

}  // namespace gridshell
