// The numbers of a 3x3-block factor L D L^T and their distribution over threads. In large shells,
// columns that do not depend on each other are factorised by different threads. The order of each
// block's sum is fixed, so the result is bitwise equal for any number of threads.
#pragma once

#include <vector>

#include "engine/core/block3.h"
#include "engine/core/team.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {

/// A node's part of a right-hand side. (std::vector<Column> would forget the alignment.)
struct alignas(32) Entry {
  Column value;
};
static_assert(alignof(Entry) == 32 && sizeof(Entry) == sizeof(Column));

constexpr int widest_panel = 8;  // columns; wider panels would not stay in the nearest cache

/// The numbers of the last factor of one or several solvers that use this memory in turn.
struct FactorNumbers {
  std::vector<Block3> diagonal, below;
  std::vector<Entry> inverse;  ///< inverses of the pivots
  const void* of = nullptr;    ///< the solver that computed them
};

/// Plan and numbers of one factor, in plain arrays for the loops over them. A panel is a set of
/// adjacent columns with the same rows below them.
struct BlockFactor {
  int columns = 0;
  std::vector<int> first;  // columns + 1: first off-diagonal block of each column
  std::vector<int> row;    // row of each off-diagonal block (in elimination order)
  std::vector<int> panel;  // first column of each panel, and columns
  // per pair (a <= b) of the rows below a panel: the block that it updates, or ~block if it is the
  // first to write it
  std::vector<int> target;
  std::vector<long long> first_target;  // per panel
  // first panel of each branch of the elimination tree, and of the trunk, which follows them
  std::vector<int> branch;
  std::vector<int> own_rows;    // per panel: rows below it in its own branch
  std::vector<int> crossing;    // panels of branches with rows in the trunk
  std::vector<double> work_to;  // columns + 1: work of updating the trunk up to each column
  Block3 *diagonal = nullptr, *below = nullptr;  // in FactorNumbers
  Entry* inverse = nullptr;

  int panels() const { return int(panel.size()) - 1; }
  int branches() const { return int(branch.size()) - 1; }
  int rows_below(int column) const {
    return first[std::size_t(column) + 1] - first[std::size_t(column)];
  }
  /// Number of rows below a panel, that is below its last column.
  int panel_rows(int p) const { return rows_below(panel[std::size_t(p) + 1] - 1); }
};

/// Assigns every column to a branch of the elimination tree; columns of the trunk have the number
/// after the last branch. Columns of different branches do not depend on each other. All zero if
/// the factor is too small for several threads.
std::vector<int> branches_of(const BlockFactor& factor);

/// Distributes the branches over threads. The panels must exist, and their columns must be in the
/// order of their branches, each panel within one branch.
void plan_sharing(BlockFactor& factor, const std::vector<int>& branch);

/// Replaces `diagonal` and `below` by L D L^T. Ends early as described at
/// LinearSolver::most_negative.
Inertia factor_numbers(BlockFactor& factor, int most_negative, Team* team);

/// Solves for the right-hand side x in place, in elimination order.
void solve_numbers(const BlockFactor& factor, Entry* x, Team* team);

}  // namespace gridshell
