#include "engine/record/search_figures.h"

#include <algorithm>
#include <cmath>

namespace gridshell::record {
namespace {

constexpr const char* first_order = "first_order";

void add(StateCount& count, const StateRow& row) {
  ++count.states;
  count.met += row.count;
  count.met_confined += row.count_confined;
}

void put(Figures& figures, const std::string& kind, const StateCount& count) {
  figures.emplace_back("states_" + kind, double(count.states));
  figures.emplace_back("met_" + kind, double(count.met));
  figures.emplace_back("met_confined_" + kind, double(count.met_confined));
}

}  // namespace

bool is_first_order(const StateRow& row) {
  return std::ranges::none_of(row.inflections, [](char c) { return c >= '1' && c <= '9'; });
}

Figures search_figures(const StateSearch& search, const std::vector<StateRow>& rows) {
  Figures figures{{"jitter_seed", double(search.seed)},
                  {"trials", double(search.trials)},
                  {"at_rest", double(search.at_rest)},
                  {"confined_trials", double(search.confined_trials)},
                  {"confined_at_rest", double(search.confined_at_rest)},
                  {"states", double(rows.size())},
                  {"seen", double(search.completeness.seen)},
                  {"chao1", search.completeness.chao1}};
  for (const auto& [kind, word] : words(StateClass{})) {
    StateCount count;
    for (const StateRow& row : rows)
      if (row.kind == kind) add(count, row);
    put(figures, std::string(word), count);
  }
  StateCount count;
  for (const StateRow& row : rows)
    if (is_first_order(row)) add(count, row);
  put(figures, first_order, count);
  return figures;
}

std::optional<StateCount> state_count(const PointResult& result, const std::string& kind) {
  StateCount count;
  const auto take = [&](const std::string& name, int& into) {
    const Figure* figure = result.figure(name + kind);
    const double number = figure ? number_of(*figure) : std::nan("");
    if (std::isfinite(number)) into = int(number);
    return std::isfinite(number);
  };
  if (!take("states_", count.states) || !take("met_", count.met) ||
      !take("met_confined_", count.met_confined))
    return std::nullopt;
  return count;
}

}  // namespace gridshell::record
