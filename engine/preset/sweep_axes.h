// Reads what a sweep goes over: `[sweep.over]` with keys in dotted form.
//   rod.diameter_mm = [0.2, 0.3]
//   actuation.radius_mm = { from = 90, to = 110, count = 5 }
#pragma once

#include <toml++/toml.h>
#include <string>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// What is wrong with a part of a table, and where.
struct AxisFault {
  toml::source_region place;
  std::string text;  ///< "[sweep.over] rod.diameter_mm = "x": is a string, must be a number > 0"
};

/// The axes in the order in which they are written; what is wrong is added to `faults`, and an axis
/// with a fault is left out. Each value was assigned to its key once and is within its range.
std::vector<SweepAxis> read_axes(const toml::table& over, std::vector<AxisFault>& faults);

/// Whether a table of keys can change a number of a run: those of pictures and of the sweep itself
/// cannot.
bool counts_for_numbers(const std::string& table);

}  // namespace gridshell::preset
