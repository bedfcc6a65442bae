// A sweep of searches for states over the longest leg and the number of rods, as the phase diagram
// of [Baek 2018, Fig. 2B], and what it says of the paper's sentences about it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/record/search_figures.h"

namespace gridshell::record {

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

/// The text of regions.csv: a row a region.
std::string regions_csv(const std::vector<PhaseRegion>& regions);

}  // namespace gridshell::record
