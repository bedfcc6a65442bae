#include "engine/preset/sweep_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "engine/preset/assign.h"
#include "engine/preset/field_table.h"
#include "engine/preset/suggest.h"

namespace gridshell::preset {
namespace {

constexpr std::int64_t most_values = 100000;

/// One swept key as it is written.
struct Entry {
  std::string table, key;
  toml::source_region place;
  const toml::node* value;

  std::string name() const { return table.empty() ? key : table + "." + key; }
};

/// The entries in the order of the file, which a table forgets.
std::vector<Entry> entries_of(const toml::table& over) {
  std::vector<Entry> entries;
  for (const auto& [key, node] : over) {
    const auto* inner = node.as_table();
    if (!inner) {
      entries.push_back({"", std::string(key.str()), key.source(), &node});
      continue;
    }
    for (const auto& [name, value] : *inner)
      entries.push_back({std::string(key.str()), std::string(name.str()), name.source(), &value});
  }
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    return std::tuple(entry.place.begin.line, entry.place.begin.column);
  });
  return entries;
}

/// Reads one entry; faults bear its name.
class AxisReader {
 public:
  AxisReader(const Entry& entry, std::vector<AxisFault>& faults) : entry_(entry), faults_(faults) {}

  std::optional<SweepAxis> read() {
    const std::size_t before = faults_.size();
    field_ = find_field(entry_.table, entry_.key);
    if (!field_) {
      std::vector<std::string> names;
      for (const auto& field : field_table())
        if (counts_for_numbers(field.table)) names.push_back(field.table + "." + field.key);
      refuse(*entry_.value, "unknown key" + did_you_mean(entry_.name(), names));
    } else if (!counts_for_numbers(entry_.table)) {
      refuse(*entry_.value, "changes no number of a run, must be a key of another table");
    } else if (const auto* list = entry_.value->as_array()) {
      if (list->empty()) refuse(*list, "is empty, must hold values");
      for (const auto& value : *list) take(value);
    } else if (const auto* range = entry_.value->as_table()) {
      take_range(*range);
    } else {
      refuse(*entry_.value, "must be a list of values or { from, to, count }");
    }
    if (faults_.size() > before) return std::nullopt;
    return SweepAxis{entry_.name(), std::move(values_)};
  }

 private:
  void refuse(const toml::node& value, const std::string& why) {
    const auto& region = value.source();
    // what was computed has no place of its own
    faults_.push_back({region.begin.line > 0 ? region : entry_.place,
                       fmt::format("[sweep.over] {} = {}: {}", entry_.name(), shown(value), why)});
  }

  void take(const toml::node& value) {
    Preset preset;
    if (const auto wrong = assign(*field_, value, preset, {}); !wrong.empty())
      return refuse(value, wrong);
    auto text = value_text(*field_, preset);
    if (!taken_.insert(text).second)
      return refuse(value, "stands there twice, must be another value");
    values_.push_back(std::move(text));
  }

  void take_range(const toml::table& range) {
    static const std::vector<std::string> known{"from", "to", "count", "log"};
    for (const auto& [key, value] : range)
      if (const std::string name(key.str()); std::ranges::find(known, name) == known.end())
        return refuse(range, fmt::format("has no '{}'{}, must be {{ from, to, count }}", name,
                                         did_you_mean(name, known)));
    const auto from = range["from"].value<double>(), to = range["to"].value<double>();
    const auto count = range["count"].as_integer();
    const bool log = range["log"].value_or(false);
    if (!from || !to || !count || !std::isfinite(*from) || !std::isfinite(*to))
      return refuse(range, "must be { from = a number, to = a number, count = an integer }");
    if (count->get() < 2 || count->get() > most_values)
      return refuse(range, fmt::format("count must be from 2 to {}", most_values));
    if (range.contains("log") && !range["log"].is_boolean())
      return refuse(range, "log must be true or false");
    if (log && !(*from > 0 && *to > 0)) return refuse(range, "even factors need numbers > 0");
    for (std::int64_t k = 0; k < count->get(); ++k) {
      const double part = double(k) / double(count->get() - 1);
      const double value = log ? *from * std::pow(*to / *from, part) : *from + part * (*to - *from);
      take_number(value, range);
    }
  }

  void take_number(double value, const toml::table& range) {
    // steps of 0.1 shall read 0.3, not 0.30000000000000004
    value = std::stod(fmt::format("{:.12g}", value));
    if (!std::holds_alternative<Integer>(field_->kind)) return take(toml::value<double>(value));
    if (value != std::round(value) || std::abs(value) > 1e9)
      return refuse(range, fmt::format("comes to {}, must be {}", value, allowed(*field_)));
    take(toml::value<std::int64_t>(std::int64_t(value)));
  }

  const Entry& entry_;
  std::vector<AxisFault>& faults_;
  const Field* field_ = nullptr;
  std::vector<std::string> values_;
  std::set<std::string> taken_;
};

}  // namespace

bool counts_for_numbers(const std::string& table) {
  static const std::vector<std::string> others{"",       "sweep", "movie", "style",
                                               "figure", "page",  "block", "join"};
  return std::ranges::find(others, table) == others.end();
}

std::vector<SweepAxis> read_axes(const toml::table& over, std::vector<AxisFault>& faults) {
  std::vector<SweepAxis> axes;
  for (const Entry& entry : entries_of(over))
    if (auto axis = AxisReader(entry, faults).read()) axes.push_back(std::move(*axis));
  return axes;
}

}  // namespace gridshell::preset
