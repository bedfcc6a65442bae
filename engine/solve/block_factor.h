// The numbers of a 3x3-block factor L D L^T, and who works on them: where a shell is large, columns
// that wait for none of one another go to different threads, and the rest follows. Each block's sum
// has one order, whoever works, so that any number of threads gives the same bits.
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

constexpr int widest_panel = 8;  // columns; wider ones would not stay in the nearest cache

/// The numbers of factors that take turns: those of the last one.
struct FactorNumbers {
  std::vector<Block3> diagonal, below;
  std::vector<Entry> inverse;  ///< of the pivots
  const void* of = nullptr;    ///< the solver whose they are
};

/// The plan and the numbers of one factor; plain arrays for the loops over them. Panels: columns
/// beside one another that have the same rows below them.
struct BlockFactor {
  int columns = 0;
  std::vector<int> first;  // columns + 1: first off-diagonal block of each column
  std::vector<int> row;    // its row (in elimination order)
  std::vector<int> panel;  // first column of each, and columns
  // per pair (a <= b) of the rows below a panel: block that it updates, or ~block where nothing
  // stands there before
  std::vector<int> target;
  std::vector<long long> first_target;  // per panel
  // branches of the elimination tree: first panel of each, and of the trunk, which comes after them
  std::vector<int> branch;
  std::vector<int> own_rows;    // per panel: rows below it in its own branch
  std::vector<int> crossing;    // panels of branches with rows in the trunk
  std::vector<double> work_to;  // columns + 1: of their updates, up to each of the trunk
  Block3 *diagonal = nullptr, *below = nullptr;  // FactorNumbers'
  Entry* inverse = nullptr;

  int panels() const { return int(panel.size()) - 1; }
  int branches() const { return int(branch.size()) - 1; }
  int rows_below(int column) const {
    return first[std::size_t(column) + 1] - first[std::size_t(column)];
  }
  /// Of the columns of a panel and of its last one.
  int panel_rows(int p) const { return rows_below(panel[std::size_t(p) + 1] - 1); }
};

/// The branch of every column, from its structure, and of the trunk's columns the number after the
/// last branch. Columns of a branch wait for no other's. All zero for a small factor, which no
/// thread would help with.
std::vector<int> branches_of(const BlockFactor& factor);

/// Plans who does what for these branches, once the panels are there, whose columns stand in the
/// order of their branches, each panel in one of them.
void plan_sharing(BlockFactor& factor, const std::vector<int>& branch);

/// L D L^T in place of what stands in `diagonal` and `below`. Ends early as
/// LinearSolver::most_negative says.
Inertia factor_numbers(BlockFactor& factor, int most_negative, Team* team);

/// Solves for the right-hand side x in place, in elimination order.
void solve_numbers(const BlockFactor& factor, Entry* x, Team* team);

}  // namespace gridshell
