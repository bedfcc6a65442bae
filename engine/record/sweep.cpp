#include "engine/record/sweep.h"

#include <algorithm>

#include "engine/record/csv.h"
#include "engine/record/frame.h"

namespace gridshell::record {
namespace {

/// The names of all figures, in the order in which they first come.
std::vector<std::string> names_of(const SweepTable& table) {
  std::vector<std::string> names;
  for (const auto& row : table.rows)
    for (const auto& [name, figure] : row.result.figures)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

void put(Csv& csv, const Figure* figure) {
  if (!figure || std::holds_alternative<std::monostate>(*figure))
    csv.cell("");
  else if (const auto* flag = std::get_if<bool>(figure))
    csv.cell(*flag ? "true" : "false");
  else if (const auto* number = std::get_if<double>(figure))
    csv.cell(*number);
  else
    csv.cell(std::get<std::string>(*figure));
}

/// A string of TOML without its quotes.
std::string bare(const std::string& value) {
  const bool quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

}  // namespace

double number_of(const Figure& figure) {
  if (const auto* number = std::get_if<double>(&figure)) return *number;
  if (const auto* flag = std::get_if<bool>(&figure)) return *flag ? 1 : 0;
  return unknown;
}

const Figure* PointResult::figure(const std::string& name) const {
  for (const auto& [key, value] : figures)
    if (key == name) return &value;
  return nullptr;
}

std::string sweep_csv(const SweepTable& table) {
  const auto names = names_of(table);
  Csv csv;
  csv.cell("point");
  if (table.has_cases) csv.cell("case");
  for (const auto& axis : table.axes) csv.cell(axis);
  if (table.has_seeds) csv.cell("seed");
  csv.cell("outcome");
  for (const auto& name : names) csv.cell(name);
  csv.cell("reason");
  csv.end_line();
  for (const auto& [keys, result] : table.rows) {
    csv.cell(int(result.point));
    if (table.has_cases) csv.cell(keys.case_name);
    for (const auto& value : keys.values) csv.cell(bare(value));
    if (table.has_seeds) csv.cell(keys.seed);
    csv.cell(std::string(word_of(result.outcome)));
    for (const auto& name : names) put(csv, result.figure(name));
    csv.cell(result.reason);
    csv.end_line();
  }
  return std::move(csv).text();
}

}  // namespace gridshell::record
