#include "engine/record/phase_diagram.h"

#include <fmt/format.h>
#include <limits>

#include "engine/core/text.h"

namespace gridshell::record {
namespace {

constexpr const char* first_order = "first_order";  // name of first-mode buckling in figures

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

constexpr double endless = std::numeric_limits<double>::infinity();

/// A figure as an integer; 0 if there is none.
int whole_figure(const PointResult& result, const char* name) {
  const Figure* figure = result.figure(name);
  const double number = figure ? number_of(*figure) : std::nan("");
  return std::isfinite(number) ? int(number) : 0;
}

PhasePoint point_of(const SweepTable::Row& row, bool legs_first) {
  PhasePoint point;
  point.longest_leg = parse_number<double>(row.keys.values[legs_first ? 0 : 1]).value_or(unknown);
  point.rods = parse_number<int>(row.keys.values[legs_first ? 1 : 0]).value_or(0);
  point.shortest_leg = shortest_leg(point.longest_leg + 0.5 * (point.rods - 1), point.rods);
  point.seed = row.keys.seed;
  const auto first_mode = state_count(row.result, first_order);
  point.found = first_mode.has_value();
  if (!point.found) return point;
  point.first_order = *first_mode;
  point.states = whole_figure(row.result, "states");
  point.at_rest = whole_figure(row.result, "at_rest");
  for (const auto& [kind, word] : words_of<StateClass>())
    point.classes[std::size_t(kind)] =
        state_count(row.result, std::string(word)).value_or(StateCount{});
  return point;
}

/// Adds the states of a point to its region.
void count(const PhasePoint& point, PhaseRegion& region) {
  ++region.points;
  region.first_order_alone += point.first_order.states == point.states;
  // classes i and iv have full symmetry
  region.symmetry_broken +=
      point.of(StateClass::i).states + point.of(StateClass::iv).states < point.states;
  region.several_states += point.states > 1;
  for (std::size_t k = 0; k < region.with.size(); ++k)
    region.with[k] += point.classes[k].states > 0;
  region.at_rest += point.at_rest;
  region.met_first_order += point.first_order.met;
  region.with_more_than_paper += point.not_in_paper() > 0;
  region.states_more += point.not_in_paper();
}

}  // namespace

Figures search_figures(const StateSearch& search, const std::vector<StateRow>& rows) {
  Figures figures{{"jitter_seed", double(search.seed)},
                  {"trials", double(search.trials)},
                  {"at_rest", double(search.at_rest)},
                  {"confined_trials", double(search.confined_trials)},
                  {"confined_at_rest", double(search.confined_at_rest)},
                  {"states", double(rows.size())},
                  {"seen", double(search.completeness.seen)},
                  {"chao1", search.completeness.estimate}};
  for (const auto& [kind, word] : words_of<StateClass>()) {
    StateCount count;
    for (const StateRow& row : rows)
      if (row.kind == kind) add(count, row);
    put(figures, std::string(word), count);
  }
  StateCount count;
  for (const StateRow& row : rows)
    if (row.first_order()) add(count, row);
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

int PhasePoint::not_in_paper() const {
  int more = 0;
  for (const auto& [kind, word] : words_of<StateClass>())
    more += kind == StateClass::other ? of(kind).states : std::max(0, of(kind).states - 1);
  return more;
}

bool makes_phase_diagram(const std::vector<std::string>& axes) {
  return axes.size() == 2 && std::ranges::count(axes, leg_key) == 1 &&
         std::ranges::count(axes, rods_key) == 1;
}

PhaseDiagram phase_diagram_of(const SweepTable& table, const std::string& case_name) {
  PhaseDiagram diagram;
  for (const auto& row : table.rows)
    if (row.keys.case_name == case_name)
      diagram.push_back(point_of(row, table.axes.front() == leg_key));
  return diagram;
}

std::vector<PhaseRegion> regions_of(const PhaseDiagram& diagram) {
  std::vector<PhaseRegion> regions;
  for (const auto& [above, to] : {std::pair(1.0, endless), {0, 1}, {-1, 0}, {-endless, -1}}) {
    PhaseRegion region{.above = above, .to = to};
    for (const PhasePoint& point : diagram)
      if (point.found && point.shortest_leg > above && point.shortest_leg <= to)
        count(point, region);
    regions.push_back(region);
  }
  return regions;
}

std::string name_of(const PhaseRegion& region) {
  if (!std::isfinite(region.to)) return fmt::format("l_d > {}", region.above);
  if (!std::isfinite(region.above)) return fmt::format("l_d <= {}", region.to);
  return fmt::format("{} < l_d <= {}", region.above, region.to);
}

}  // namespace gridshell::record
