// How many kinds there are, from how often those that were met were met.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/result.h"
#include "engine/record/frame.h"

namespace gridshell {

/// An estimate with its interval of 95 %.
struct RichnessEstimate {
  int seen = 0;  ///< kinds met at all
  int once = 0, twice = 0;
  double estimate = 0;  ///< lower bound of the number of states that this search can find
  double low = 0, high = 0;
};

/// S + f1^2/(2 f2), f1 and f2 the kinds met once and twice; f1 (f1 - 1)/2 more where none was met
/// twice. The interval is that of a log-normal number of kinds unseen [Chao 1987].
RichnessEstimate chao1(const std::vector<int>& counts);

}  // namespace gridshell

// The states that a search found: one row of states.csv each, and states.json for the complete
// search. Their shapes are the frames of the run's trajectory, in the same order.

namespace gridshell::record {

/// The kinds of state of [Baek 2018, Fig. 2]: i, full symmetry and every rod of the first mode;
/// with rods of higher modes ii, two mirrors, iii, turns by 90 degrees alone, and iv, full
/// symmetry; none of these.
enum class StateClass { i, ii, iii, iv, other };

/// A state in the tables of others, by its name, "ii.2"; of one that was not met the number is 0
/// and the name empty.
struct StateName {
  int number = 0;  ///< StateRow::state
  StateClass kind = StateClass::other;

  operator int() const { return number; }
  std::string text() const;
};

/// One state.
struct StateRow {
  int state = 0;  ///< from 1, in the order of energy
  StateClass kind = StateClass::other;
  std::string group;                      ///< of symmetries, by Schoenflies' name
  Energies energies;                      ///< extrapolated over two meshes
  double height_mm = 0;                   ///< highest joint above the boundary's plane
  double z_max_mm = 0, z_min_mm = 0;      ///< highest and lowest point of a rod
  std::string inflections;                ///< of every rod, u rods first: "0 0 2 2 | 0 1 1 0"
  int count = 0;                          ///< trials that ended in it
  int count_confined = 0;                 ///< of those begun in symmetric forms
  double lives_to = unknown;              ///< progress: nearer to the flat it is not there
  double lives_to_radius_mm = unknown;    ///< of a circular boundary there
  double eigenvalue_N_per_mm2 = unknown;  ///< lowest, against lumped length of rod
  double error_estimate_mm = unknown;     ///< of the joints
  double barrier_mJ = unknown;            ///< lowest known pass out of it, above it

  /// Total potential energy; terms that files of an earlier version lack count as zero.
  double energy_mJ() const;
  /// Class and number, "ii.2".
  std::string name() const { return in_tables().text(); }
  StateName in_tables() const { return {state, kind}; }
  /// Whether every rod is buckled in its first mode: none has an inflection, as far as is known.
  bool first_order() const;
};
template <RecordOf<StateRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "state", row.state, "class", row.kind, "group", row.group);
  visit_energies(row.energies, visit);
  double sum = row.energy_mJ();  // reported, not stored
  visit("energy_mJ", sum);
  visit_each(visit, "height_mm", row.height_mm, "z_max_mm", row.z_max_mm, "z_min_mm", row.z_min_mm,
             "inflections", row.inflections, "count", row.count, "count_confined",
             row.count_confined, "lives_to", row.lives_to, "lives_to_radius_mm",
             row.lives_to_radius_mm, "eigenvalue_N_per_mm2", row.eigenvalue_N_per_mm2,
             "error_estimate_mm", row.error_estimate_mm, "barrier_mJ", row.barrier_mJ);
}

/// The complete search.
struct StateSearch {
  std::string mode;
  int seed = 0;
  int trials = 0, at_rest = 0;  ///< and the number of them that reached equilibrium
  int confined_trials = 0, confined_at_rest = 0;
  std::map<std::string, int> ended_otherwise;  ///< why, and how often
  /// edges per segment of the mesh that distinguishes states
  int judged_edges = 0;
  int found = 0;                             ///< states on it
  int finer_lost = 0;                        ///< of them, that finer meshes do not have
  int finer_merged = 0;                      ///< and that are one on finer meshes
  RichnessEstimate completeness;             ///< of the trials that are counted
  double cpu_s = 0;                          ///< of all trials
  int paths_followed = 0, passes_found = 0;  ///< from state to state, for the barriers
};
template <RecordOf<StateSearch> Search, class Visit>
void fields(Search& search, const Visit& visit) {
  auto& seen = search.completeness;
  visit_each(visit, "mode", search.mode, "seed", search.seed, "trials", search.trials, "at_rest",
             search.at_rest, "confined_trials", search.confined_trials, "confined_at_rest",
             search.confined_at_rest, "ended_otherwise", search.ended_otherwise,
             "judged_edges_per_segment", search.judged_edges, "states_found", search.found,
             "states_that_finer_meshes_lose", search.finer_lost, "states_that_finer_meshes_merge",
             search.finer_merged);
  visit_each(visit, "seen", seen.seen, "seen_once", seen.once, "seen_twice", seen.twice, "chao1",
             seen.estimate, "chao1_low_95", seen.low, "chao1_high_95", seen.high, "cpu_s",
             search.cpu_s, "paths_followed_for_barriers", search.paths_followed, "passes_found",
             search.passes_found);
}

/// What disturbs a state: its boundary released and contracted again, or one of its joints pushed.
enum class Disturbance { released, pushed };

/// A transition from state to state.
struct Transition {
  StateName from, to;
  Disturbance by = Disturbance::released;
  int count = 0;
};
template <RecordOf<Transition> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "from", row.from, "to", row.to, "by", row.by, "count", row.count);
}

/// A mountain pass between two states: a saddle of the energy with one descent to either side, on
/// the mesh that distinguishes states.
struct Barrier {
  StateName from, to;           ///< or an image of it
  double energy_mJ = 0;         ///< elastic, of the saddle
  double barrier_mJ = unknown;  ///< of the saddle above `from`
  double back_mJ = unknown;     ///< and above `to`
  double residual_N = unknown;  ///< of the saddle
};
template <RecordOf<Barrier> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "from", row.from, "to", row.to, "energy_mJ", row.energy_mJ, "barrier_mJ",
             row.barrier_mJ, "back_mJ", row.back_mJ, "residual_N", row.residual_N);
}

/// Everything of a search but the shapes.
struct StateTables {
  StateSearch search;
  std::vector<StateRow> rows;
  std::vector<Transition> transitions;
  std::vector<Barrier> barriers;
};

/// Which of the states, given in the order of energy, are drawn: the lowest of all, the lowest of
/// each of the paper's classes, then those met most often, `most` in all. Indices of `rows`,
/// ascending.
std::vector<std::size_t> states_to_draw(const std::vector<StateRow>& rows, int most);

inline constexpr const char* states_name = "states.csv";
inline constexpr const char* search_name = "states.json";
inline constexpr const char* transitions_name = "transitions.csv";
inline constexpr const char* barriers_name = "barriers.csv";

/// Writes these into a run's folder, the last two only where there is something in them. Errors:
/// io.
Result<void> write_state_tables(const std::filesystem::path& folder, const StateTables& tables);
/// What that wrote, or an earlier version: a number without a column is unknown. Errors: io;
/// bad_input naming file and line.
Result<StateTables> read_state_tables(const std::filesystem::path& folder);

}  // namespace gridshell::record
