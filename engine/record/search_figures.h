// What a search for states came to, as figures of a point of a sweep.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/record/states.h"
#include "engine/record/sweep.h"

namespace gridshell::record {

// of a circle, whether states are looked for or not
inline constexpr const char* longest_leg_name = "longest_leg";
inline constexpr const char* shortest_leg_name = "shortest_leg";

/// How often states of one kind were found.
struct StateCount {
  int states = 0;        ///< different ones
  int met = 0;           ///< trials that ended in them
  int met_confined = 0;  ///< of those begun in symmetric forms

  bool operator==(const StateCount&) const = default;
};

/// Whether every rod of a state is buckled in its first mode.
bool is_first_order(const StateRow& row);

/// jitter_seed, trials, at_rest, confined_trials, confined_at_rest, states, seen (by trials that
/// are not confined), chao1; then of each class, and of states of the first order, the three of
/// StateCount: states_ii, met_ii, met_confined_ii ... states_first_order ...
Figures search_figures(const StateSearch& search, const std::vector<StateRow>& rows);

/// What search_figures() said of the kind "i" ... "other" or "first_order"; nothing where the
/// figures are of no search.
std::optional<StateCount> state_count(const PointResult& result, const std::string& kind);

}  // namespace gridshell::record
