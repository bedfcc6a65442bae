// Legs of a circle with n rods per direction as the paper counts them, in units of d [Baek 2018,
// 'Elastic Gridshells with Circular Boundaries'].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/states.h"
#include "engine/record/sweep_results.h"

namespace gridshell::record {

/// L_d = R_o/d - (n - 1)/2: from the outermost rod to the boundary, on an axis.
inline double longest_leg(double radius_over_d, int rods) {
  return radius_over_d - 0.5 * (rods - 1);
}

/// l_d = sqrt((R_o/d)^2 - ((n - 1)/2)^2) - (n - 1)/2: from the corner of the grid along the
/// outermost rod; below 0 where the corner lies outside of the boundary.
inline double shortest_leg(double radius_over_d, int rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::sqrt(std::max(0.0, radius_over_d * radius_over_d - outermost * outermost)) -
         outermost;
}

/// The L_d at which the shortest leg is `leg`: what shortest_leg() inverts.
inline double longest_leg_at(double leg, double rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::hypot(leg + outermost, outermost) - outermost;
}

// Results of a search for states, as results of a point of a sweep.

// for a circle, with or without a search: L_d and l_d
inline constexpr const char* longest_leg_name = "longest_leg";
inline constexpr const char* corner_leg_name = "corner_leg";

/// How often states of one kind were found.
struct StateCount {
  int states = 0;        ///< different ones
  int met = 0;           ///< trials that ended in them
  int met_confined = 0;  ///< of those begun in symmetric forms

  bool operator==(const StateCount&) const = default;
};

/// jitter_seed, trials, at_rest, confined_trials, confined_at_rest, states, seen (by trials without
/// imposed symmetry), chao1; then for each class, and for states of first-mode buckling, the three
/// of StateCount: states_ii, met_ii, met_confined_ii ... states_first_order ...
Figures search_figures(const StateSearch& search, const std::vector<StateRow>& rows);

/// What search_figures() said of the kind "i" ... "other" or "first_order"; nothing where the
/// figures are of no search.
std::optional<StateCount> state_count(const PointResult& result, const std::string& kind);

// A sweep of searches for states over the longest leg and the number of rods, as the phase diagram
// of [Baek 2018, Fig. 2B], and what it says of the paper's sentences about it.

/// A footprint that was searched.
struct PhasePoint {
  double longest_leg = 0;   ///< L_d
  int rods = 0;             ///< n
  double shortest_leg = 0;  ///< l_d
  int seed = 0;             ///< of the sweep; several searches of one footprint count by themselves
  bool found = false;       ///< whether the search ended in any state; all below is 0 where not
  int states = 0, at_rest = 0;
  std::array<StateCount, 5> classes;  ///< by StateClass
  StateCount first_order;             ///< of any class

  const StateCount& of(StateClass kind) const { return classes[std::size_t(kind)]; }
  /// States that the paper did not draw: of no class, or further ones of a class.
  int beyond_paper() const;
};

using PhaseDiagram = std::vector<PhasePoint>;

/// Whether a sweep over these keys is one: footprint.longest_leg and footprint.rods, no other.
bool makes_phase_diagram(const std::vector<std::string>& axes);

/// The diagram of one case of a table whose axes make one.
PhaseDiagram phase_diagram_of(const SweepTable& table, const std::string& case_name);

/// What was found between two values of the shortest leg.
struct PhaseRegion {
  double above = 0, to = 0;            ///< above < l_d <= to; not finite: no such end
  int points = 0;                      ///< with states
  int dome_alone = 0;                  ///< of them, with states of the first order and no other
  int broken = 0;                      ///< with a state of less than full symmetry
  int several = 0;                     ///< with more states than one
  std::array<int, 5> with = {};        ///< with states of each class
  int at_rest = 0;                     ///< trials, symmetric forms not among them
  int met_first_order = 0;             ///< of them, that ended in states of the first order
  int with_more = 0, more_states = 0;  ///< points with states that the paper did not draw; these
};

/// By the lines that the paper draws: above l_d = 1, down to 0, down to -1, and below.
std::vector<PhaseRegion> regions_of(const PhaseDiagram& diagram);

/// "l_d > 1", "0 < l_d <= 1", "l_d <= -1".
std::string name_of(const PhaseRegion& region);

/// A line of regions.csv.
template <RecordOf<PhaseRegion> Region, class Visit>
void fields(Region& region, const Visit& visit) {
  const std::string name = name_of(region);
  visit_each(visit, "shortest_leg", name, "points", region.points, "first_order_alone",
             region.dome_alone, "symmetry_broken", region.broken, "several_states", region.several);
  for (const auto& [kind, word] : words_of<StateClass>())
    visit(("with_" + std::string(word)).c_str(), region.with[std::size_t(kind)]);
  visit_each(visit, "at_rest", region.at_rest, "met_first_order", region.met_first_order,
             "with_more_than_paper", region.with_more, "states_more", region.more_states);
}

}  // namespace gridshell::record
