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

/// Symbolic analysis once (constructor), numbers as often as needed. Not thread-safe; one a thread.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Factorises the rows and columns of what is free of `hessian` + `shift` I.
  virtual Inertia factor(const BlockHessian& hessian, double shift) = 0;

  /// Factorises no further once more pivots than this are negative: nothing can be solved with it
  /// then, and Inertia counts those met so far. A solver may go on to the end.
  int most_negative = std::numeric_limits<int>::max();

  /// Who helps where a matrix is large; results do not hang on it.
  Team* team = nullptr;

  /// Where the numbers of its factor stand; solvers that share it take turns. Empty: its own. A
  /// solver may have memory of its own beside it.
  std::shared_ptr<FactorNumbers> numbers;
  /// Whether what was factorised last is still there: another one may have taken its place.
  virtual bool has_factor() const { return true; }

  /// Solves for the right-hand sides at the free columns, in place; what is held comes back as
  /// zero. Needs a factor() that was usable and is there.
  virtual void solve(Eigen::Matrix3Xd& right_hand_side) const = 0;

  /// Gives back the memory that it has of its own; the next factor() takes it again.
  virtual void free_memory() {}

  /// 3x3 blocks in the factor.
  virtual long long blocks() const = 0;
};

/// What a model's Hessians are solved with: a pattern solver, and another one for the pattern with
/// the blocks beyond it, which is planned anew when one of them is new: a plan takes some three
/// factorisations, and as blocks are kept for edges that only come near it is rare. A factor of the
/// pattern corrected by low rank would need as many solves as there are contacts.
std::unique_ptr<LinearSolver> make_linear_solver(const Model& model);

/// 3x3-block signed Cholesky L S L^T on a fixed schedule, geometric nested dissection: of 192 rods,
/// 4 and 8 edges a segment (613 000 and 1.3 million degrees of freedom), it takes a fourth of the
/// time of the one below and two thirds of its memory. Blocks beyond the pattern are not seen.
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

/// Rows and columns of `block`, whose row is column `row` of the model and whose column is
/// `column`, that are held: zero, and one on the diagonal.
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
