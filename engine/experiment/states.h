// The states that a shell can rest in at the end of its actuation: looked for by shaking it, told
// apart modulo its symmetries, and measured.
#pragma once

#include <memory>
#include <vector>

#include "engine/experiment/jitter.h"
#include "engine/record/sink.h"
#include "engine/record/states.h"
#include "engine/record/summary.h"

namespace gridshell::experiment {

/// One of them.
struct ShellState {
  record::StateRow row;
  record::Frame frame;   ///< extrapolated as planned, upright where up and down are alike
  State rest;            ///< on the mesh that states are judged on
  double energy_mJ = 0;  ///< there
};

/// What a search found, in the order of energy.
struct StateLibrary {
  std::vector<ShellState> states;
  record::StateSearch search;
  record::Layout layout;               ///< of the frames
  Effort effort;                       ///< of the measures
  int dof = 0, edges_per_segment = 0;  ///< of the finest mesh
};

struct SearchOptions {
  int threads = 1;
  bool lives = true;  ///< find out how far back along the path each state lives
};

/// Shakes the shell of a scene `jitter.trials` times, and `jitter.confined` times from symmetric
/// forms, keeps each state once and certifies it on the meshes that the scene's accuracy asks for,
/// two at least. The same for any number of threads. Errors: bad_input; cancelled; no_equilibrium
/// where not one trial ends in a state, with the reasons.
Result<StateLibrary> find_states(const std::shared_ptr<const Scene>& scene,
                                 const preset::Jitter& jitter, const SearchOptions& options,
                                 Watch& watch);

/// What a run leaves beside the frames of its states.
struct StateRun {
  record::Summary summary;  ///< of the state of lowest energy
  record::StateTables tables;
};

/// The state of lowest energy of a library that has one, as a run's summary.
record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const StateLibrary& library);

/// find_states() of a preset, then the ways between them and the barriers; the states are handed to
/// `sink` as frames in the order of energy. Errors: as find_states(), and the sink's.
Result<StateRun> run_states(const preset::Preset& preset, int threads, record::Sink& sink,
                            Watch& watch);

}  // namespace gridshell::experiment
