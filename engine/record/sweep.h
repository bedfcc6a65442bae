// What the points of a sweep came to, and the table and pictures that are made of them.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/words.h"

namespace gridshell::record {

/// How a point of a sweep ended. A path that met a limit is done too: its figures say so.
enum class PointOutcome { done, no_equilibrium, refused };
constexpr auto words(PointOutcome) {
  return word_table<PointOutcome>({{PointOutcome::done, "done"},
                                   {PointOutcome::no_equilibrium, "no_equilibrium"},
                                   {PointOutcome::refused, "refused"}});
}

/// One figure of a run; nothing where it is not known.
using Figure = std::variant<std::monostate, bool, double, std::string>;
using Figures = std::vector<std::pair<std::string, Figure>>;

/// A figure as a number, NaN where it is none.
double number_of(const Figure& figure);

/// A finished point.
struct PointResult {
  std::size_t point = 0;
  PointOutcome outcome = PointOutcome::done;
  std::string reason;  ///< why it has no figures
  Figures figures;     ///< by the names of summary.json, units in them

  /// The figure of that name, nothing where there is none.
  const Figure* figure(const std::string& name) const;
};

/// What a point was set to, as the files say it.
struct PointKeys {
  std::string case_name;            ///< empty where the preset has no cases
  std::vector<std::string> values;  ///< as TOML, one an axis
  int seed = 0;                     ///< 0 where the sweep has one alone
};

/// A finished sweep, a row a point in their order.
struct SweepTable {
  std::vector<std::string> axes;  ///< "rod.diameter_mm"
  bool has_cases = false, has_seeds = false;
  struct Row {
    PointKeys keys;
    PointResult result;
  };
  std::vector<Row> rows;
};

/// The text of sweep.csv: point, case and seed where there are some, the keys, the outcome, every
/// figure that any point has, the reason.
std::string sweep_csv(const SweepTable& table);

}  // namespace gridshell::record
