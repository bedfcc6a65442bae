// What of a sweep's table a picture needs: numbers on its axes, names with units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/record/sweep.h"

namespace gridshell::render {

/// The name of a key or a figure as a picture says it, with its unit: "height (mm)".
std::string label_of(const std::string& name);

/// One axis of a sweep: its values in their order, as text and as numbers (their places from 1
/// where they are no numbers).
struct SweepScale {
  std::string label;
  std::vector<std::string> texts;
  std::vector<double> numbers;
  bool is_number = true;
};

/// The scale of axis `k` of a table; of its seeds where it has no axis.
SweepScale scale_of(const record::SweepTable& table, std::size_t k);

/// A row's place on that scale.
std::size_t place_of(const record::SweepTable& table, const SweepScale& scale,
                     const record::SweepTable::Row& row, std::size_t k);

/// A row's figure as a number, NaN where it has none; of largest_strain its size.
double number_of(const record::SweepTable::Row& row, const std::string& figure);

/// The limit that a row's run met: "locking"; empty: none.
std::string limit_of(const record::SweepTable::Row& row);

/// The cases in their order; one without a name where there are none.
std::vector<std::string> cases_of(const record::SweepTable& table);

}  // namespace gridshell::render
