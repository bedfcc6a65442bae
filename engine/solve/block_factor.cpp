// [supernodes: Ng, Peyton 1993]. A panel is finished, then subtracts its outer product from the
// columns right of it (right-looking), each target read and written once per panel.
#include "engine/solve/block_factor.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace gridshell {
namespace {

/// Factorises a diagonal block into L D L^T in place: L below the diagonal, whose ones are not
/// stored, D on it. Returns false for an unusable pivot. Only the inverses of pivots are divisions:
/// divisions are slow, and each column depends on the one before.
inline bool factor_diagonal(Block3& m, Column& inverse, Inertia& inertia) {
  Column* d = m.column;
  inverse[0] = 1 / d[0][0];
  const double l10 = d[0][1] * inverse[0], l20 = d[0][2] * inverse[0];
  d[1][1] -= l10 * d[0][1];
  const double c21 = d[1][2] - l20 * d[0][1];
  inverse[1] = 1 / d[1][1];
  const double l21 = c21 * inverse[1];
  d[2][2] -= l20 * d[0][2] + l21 * c21;
  inverse[2] = 1 / d[2][2];
  d[0][1] = l10;
  d[0][2] = l20;
  d[1][2] = l21;
  for (int k = 0; k < 3; ++k) inertia.take(d[k][k]);
  return inertia.usable;
}

/// Computes column k of L after all updates to it.
inline bool finish_column(BlockFactor& f, int k, Inertia& inertia) {
  const Column* d = f.diagonal[k].column;
  const Column& inverse = f.inverse[k].value;
  if (!factor_diagonal(f.diagonal[k], f.inverse[k].value, inertia)) return false;
  const double l10 = d[0][1], l20 = d[0][2], l21 = d[1][2];
  for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
    Column* b = f.below[i].column;
    b[1] -= l10 * b[0];
    b[2] -= l20 * b[0] + l21 * b[1];
    for (int j = 0; j < 3; ++j) b[j] *= inverse[j];
  }
  return true;
}

/// L_a D of one block of column k, by entries.
struct Scaled {
  double entry[3][3];
  inline void take(const BlockFactor& f, int k, const Block3& la) {
    const Column* d = f.diagonal[k].column;
    for (int i = 0; i < 3; ++i) {
      const Column m = la.column[i] * d[i][i];
      for (int j = 0; j < 3; ++j) entry[i][j] = m[j];
    }
  }
};

/// target -= L_b D L_a^T; if `begins`, target = -L_b D L_a^T.
template <bool begins = false>
inline void subtract(const Block3& lb, const Scaled& la, Block3& target) {
  for (int j = 0; j < 3; ++j) {
    const Column product = lb.column[0] * la.entry[0][j] + lb.column[1] * la.entry[1][j] +
                           lb.column[2] * la.entry[2][j];
    target.column[j] = begins ? -product : target.column[j] - product;
  }
}

/// Subtracts the outer products of `tile` targets and the columns of a panel, whose blocks are at
/// lb[column][0 ...].
template <int tile>
inline void subtract_panel(const Block3* const* lb, const Scaled* la, int width, const int* target,
                           Block3* below) {
  Column sum[tile][3];
  for (int t = 0; t < tile; ++t)
    for (int j = 0; j < 3; ++j) sum[t][j] = below[target[t]].column[j];
  for (int c = 0; c < width; ++c)
    for (int i = 0; i < 3; ++i)
      for (int t = 0; t < tile; ++t)
        for (int j = 0; j < 3; ++j) sum[t][j] -= lb[c][t].column[i] * la[c].entry[i][j];
  for (int t = 0; t < tile; ++t)
    for (int j = 0; j < 3; ++j) below[target[t]].column[j] = sum[t][j];
}

/// Subtracts a column's outer product from the remaining columns of its panel, which ends before
/// `end`.
inline void update_within(BlockFactor& f, int k, int end) {
  Scaled la;
  for (int a = k + 1; a < end; ++a) {
    const Block3* lb = &f.below[f.first[k] + a - k - 1];
    la.take(f, k, *lb);
    subtract(*lb, la, f.diagonal[a]);
    const int rows = f.first[a + 1] - f.first[a];
    for (int i = 0; i < rows; ++i) subtract(lb[1 + i], la, f.below[f.first[a] + i]);
  }
}

/// Rows `from` to `to` below a panel, counted from its first.
struct Rows {
  int from, to;
};

/// Number of targets before those of row `a` of `rows`.
inline long long targets_before(int a, int rows) {
  return (long long)a * rows - (long long)a * (a - 1) / 2;
}

/// Subtracts the outer product of a panel of one column, from the columns of some of its rows.
inline void update_narrow(BlockFactor& f, int k, const Rows& some, const int* target) {
  Scaled la;
  for (int a = f.first[k] + some.from; a < f.first[k] + some.to; ++a) {
    la.take(f, k, f.below[a]);
    subtract(f.below[a], la, f.diagonal[*target++]);
    for (int b = a + 1; b < f.first[k + 1]; ++b) {
      const int to = *target++;
      if (to < 0)
        subtract<true>(f.below[b], la, f.below[~to]);
      else
        subtract(f.below[b], la, f.below[to]);
    }
  }
}

/// Subtracts the outer products of the panel of columns `begin` to `end`.
inline void update_wide(BlockFactor& f, int begin, int end, const Rows& some, const int* target) {
  const int width = end - begin, rows = f.first[end] - f.first[end - 1];
  const Block3* lb[widest_panel];
  Scaled la[widest_panel];
  for (int a = some.from; a < some.to; ++a) {
    for (int c = 0; c < width; ++c) {
      lb[c] = &f.below[f.first[begin + c + 1] - rows + a];
      la[c].take(f, begin + c, *lb[c]);
    }
    const auto next = [&](int tile) {
      target += tile;
      for (int c = 0; c < width; ++c) lb[c] += tile;
    };
    subtract_panel<1>(lb, la, width, target, f.diagonal);
    next(1);
    int left = rows - a - 1;
    for (; left >= 3; left -= 3, next(3)) subtract_panel<3>(lb, la, width, target, f.below);
    for (; left > 0; --left, next(1)) subtract_panel<1>(lb, la, width, target, f.below);
  }
}

inline void update(BlockFactor& f, int p, const Rows& some) {
  const int begin = f.panel[p], end = f.panel[p + 1];
  const int rows = f.first[end] - f.first[end - 1];
  const int* target = f.target.data() + f.first_target[p] + targets_before(some.from, rows);
  if (end - begin == 1)
    update_narrow(f, begin, some, target);
  else
    update_wide(f, begin, end, some, target);
}

inline bool finish_panel(BlockFactor& f, int p, int most_negative, Inertia& inertia) {
  const int end = f.panel[p + 1];
  for (int k = f.panel[p]; k < end; ++k) {
    if (!finish_column(f, k, inertia) || inertia.negative_pivots > most_negative) return false;
    update_within(f, k, end);
  }
  return true;
}

GRIDSHELL_CLONES
bool finish_one(BlockFactor& f, int p, int most_negative, Inertia& inertia) {
  return finish_panel(f, p, most_negative, inertia);
}

GRIDSHELL_CLONES
void update_some(BlockFactor& f, int p, const Rows& some) { update(f, p, some); }

/// Factorises panels `from` to `to`; with `own` they update their own branch only, not the trunk.
GRIDSHELL_CLONES
void factor_panels(BlockFactor& f, int from, int to, bool own, int most_negative,
                   Inertia& inertia) {
  for (int p = from; p < to; ++p) {
    if (!finish_panel(f, p, most_negative, inertia)) return;
    const int end = f.panel[p + 1];
    update(f, p, {0, own ? f.own_rows[p] : f.first[end] - f.first[end - 1]});
  }
}

/// Rows of a block column from `begin` to `end` that are columns `from` to `to`, by their indices.
inline Rows rows_between(const BlockFactor& f, int begin, int end, const Rows& columns) {
  const auto row = f.row.begin();
  const auto first = std::lower_bound(row + begin, row + end, columns.from),
             last = std::lower_bound(first, row + end, columns.to);
  return {int(first - row), int(last - row)};
}

/// Subtracts the updates of all branches from columns of the trunk.
GRIDSHELL_CLONES
void update_trunk(BlockFactor& f, const Rows& columns) {
  for (int p : f.crossing) {
    const int last = f.panel[p + 1] - 1, first = f.first[last];
    const auto [from, to] = rows_between(f, first + f.own_rows[p], f.first[last + 1], columns);
    if (from < to) update(f, p, {from - first, to - first});
  }
}

/// Subtracts from `x` the products of blocks `from` to `to` of a column with `value`, the column's
/// part of the right-hand side.
inline void subtract_blocks(const BlockFactor& f, int from, int to, const Column& value, Entry* x) {
  for (int i = from; i < to; ++i) {
    const Column* b = f.below[i].column;
    x[f.row[i]].value -= b[0] * value[0] + b[1] * value[1] + b[2] * value[2];
  }
}

GRIDSHELL_CLONES
void forward(const BlockFactor& f, int from, int to, bool own, Entry* x) {
  for (int p = from; p < to; ++p) {
    const int end = f.panel[p + 1];
    for (int k = f.panel[p]; k < end; ++k) {
      const Column* d = f.diagonal[k].column;
      Column& v = x[k].value;
      v[1] -= d[0][1] * v[0];
      v[2] -= d[0][2] * v[0] + d[1][2] * v[1];
      const Column value = v;
      const int last = own ? f.first[k] + end - 1 - k + f.own_rows[p] : f.first[k + 1];
      subtract_blocks(f, f.first[k], last, value, x);
    }
  }
}

GRIDSHELL_CLONES
void forward_to_trunk(const BlockFactor& f, const Rows& columns, Entry* x) {
  for (int p : f.crossing) {
    const int end = f.panel[p + 1], rows = f.first[end] - f.first[end - 1];
    const auto [from, to] =
        rows_between(f, f.first[end] - rows + f.own_rows[p], f.first[end], columns);
    for (int k = f.panel[p]; from < to && k < end; ++k) {
      const Column value = x[k].value;
      const int shift = f.first[k + 1] - f.first[end];
      subtract_blocks(f, from + shift, to + shift, value, x);
    }
  }
}

GRIDSHELL_CLONES
void backward(const BlockFactor& f, int from, int to, Entry* x) {
  for (int k = f.panel[to] - 1; k >= f.panel[from]; --k) {
    const Column* d = f.diagonal[k].column;
    Column sum[3] = {};
    for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
      const Column* b = f.below[i].column;
      for (int j = 0; j < 3; ++j) sum[j] += b[j] * x[f.row[i]].value;
    }
    Column& v = x[k].value;
    v *= f.inverse[k].value;
    for (int j = 0; j < 3; ++j) v[j] -= sum[j][0] + sum[j][1] + sum[j][2];
    v[1] -= d[1][2] * v[2];
    v[0] -= d[0][1] * v[1] + d[0][2] * v[2];
  }
}

/// Calls do_columns({from, to}) on several threads for the trunk's columns, in pieces of even work.
void share_trunk(const BlockFactor& f, Team& team,
                 const std::function<void(const Rows&)>& do_columns) {
  const int pieces = 2 * team.threads();
  const auto cut = [&](int k) {
    if (k == pieces) return f.columns;
    const auto at = std::ranges::lower_bound(f.work_to, f.work_to.back() * k / pieces);
    return int(at - f.work_to.begin());
  };
  team.run(pieces, [&](int k) { do_columns({cut(k), cut(k + 1)}); });
}

/// Subtracts the updates of a panel, on several threads if there are enough: each has other target
/// columns.
void update_shared(BlockFactor& f, int p, Team& team) {
  constexpr long long worth_sharing = 4000;  // products of blocks, some 30 microseconds
  const int rows = f.panel_rows(p), width = f.panel[std::size_t(p) + 1] - f.panel[std::size_t(p)];
  if (width * targets_before(rows, rows) < worth_sharing) return update_some(f, p, {0, rows});
  const int pieces = 2 * team.threads();
  // the first rows have the most targets
  const auto cut = [&](int k) {
    return k == pieces ? rows : int(rows * (1 - std::sqrt(1 - double(k) / pieces)));
  };
  team.run(pieces, [&](int k) { update_some(f, p, {cut(k), cut(k + 1)}); });
}

}  // namespace

Inertia factor_numbers(BlockFactor& f, int most_negative, Team* team) {
  Inertia inertia = Inertia::of_nothing();
  const auto ended = [&] { return !inertia.usable || inertia.negative_pivots > most_negative; };
  if (!team || f.branches() == 0) {
    factor_panels(f, 0, f.panels(), false, most_negative, inertia);
  } else {
    std::vector<Inertia> of_branch(std::size_t(f.branches()), inertia);
    team->run(f.branches(), [&](int k) {
      factor_panels(f, f.branch[std::size_t(k)], f.branch[std::size_t(k) + 1], true, most_negative,
                    of_branch[std::size_t(k)]);
    });
    for (const Inertia& one : of_branch) inertia += one;
    if (!ended()) share_trunk(f, *team, [&](const Rows& columns) { update_trunk(f, columns); });
    for (int p = f.branch.back(); p < f.panels() && !ended(); ++p)
      if (finish_one(f, p, most_negative, inertia)) update_shared(f, p, *team);
  }
  // after an early end the threads may have stopped at different columns
  if (ended() && inertia.usable) inertia.negative_pivots = most_negative + 1;
  return inertia;
}

void solve_numbers(const BlockFactor& f, Entry* x, Team* team) {
  if (!team || f.branches() == 0) {
    forward(f, 0, f.panels(), false, x);
    backward(f, 0, f.panels(), x);
    return;
  }
  const auto begin = [&](int k) { return f.branch[std::size_t(k)]; };
  team->run(f.branches(), [&](int k) { forward(f, begin(k), begin(k + 1), true, x); });
  share_trunk(f, *team, [&](const Rows& columns) { forward_to_trunk(f, columns, x); });
  forward(f, f.branch.back(), f.panels(), true, x);
  backward(f, f.branch.back(), f.panels(), x);
  team->run(f.branches(), [&](int k) { backward(f, begin(k), begin(k + 1), x); });
}

std::vector<int> branches_of(const BlockFactor& f) {
  constexpr double worth_sharing = 5e5;  // products of blocks, some 4 ms
  constexpr double branches = 16;        // least number of branches with all of the work
  const auto rows = [&](int k) { return f.rows_below(k); };
  const auto up = [&](int k) {
    return rows(k) > 0 ? f.row[std::size_t(f.first[std::size_t(k)])] : -1;
  };
  std::vector<double> work(std::size_t(f.columns), 0);  // work of a column and of its subtree
  double total = 0;
  for (int k = 0; k < f.columns; ++k) {
    const double own = 0.5 * (rows(k) + 1) * (rows(k) + 2);
    total += own;
    work[std::size_t(k)] += own;
    if (up(k) >= 0) work[std::size_t(up(k))] += work[std::size_t(k)];
  }
  std::vector<int> branch(std::size_t(f.columns), 0);
  if (total < worth_sharing) return branch;
  const auto light = [&](int k) { return work[std::size_t(k)] * branches <= total; };
  int count = 0;
  double filled = 0;
  std::ranges::fill(branch, -1);
  for (int k = 0; k < f.columns; ++k) {
    if (!light(k) || (up(k) >= 0 && light(up(k)))) continue;
    // small branches are combined
    if (filled * 2 * branches > total) ++count, filled = 0;
    branch[std::size_t(k)] = count;
    filled += work[std::size_t(k)];
  }
  for (int k = f.columns - 1; k >= 0; --k)
    if (!light(k))
      branch[std::size_t(k)] = count + 1;
    else if (branch[std::size_t(k)] < 0)
      branch[std::size_t(k)] = branch[std::size_t(up(k))];
  return branch;
}

void plan_sharing(BlockFactor& f, const std::vector<int>& branch) {
  const auto of_panel = [&](int p) { return branch[std::size_t(f.panel[std::size_t(p)])]; };
  const int trunk = branch.back();  // the last column is a root
  f.branch = {0};
  for (int p = 1; p < f.panels(); ++p)
    if (of_panel(p) != of_panel(p - 1)) f.branch.push_back(p);
  f.work_to.assign(std::size_t(f.columns) + 1, 0);
  for (int p = 0; p < f.panels(); ++p) {
    const int last = f.panel[std::size_t(p) + 1] - 1, end = f.first[std::size_t(last) + 1],
              begin = f.first[std::size_t(last)];
    int across = end;  // rows in the trunk come after the branch's own
    if (of_panel(p) != trunk)
      while (across > begin && branch[std::size_t(f.row[std::size_t(across) - 1])] == trunk)
        --across;
    f.own_rows.push_back(across - begin);
    if (across < end) f.crossing.push_back(p);
    for (int i = across; i < end; ++i)
      f.work_to[std::size_t(f.row[std::size_t(i)]) + 1] +=
          double(end - i) * (last + 1 - f.panel[std::size_t(p)]);
  }
  std::partial_sum(f.work_to.begin(), f.work_to.end(), f.work_to.begin());
}

}  // namespace gridshell
