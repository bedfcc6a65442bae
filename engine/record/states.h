// Results of a search for the states of a shell: the tables of states, transitions and barriers,
// and an estimate of the number of states that were not found.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/result.h"
#include "engine/record/frame.h"

namespace gridshell {

/// Estimate of the number of kinds (here: states), from how often each was met.
struct RichnessEstimate {
  int seen = 0;              ///< number of kinds that were met
  int once = 0, twice = 0;   ///< number of kinds that were met once, twice
  double estimate = 0;       ///< lower bound of the number of kinds that this search can find
  double low = 0, high = 0;  ///< interval of 95 %
};

/// The estimator S + f1^2/(2 f2) of S kinds of which f1 were met once and f2 twice; S + f1 (f1 -
/// 1)/2 if f2 = 0. `counts`: how often each kind was met. The interval assumes a log-normal number
/// of unseen kinds [Chao 1987].
RichnessEstimate chao1(const std::vector<int>& counts);

}  // namespace gridshell

// The states that a search found: states.csv has one row per state, states.json describes the
// search. The shapes of the states are the frames of the run's trajectory, in the same order.

namespace gridshell::record {

/// The classes of states of [Baek 2018, Fig. 2]. i: full symmetry, every rod in its first mode. The
/// others have rods in higher modes: ii with two mirrors, iii with turns by 90 degrees alone, iv
/// with full symmetry. other: none of these.
enum class StateClass { i, ii, iii, iv, other };

/// Reference to a state in the tables of transitions and barriers, by its name, "ii.2". Number 0
/// and an empty name: a state that is not in states.csv.
struct StateName {
  int number = 0;  ///< StateRow::state
  StateClass kind = StateClass::other;

  operator int() const { return number; }
  std::string text() const;
};

struct StateRow {
  int state = 0;  ///< from 1, in the order of energy
  StateClass kind = StateClass::other;
  std::string group;                      ///< Schoenflies name of its group of symmetries
  Energies energies;                      ///< extrapolated over two meshes
  double height_mm = 0;                   ///< highest joint above the boundary's plane
  double z_max_mm = 0, z_min_mm = 0;      ///< highest and lowest point of a rod
  std::string inflections;                ///< number per rod, u-rods first: "0 0 2 2 | 0 1 1 0"
  int count = 0;                          ///< number of trials that ended in it
  int count_confined = 0;                 ///< number of trials from symmetric forms that did
  double lives_to = unknown;              ///< least progress of the actuation at which it exists
  double lives_to_radius_mm = unknown;    ///< radius of a circular boundary at that progress
  double eigenvalue_N_per_mm2 = unknown;  ///< lowest eigenvalue; masses are lumped lengths of rod
  double error_estimate_mm = unknown;     ///< estimated error of the joints' positions
  double barrier_mJ = unknown;  ///< energy of the lowest known pass out of it, above its own

  /// Total potential energy; terms that files of an earlier version lack count as zero.
  double energy_mJ() const;
  /// Class and number: "ii.2".
  std::string name() const { return in_tables().text(); }
  StateName in_tables() const { return {state, kind}; }
  /// Whether every rod is buckled in its first mode: the inflections are known and all are 0.
  bool first_order() const;
};
template <RecordOf<StateRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit("state", row.state);
  visit("class", row.kind);
  visit("group", row.group);
  visit_energies(row.energies, visit);
  double energy_mJ = row.energy_mJ();  // reported, not stored
  GRIDSHELL_VISIT(visit, energy_mJ, row.height_mm, row.z_max_mm, row.z_min_mm, row.inflections,
                  row.count, row.count_confined, row.lives_to, row.lives_to_radius_mm,
                  row.eigenvalue_N_per_mm2, row.error_estimate_mm, row.barrier_mJ);
}

/// Numbers of the complete search.
struct StateSearch {
  std::string mode;
  int seed = 0;
  int trials = 0, at_rest = 0;  ///< random trials; those that reached equilibrium
  /// trials that started in symmetric forms; those that reached equilibrium
  int confined_trials = 0, confined_at_rest = 0;
  std::map<std::string, int> ended_otherwise;  ///< other outcomes of trials, and their numbers
  /// edges per segment of the mesh that distinguishes states
  int judged_edges_per_segment = 0;
  int states_found = 0;                    ///< number of states on that mesh
  int states_that_finer_meshes_lose = 0;   ///< states of these that finer meshes do not have
  int states_that_finer_meshes_merge = 0;  ///< states of these that are equal on finer meshes
  RichnessEstimate completeness;           ///< estimate from the trials that are counted
  double cpu_s = 0;                        ///< processor time of all trials
  int paths_followed_for_barriers = 0,
      passes_found = 0;  ///< paths between states, for barriers; passes on them
};
template <RecordOf<StateSearch> Search, class Visit>
void fields(Search& search, const Visit& visit) {
  auto& seen = search.completeness;
  GRIDSHELL_VISIT(visit, search.mode, search.seed, search.trials, search.at_rest,
                  search.confined_trials, search.confined_at_rest, search.ended_otherwise,
                  search.judged_edges_per_segment, search.states_found,
                  search.states_that_finer_meshes_lose, search.states_that_finer_meshes_merge,
                  seen.seen);
  visit("seen_once", seen.once);
  visit("seen_twice", seen.twice);
  visit("chao1", seen.estimate);
  visit("chao1_low_95", seen.low);
  visit("chao1_high_95", seen.high);
  GRIDSHELL_VISIT(visit, search.cpu_s, search.paths_followed_for_barriers, search.passes_found);
}

/// How a state is disturbed: its boundary is released and contracted again, or a joint is pushed.
enum class Disturbance { released, pushed };

/// A transition between two states that a disturbance caused, and how often.
struct Transition {
  StateName from, to;
  Disturbance by = Disturbance::released;
  int count = 0;
  GRIDSHELL_FIELDS(from, to, by, count)
};

/// A mountain pass between two states: a saddle of the energy with one descent to either side, on
/// the mesh that distinguishes states.
struct Barrier {
  StateName from, to;           ///< `to`, or a symmetric image of that state
  double energy_mJ = 0;         ///< elastic energy of the saddle
  double barrier_mJ = unknown;  ///< energy of the saddle above that of `from`
  double back_mJ = unknown;     ///< energy of the saddle above that of `to`
  double residual_N = unknown;  ///< largest unbalanced force at the saddle
  GRIDSHELL_FIELDS(from, to, energy_mJ, barrier_mJ, back_mJ, residual_N)
};

/// Everything of a search but the shapes.
struct StateTables {
  StateSearch search;
  std::vector<StateRow> rows;
  std::vector<Transition> transitions;
  std::vector<Barrier> barriers;
};

/// The at most `most` states that are drawn, as ascending indices into `rows`, which are in the
/// order of energy: the lowest of all, the lowest of each of the paper's classes, then those met
/// most often.
std::vector<std::size_t> states_to_draw(const std::vector<StateRow>& rows, int most);

inline constexpr const char* states_name = "states.csv";
inline constexpr const char* search_name = "states.json";
inline constexpr const char* transitions_name = "transitions.csv";
inline constexpr const char* barriers_name = "barriers.csv";

/// Writes the four files into a run's folder; transitions and barriers only if there are any.
/// Errors: io.
Result<void> write_state_tables(const std::filesystem::path& folder, const StateTables& tables);
/// Reads files of write_state_tables() or of an earlier version; numbers without a column are
/// unknown. Errors: io; bad_input naming file and line.
Result<StateTables> read_state_tables(const std::filesystem::path& folder);

}  // namespace gridshell::record
