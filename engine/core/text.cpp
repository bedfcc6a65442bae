#include "engine/core/text.h"

#include <cctype>

namespace gridshell {
namespace {

bool same(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // cost[i][j]: from the first i letters of a to the first j of b
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = int(i);
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = cost[i - 1][j - 1] + !same(a[i - 1], b[j - 1]);
      cost[i][j] = std::min({change, cost[i - 1][j] + 1, cost[i][j - 1] + 1});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  int least = std::max<int>(1, int(word.size()) / 3) + 1;
  for (const auto& name : known) {
    // long words are not compared letter by letter
    const auto longer = std::max(word.size(), name.size()),
               shorter = std::min(word.size(), name.size());
    if (longer - shorter >= std::size_t(least)) continue;
    const int distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      best = name;
    }
  }
  // a name without its end has a large distance
  if (best.empty() && word.size() >= 3)
    for (const auto& name : known)
      if (name.starts_with(word)) return name;
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const auto name = nearest(word, known);
  return name.empty() ? "" : "; did you mean '" + name + "'?";
}

std::string got_text(const std::string& key, const std::string& value, const std::string& reason) {
  const std::string got = key + ": got " + value;
  if (reason.starts_with("expected ")) return got + ", " + reason;
  const auto split = reason.find(", expected ");
  if (split == std::string::npos) return got + ": " + reason;
  return got + " (" + reason.substr(0, split) + ")" + reason.substr(split);
}

}  // namespace gridshell
