#include "engine/elastic/block_hessian.h"

namespace gridshell {

BlockSlot BlockPattern::find(int row, int column) const {
  const auto [low, high] = std::minmax(row, column);
  const auto& known = pairs_of_[std::size_t(low)];
  const auto at =
      std::ranges::find_if(known, [high = high](const auto& one) { return one.first == high; });
  if (at == known.end()) return -1;
  return 2 * at->second + (pairs_[std::size_t(at->second)][0] != row);
}

BlockSlot BlockPattern::slot(int row, int column) {
  const BlockSlot known = find(row, column);
  if (known >= 0) return known;
  const auto [low, high] = std::minmax(row, column);
  pairs_of_[std::size_t(low)].emplace_back(high, int(pairs_.size()));
  pairs_.push_back({row, column});
  return 2 * int(pairs_.size() - 1);
}

}  // namespace gridshell
