#include "engine/record/states.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/csv.h"

namespace gridshell {
namespace {

/// Variance of the estimate [Chao 1987, eq. 8; without f2 the bias-corrected form].
double variance(double f1, double f2, double estimate) {
  if (f2 > 0) {
    const double r = f1 / f2;
    return f2 * (r * r / 2 + r * r * r + r * r * r * r / 4);
  }
  return f1 * (f1 - 1) / 2 + f1 * (2 * f1 - 1) * (2 * f1 - 1) / 4 -
         f1 * f1 * f1 * f1 / (4 * estimate);
}

}  // namespace

RichnessEstimate chao1(const std::vector<int>& counts) {
  RichnessEstimate found;
  for (const int count : counts) {
    found.seen += count > 0;
    found.once += count == 1;
    found.twice += count == 2;
  }
  const double f1 = found.once, f2 = found.twice;
  const double unseen = f2 > 0 ? f1 * f1 / (2 * f2) : f1 * (f1 - 1) / 2;
  found.estimate = found.seen + unseen;
  found.low = found.high = found.seen;
  if (unseen <= 0) return found;
  const double spread =
      std::exp(1.96 * std::sqrt(std::log1p(variance(f1, f2, found.estimate) / (unseen * unseen))));
  found.low += unseen / spread;
  found.high += unseen * spread;
  return found;
}

}  // namespace gridshell

namespace gridshell::record {
namespace {

/// visit(name, member) for every column, in order: writer and reader go by it.
template <class Row, class Visit>
void each_state_column(Row& row, const Visit& visit) {
  visit("state", row.state);
  visit("class", row.kind);
  visit("group", row.group);
  for (const TermName& term : energy_terms)
    visit(fmt::format("energy_{}_mJ", term.name).c_str(), row.energies[term.term]);
  visit("height_mm", row.height_mm);
  visit("z_max_mm", row.z_max_mm);
  visit("z_min_mm", row.z_min_mm);
  visit("inflections", row.inflections);
  visit("count", row.count);
  visit("count_confined", row.count_confined);
  visit("lives_to", row.lives_to);
  visit("lives_to_radius_mm", row.lives_to_radius_mm);
  visit("eigenvalue_N_per_mm2", row.eigenvalue_N_per_mm2);
  visit("error_estimate_mm", row.error_estimate_mm);
  visit("barrier_mJ", row.barrier_mJ);
}

template <class Row, class Visit>
void each_transition_column(Row& row, const Visit& visit) {
  visit("from", row.from);
  visit("to", row.to);
  visit("by", row.by);
  visit("count", row.count);
}

template <class Row, class Visit>
void each_barrier_column(Row& row, const Visit& visit) {
  visit("from", row.from);
  visit("to", row.to);
  visit("energy_mJ", row.energy_mJ);
  visit("barrier_mJ", row.barrier_mJ);
  visit("back_mJ", row.back_mJ);
  visit("residual_N", row.residual_N);
}

template <class Search, class Visit>
void each_search_key(Search& search, const Visit& visit) {
  visit("mode", search.mode);
  visit("seed", search.seed);
  visit("trials", search.trials);
  visit("at_rest", search.at_rest);
  visit("confined_trials", search.confined_trials);
  visit("confined_at_rest", search.confined_at_rest);
  visit("ended_otherwise", search.ended_otherwise);
  visit("judged_edges_per_segment", search.judged_edges);
  visit("states_found", search.found);
  visit("states_that_finer_meshes_lose", search.finer_lost);
  visit("states_that_finer_meshes_merge", search.finer_merged);
  visit("seen", search.completeness.seen);
  visit("seen_once", search.completeness.once);
  visit("seen_twice", search.completeness.twice);
  visit("chao1", search.completeness.chao1);
  visit("chao1_low_95", search.completeness.low);
  visit("chao1_high_95", search.completeness.high);
  visit("cpu_s", search.cpu_s);
  visit("ways_followed_for_barriers", search.ways_followed);
  visit("passes_found", search.passes_found);
}

const auto each_state = [](auto& row, const auto& visit) { each_state_column(row, visit); };
const auto each_transition = [](auto& row, const auto& visit) {
  each_transition_column(row, visit);
};
const auto each_barrier = [](auto& row, const auto& visit) { each_barrier_column(row, visit); };

template <class Value>
auto cell_of(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(word_of(value));
  else
    return value;
}

template <class Row, class Each>
std::string csv_of(const std::vector<Row>& rows, const Each& each) {
  CsvWriter csv;
  const Row names;
  each(names, [&](const char* name, const auto&) { csv.cell(name); });
  csv.end_line();
  for (const Row& row : rows) {
    each(row, [&](const char*, const auto& value) { csv.cell(cell_of(value)); });
    csv.end_line();
  }
  return std::move(csv).text();
}

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto number = parse_number<Number>(text);
  value = number.value_or(value);
  return number.has_value();
}
bool take(const std::string& text, std::string& value) {
  value = text;
  return true;
}
bool take(const std::string& text, int& value) { return parse(text, value); }
bool take(const std::string& text, double& value) {
  value = unknown;
  return text.empty() || parse(text, value);
}
bool take(const std::string& text, StateClass& value) {
  const auto word = find_word<StateClass>(text);
  if (word) value = *word;
  return word.has_value();
}

/// No cell of these files holds a comma, a quote or a line's end.
std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

/// What may be missing: a number that is not known. Earlier versions had fewer columns.
template <class Value>
constexpr bool may_be_unknown = std::is_same_v<Value, double>;

/// The place of each column in a file by its heading, -1 for one that it does not have. Errors
/// (bad_input): a name that is no column or stands twice, no column for what cannot be unknown.
template <class Row, class Each>
Result<std::vector<int>> places_of(const std::string& heading, const Each& each) {
  const std::vector<std::string> names = split(heading, ',');
  std::vector<int> places;
  std::size_t found = 0;
  std::string missing;
  Row row;
  each(row, [&](const char* name, auto& value) {
    const auto at = std::ranges::find(names, name);
    places.push_back(at == names.end() ? -1 : int(at - names.begin()));
    found += at != names.end();
    if (at == names.end() && !may_be_unknown<std::decay_t<decltype(value)>>) missing = name;
  });
  if (!missing.empty())
    return fail(Fault::bad_input, fmt::format("its first line has no column {}", missing));
  if (found != names.size())
    return fail(Fault::bad_input, "its first line has columns twice or unknown ones");
  return places;
}

template <class Row, class Each>
Result<std::vector<Row>> read_csv(const std::filesystem::path& file, const Each& each) {
  TRY(text, read_file(file, largest_text));
  std::vector<std::string> lines = split(*text, '\n');
  if (lines.back().empty()) lines.pop_back();
  const auto places = places_of<Row>(lines.empty() ? "" : lines.front(), each);
  if (!places)
    return fail(Fault::bad_input, fmt::format("'{}': {}", file.string(), places.error().message));
  const std::size_t columns = split(lines.front(), ',').size();
  std::vector<Row> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> cells = split(lines[k], ',');
    std::size_t column = 0;
    std::string fault = cells.size() == columns ? "" : "number of cells";
    Row row;
    each(row, [&](const char* name, auto& value) {
      const int place = (*places)[column++];
      if (fault.empty() && !take(place < 0 ? "" : cells[std::size_t(place)], value)) fault = name;
    });
    if (!fault.empty())
      return fail(Fault::bad_input,
                  fmt::format("'{}' line {}: its {} cannot be read", file.string(), k + 1, fault));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

double StateRow::energy_mJ() const {
  double sum = 0;
  for (const TermName& term : energy_terms)
    if (!std::isnan(energies[term.term])) sum += energies[term.term];
  return sum;
}

std::vector<std::size_t> states_to_draw(const std::vector<StateRow>& rows, int most) {
  std::vector<std::size_t> order(rows.size()), chosen;
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto choose = [&](std::size_t k) {
    if (int(chosen.size()) < most && std::ranges::find(chosen, k) == chosen.end())
      chosen.push_back(k);
  };
  for (const auto& [kind, word] : words_of<StateClass>()) {
    const auto first = std::ranges::find(rows, kind, &StateRow::kind);
    if (kind != StateClass::other && first != rows.end()) choose(std::size_t(first - rows.begin()));
  }
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return rows[k].count; });
  for (const std::size_t k : order) choose(k);
  std::ranges::sort(chosen);
  return chosen;
}

std::string states_csv(const std::vector<StateRow>& rows) { return csv_of(rows, each_state); }

std::string transitions_csv(const std::vector<Transition>& rows) {
  return csv_of(rows, each_transition);
}

std::string barriers_csv(const std::vector<Barrier>& rows) { return csv_of(rows, each_barrier); }

std::string to_json(const StateSearch& search) {
  Json json = Json::object();
  each_search_key(search, [&](const char* key, const auto& value) { json[key] = value; });
  return text_of(json);
}

namespace {

/// Whether searches of earlier versions, which looked for no barriers, do not say it.
bool is_newer_key(const std::string& key) {
  return key == "ways_followed_for_barriers" || key == "passes_found";
}

/// Takes a value of the right kind; throws Json::exception where nothing else is right.
template <class Value>
bool take(const Json& json, Value& value) {
  json.get_to(value);
  return true;
}
bool take(const Json& json, int& value) {
  const auto number = whole_number(json);
  value = number.value_or(value);
  return number.has_value();
}
bool take(const Json& json, std::map<std::string, int>& counts) {
  return std::ranges::all_of(json.get<std::map<std::string, Json>>(), [&](const auto& item) {
    return take(item.second, counts[item.first]);
  });
}

Result<StateSearch> read_search(const std::filesystem::path& file) {
  TRY(text, read_file(file, largest_text));
  const Json json = parsed(*text);
  StateSearch search;
  std::string misfit;
  try {
    each_search_key(search, [&](const char* key, auto& value) {
      if ((json.contains(key) || !is_newer_key(key)) && !take(json.at(key), value)) misfit = key;
    });
  } catch (const Json::exception& error) {
    return fail(Fault::bad_input,
                fmt::format("'{}' is no search for states: {}", file.string(), error.what()));
  }
  if (!misfit.empty())
    return fail(Fault::bad_input, fmt::format("'{}': \"{}\" must be a whole number, as counts are",
                                              file.string(), misfit));
  return search;
}

}  // namespace

Result<void> write_state_tables(const std::filesystem::path& folder, const StateTables& tables) {
  return write_file(folder / states_name, states_csv(tables.rows))
      .and_then([&] { return write_file(folder / search_name, to_json(tables.search)); })
      .and_then([&]() -> Result<void> {
        if (tables.transitions.empty()) return {};
        return write_file(folder / transitions_name, transitions_csv(tables.transitions));
      })
      .and_then([&]() -> Result<void> {
        if (tables.barriers.empty()) return {};
        return write_file(folder / barriers_name, barriers_csv(tables.barriers));
      });
}

Result<StateTables> read_state_tables(const std::filesystem::path& folder) {
  StateTables tables;
  TRY(rows, read_csv<StateRow>(folder / states_name, each_state));
  tables.rows = std::move(*rows);
  TRY(search, read_search(folder / search_name));
  tables.search = std::move(*search);
  // a search need not have looked for these
  const auto read_if_there = [&](const char* name, auto each, auto& all) -> Result<void> {
    std::error_code error;
    if (!std::filesystem::exists(folder / name, error)) return {};
    using Row = typename std::decay_t<decltype(all)>::value_type;
    return read_csv<Row>(folder / name, each).map([&](std::vector<Row>&& read) {
      all = std::move(read);
    });
  };
  TRY_DO(read_if_there(transitions_name, each_transition, tables.transitions));
  TRY_DO(read_if_there(barriers_name, each_barrier, tables.barriers));
  return tables;
}

}  // namespace gridshell::record
