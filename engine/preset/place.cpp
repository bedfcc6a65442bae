#include "engine/preset/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace gridshell::preset {

std::string Place::text() const {
  return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column);
}

std::string PlacedFaults::report() const {
  auto sorted = faults_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const PlacedFault& a, const PlacedFault& b) {
    const auto rank = [](const Place& p) { return std::tuple(p.line == 0, p.line, p.column); };
    return rank(a.place) < rank(b.place);
  });
  std::string text;
  std::set<std::string> seen;
  for (const auto& one : sorted) {
    const auto line = one.place.text() + ": " + one.text;
    if (seen.insert(line).second) text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

}  // namespace gridshell::preset
