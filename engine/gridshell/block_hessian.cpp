#include "engine/gridshell/block_hessian.h"

#include <algorithm>

namespace gridshell {

BlockSlot BlockPattern::slot(int row, int column) {
  const auto [low, high] = std::minmax(row, column);
  auto& known = pairs_of_[std::size_t(low)];
  const auto at = std::find_if(known.begin(), known.end(),
                               [high = high](const auto& one) { return one.first == high; });
  if (at != known.end()) return 2 * at->second + (pairs_[std::size_t(at->second)][0] != row);
  known.emplace_back(high, int(pairs_.size()));
  pairs_.push_back({row, column});
  return 2 * known.back().second;
}

}  // namespace gridshell
