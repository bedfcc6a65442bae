// The symmetric Hessian in 3x3 blocks over pairs of columns, and the index of each block.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "engine/core/block3.h"
#include "engine/core/team.h"

namespace gridshell {

/// Index of a block: twice the index of its pair of columns, plus one if the block is the transpose
/// of the stored one. Below zero: there is no such block.
using BlockSlot = int;

/// The pairs of columns between which there is a block, each once.
class BlockPattern {
 public:
  explicit BlockPattern(int columns = 0) : pairs_of_(std::size_t(columns)) {}

  /// The index of block (row, column); a pair that is new becomes the last. Row and column differ.
  BlockSlot slot(int row, int column);
  /// The index of a block whose pair is known, else -1.
  BlockSlot find(int row, int column) const;

  const std::vector<std::array<int, 2>>& pairs() const { return pairs_; }

 private:
  std::vector<std::array<int, 2>> pairs_;                   // row and column of the block stored
  std::vector<std::vector<std::pair<int, int>>> pairs_of_;  // per smaller column: larger, index
};

/// The Hessian, N/mm: blocks on the diagonal (one per column), off the diagonal (one per pair of
/// the pattern), and outside the pattern; and a matrix of rank one that connects all columns.
struct BlockHessian {
  /// A block outside the pattern, between edges that come near each other or between nodes of a
  /// face under pressure. It may be zero; several may belong to one pair of columns.
  struct Extra {
    int row = 0, column = 0;
    Block3 block;
  };
  std::vector<Block3> diagonal, pair;
  std::vector<Extra> extra;
  Eigen::Matrix3Xd rank_one{};  ///< c, 3 x columns: c c^T is added; empty: none

  void reset(std::size_t columns, std::size_t pairs, Team* team = nullptr) {
    diagonal.assign(columns, {});
    pair.resize(pairs);
    const int pieces = team ? team->threads() : 1;
    parallel_for(team, pieces, [&](int k) {
      const auto at = [&](int piece) { return pair.begin() + long(pairs * piece / pieces); };
      std::fill(at(k), at(k + 1), Block3{});
    });
    extra.clear();
    rank_one.resize(3, 0);
  }
  void add(BlockSlot slot, const Block3& block) {
    Block3& known = pair[std::size_t(slot >> 1)];
    if (slot & 1) {
      Block3 transposed;
      transpose(block, transposed);
      known += transposed;
    } else {
      known += block;
    }
  }
  template <class Matrix>
  void add(BlockSlot slot, const Eigen::MatrixBase<Matrix>& block) {
    if (slot & 1)
      pair[std::size_t(slot >> 1)].matrix() += block.transpose();
    else
      pair[std::size_t(slot >> 1)].matrix() += block;
  }
  void add_entry(BlockSlot slot, int row, int column, double value) {
    if (slot & 1) std::swap(row, column);
    pair[std::size_t(slot >> 1)].matrix()(row, column) += value;
  }
};

}  // namespace gridshell
