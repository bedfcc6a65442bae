// Phase diagram of circular footprints: which states were found over the longest leg and the number
// of rods [Baek 2018, Fig. 2B]. Legs are in units of d ['Elastic Gridshells with Circular
// Boundaries'].
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

/// Longest leg L_d = R_o/d - (n - 1)/2 of a circle with n rods per direction: from the outermost
/// rod to the boundary, on an axis.
inline double longest_leg(double radius_over_d, int rods) {
  return radius_over_d - 0.5 * (rods - 1);
}

/// Shortest leg l_d = sqrt((R_o/d)^2 - ((n - 1)/2)^2) - (n - 1)/2: from the corner of the grid
/// along the outermost rod; below 0 if the corner is outside of the boundary.
inline double shortest_leg(double radius_over_d, int rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::sqrt(std::max(0.0, radius_over_d * radius_over_d - outermost * outermost)) -
         outermost;
}

/// The longest leg at which the shortest leg is `leg`: the inverse of shortest_leg().
inline double longest_leg_at(double leg, double rods) {
  const double outermost = 0.5 * (rods - 1);
  return std::hypot(leg + outermost, outermost) - outermost;
}

// Results of a search for states, as results of a point of a sweep.

// names of the figures L_d and l_d, which every circular footprint has
inline constexpr const char* longest_leg_name = "longest_leg";
inline constexpr const char* corner_leg_name = "corner_leg";

/// How often states of one kind were found.
struct StateCount {
  int states = 0;        ///< number of different states
  int met = 0;           ///< number of trials that ended in them
  int met_confined = 0;  ///< number of trials started in symmetric forms that ended in them

  bool operator==(const StateCount&) const = default;
};

/// Figures of a search: jitter_seed, trials, at_rest, confined_trials, confined_at_rest, states,
/// seen (by trials without imposed symmetry), chao1; then for each class, and for first-mode
/// buckling, the members of StateCount: states_ii, met_ii, met_confined_ii ... states_first_order
/// ...
Figures search_figures(const StateSearch& search, const std::vector<StateRow>& rows);

/// The counts that search_figures() wrote for the kind "i" ... "other" or "first_order"; empty if
/// the result is not one of a search.
std::optional<StateCount> state_count(const PointResult& result, const std::string& kind);

// The diagram, made from a sweep of searches, and its comparison with the paper's statements.

/// A footprint whose states were searched for.
struct PhasePoint {
  double longest_leg = 0;   ///< L_d
  int rods = 0;             ///< n
  double shortest_leg = 0;  ///< l_d
  int seed = 0;        ///< seed of the sweep: several searches of one footprint are several points
  bool found = false;  ///< whether the search found any state; if not, all below is 0
  int states = 0, at_rest = 0;        ///< numbers of states, and of trials that reached equilibrium
  std::array<StateCount, 5> classes;  ///< counts of each StateClass
  StateCount first_order;             ///< counts of first-mode buckling, in any class

  const StateCount& of(StateClass kind) const { return classes[std::size_t(kind)]; }
  /// Number of states that the paper did not draw: those of no class, and all but one of each
  /// class.
  int not_in_paper() const;
};

using PhaseDiagram = std::vector<PhasePoint>;

/// Whether a sweep over these keys gives a diagram: footprint.longest_leg and footprint.rods, no
/// other.
bool makes_phase_diagram(const std::vector<std::string>& axes);

/// The diagram of one case of a table whose axes make one.
PhaseDiagram phase_diagram_of(const SweepTable& table, const std::string& case_name);

/// Numbers of points and trials in a range of the shortest leg.
struct PhaseRegion {
  double above = 0, to = 0;      ///< above < l_d <= to; infinite: unbounded
  int points = 0;                ///< points at which a state was found
  int first_order_alone = 0;     ///< points with first-mode buckling alone
  int symmetry_broken = 0;       ///< points with a state of less than full symmetry
  int several_states = 0;        ///< points with more than one state
  std::array<int, 5> with = {};  ///< points with states of each class
  int at_rest = 0;               ///< trials without imposed symmetry that reached equilibrium
  int met_first_order = 0;       ///< trials of these that ended in first-mode buckling
  int with_more_than_paper = 0,
      states_more = 0;  ///< points with states not in the paper; those states
};

/// The regions between the lines that the paper draws, at l_d = 1, 0 and -1.
std::vector<PhaseRegion> regions_of(const PhaseDiagram& diagram);

/// Name of a region: "l_d > 1", "0 < l_d <= 1", "l_d <= -1".
std::string name_of(const PhaseRegion& region);

/// The columns of regions.csv.
template <RecordOf<PhaseRegion> Region, class Visit>
void fields(Region& region, const Visit& visit) {
  const std::string name = name_of(region);
  visit("shortest_leg", name);
  GRIDSHELL_VISIT(visit, region.points, region.first_order_alone, region.symmetry_broken,
                  region.several_states);
  for (const auto& [kind, word] : words_of<StateClass>())
    visit(("with_" + std::string(word)).c_str(), region.with[std::size_t(kind)]);
  GRIDSHELL_VISIT(visit, region.at_rest, region.met_first_order, region.with_more_than_paper,
                  region.states_more);
}

}  // namespace gridshell::record
