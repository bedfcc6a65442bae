#include "engine/record/states.h"

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

/// Variance of the estimate [Chao 1987, eq. 8]; for f2 = 0 the bias-corrected form.
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

bool parse(const std::string& text, std::string& value) {
  value = text;
  return true;
}
bool parse(const std::string& text, StateClass& value) {
  const auto word = find_word<StateClass>(text);
  value = word.value_or(value);
  return word.has_value();
}
bool parse(const std::string& text, Disturbance& value) {
  // names of earlier versions are read, too
  const auto word = find_word<Disturbance>(text == "let out" ? "released"
                                           : text == "poked" ? "pushed"
                                                             : text);
  value = word.value_or(value);
  return word.has_value();
}
bool parse(const std::string& text, StateName& value) {
  value = {};
  if (text.empty()) return true;
  // earlier versions wrote the number alone; read_state_tables() adds the class
  const std::size_t dot = text.find('.');
  const auto number = parse_number<int>(text.substr(dot == text.npos ? 0 : dot + 1));
  value.number = number.value_or(0);
  return number && (dot == text.npos || parse(text.substr(0, dot), value.kind));
}
/// Reads a number; an empty cell is an unknown floating-point number.
template <class Number>
bool parse(const std::string& text, Number& value) {
  if constexpr (std::is_same_v<Number, double>) value = unknown;
  const auto number = parse_number<Number>(text);
  value = number.value_or(value);
  return number || (std::is_same_v<Number, double> && text.empty());
}

/// The error in the names of the columns; empty: none. Columns of floating-point numbers may be
/// missing, as in files of earlier versions.
template <class Row>
std::string heading_error(const std::vector<std::string>& names) {
  std::size_t found = 0;
  std::string missing;
  const Row any;
  fields(any, [&]<class Value>(const char* name, const Value&) {
    const bool there = std::ranges::find(names, name) != names.end();
    found += there;
    if (!there && !std::is_same_v<Value, double>) missing = name;
  });
  if (!missing.empty()) return "its first line has no column " + missing;
  return found == names.size() ? "" : "its first line has columns twice or unknown ones";
}

template <class Row>
Result<std::vector<Row>> read_csv(const std::filesystem::path& file) {
  TRY(text, read_file(file, largest_text));
  const auto lines = csv_cells(*text);
  const auto names = lines.empty() ? std::vector<std::string>() : lines.front();
  if (const std::string fault = heading_error<Row>(names); !fault.empty())
    return invalid("'{}': {}", file.string(), fault);
  std::vector<Row> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string>& cells = lines[k];
    std::string fault = cells.size() == names.size() ? "" : "number of cells";
    fields(rows.emplace_back(), [&](const char* name, auto& value) {
      const auto at = std::size_t(std::ranges::find(names, name) - names.begin());
      if (fault.empty() && !parse(at < cells.size() ? cells[at] : "", value)) fault = name;
    });
    if (!fault.empty())
      return invalid("'{}' line {}: its {} cannot be read", file.string(), k + 1, fault);
  }
  return rows;
}

/// Sets the class of a name from the list of states. False if the state is not in the list.
bool put_kind(const std::vector<StateRow>& rows, StateName& name) {
  if (name.number == 0) return true;
  const auto row = std::ranges::find(rows, name.number, &StateRow::state);
  if (row != rows.end()) name.kind = row->kind;
  return row != rows.end();
}

Result<StateSearch> read_search(const std::filesystem::path& file) {
  TRY(text, read_file(file, largest_text));
  StateSearch search;
  // earlier versions did not search for barriers
  const auto may_lack = [](const std::string& key) {
    return key == "paths_followed_for_barriers" || key == "passes_found";
  };
  const std::string fault = take_fields(parsed(*text), search, may_lack);
  if (fault.empty()) return search;
  return invalid("'{}' is no search for states: {}", file.string(), fault);
}

}  // namespace

double StateRow::energy_mJ() const {
  double sum = 0;
  for (const TermName& term : energy_terms)
    if (!std::isnan(energies[term.term])) sum += energies[term.term];
  return sum;
}

std::string StateName::text() const {
  return number == 0 ? "" : std::string(word_of(kind)) + "." + std::to_string(number);
}

bool StateRow::first_order() const {
  return inflections.find_first_of("123456789") == std::string::npos &&
         inflections.find('0') != std::string::npos;
}

std::vector<std::size_t> states_to_draw(const std::vector<StateRow>& rows, int most) {
  std::vector<std::size_t> order(rows.size()), chosen;
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto choose = [&](std::size_t k) {
    if (int(chosen.size()) < most && std::ranges::find(chosen, k) == chosen.end())
      chosen.push_back(k);
  };
  if (!rows.empty()) choose(0);
  for (const auto& [kind, word] : words_of<StateClass>()) {
    const auto first = std::ranges::find(rows, kind, &StateRow::kind);
    if (kind != StateClass::other && first != rows.end()) choose(std::size_t(first - rows.begin()));
  }
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return rows[k].count; });
  for (const std::size_t k : order) choose(k);
  std::ranges::sort(chosen);
  return chosen;
}

Result<void> write_state_tables(const std::filesystem::path& folder, const StateTables& tables) {
  TRY_DO(write_file(folder / states_name, csv_table(tables.rows)));
  TRY_DO(write_file(folder / search_name, text_of(json_of(tables.search))));
  if (!tables.transitions.empty())
    TRY_DO(write_file(folder / transitions_name, csv_table(tables.transitions)));
  if (!tables.barriers.empty())
    TRY_DO(write_file(folder / barriers_name, csv_table(tables.barriers)));
  return {};
}

Result<StateTables> read_state_tables(const std::filesystem::path& folder) {
  StateTables tables;
  TRY(rows, read_csv<StateRow>(folder / states_name));
  TRY(search, read_search(folder / search_name));
  tables.rows = std::move(*rows);
  tables.search = std::move(*search);
  // not every search writes these files
  const auto read_if_there = [&]<class Row>(const char* name, std::vector<Row>& all) {
    std::error_code error;
    if (!std::filesystem::exists(folder / name, error)) return Result<void>();
    return read_csv<Row>(folder / name).map([&](auto&& read) { all = std::move(read); });
  };
  TRY_DO(read_if_there(transitions_name, tables.transitions));
  TRY_DO(read_if_there(barriers_name, tables.barriers));
  const auto known = [&](auto& rows_of_pairs) {
    return std::ranges::all_of(rows_of_pairs, [&](auto& row) {
      return put_kind(tables.rows, row.from) && put_kind(tables.rows, row.to);
    });
  };
  if (!known(tables.transitions) || !known(tables.barriers))
    return invalid("'{}': {} or {} names a state that {} does not have", folder.string(),
                   transitions_name, barriers_name, states_name);
  return tables;
}

}  // namespace gridshell::record
