// What is measured on a state (its certificate on finer meshes, its symmetry, modes and life), and
// which of the states met so far it is, modulo the symmetries of the shell.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/footprint/symmetry.h"
#include "engine/record/frame.h"
#include "engine/record/states.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/shell_symmetry.h"
#include "engine/simulate/simulation.h"
#include "engine/study/state_search.h"

namespace gridshell::study {

using simulate::symmetries_of_shell;

/// The meshes that the accuracy asks for, but two at least, of which energies are extrapolated.
LevelPlan measuring_plan(const Scene& scene);

/// A stable equilibrium of a shell at the end of its actuation.
struct ShellState {
  record::StateRow row;  ///< what is measured, and how often trials ended in it
  record::Frame frame;   ///< extrapolated as planned, upright if up and down are equivalent
  State rest;            ///< on the mesh that states are judged on
  double energy_mJ = 0;  ///< there, as it was met
  Effort effort = {};    ///< of its measures
};

/// Measures states, one after another; one per thread.
class StateMeasures {
 public:
  /// `tolerance_mm`: joints displaced by less under a symmetry count as fixed. Errors (bad_input):
  /// rods that the rod model does not support.
  static Result<StateMeasures> make(std::shared_ptr<const Scene> scene, double tolerance_mm);

  /// A state as it was found, with its measures but without number; empty if finer meshes do not
  /// have it, have it unstable, or its rods exceed the allowed strain.
  std::optional<ShellState> of(const ShellState& met, bool life, const Watch& watch);

  const Simulation& session() const { return session_; }
  /// Symmetries of the finest mesh, and so of its joints.
  const std::vector<MeshSymmetry>& symmetries() const { return fine_; }

 private:
  StateMeasures(std::shared_ptr<const Scene> scene, double tolerance_mm, Simulation session,
                Simulation path);
  State upright(const State& rest) const;
  void put_life(const State& rest, record::StateRow& row, const Watch& watch);
  double eigenvalue(const Watch& watch);

  std::shared_ptr<const Scene> scene_;
  double tolerance_mm_;
  Simulation session_, path_;  // on all meshes, and on the coarsest alone
  std::vector<MeshSymmetry> coarse_, fine_;
};

/// States by the positions of their joints.
class StateCatalogue {
 public:
  /// `tolerance_mm`: joints of one and the same state lie nearer than that.
  StateCatalogue(std::vector<MeshSymmetry> symmetries, double tolerance_mm);

  /// The one that `joints` (3 x n, mm; energy in mJ) are an image of, if any.
  std::optional<std::size_t> find(const Eigen::Matrix3Xd& joints, double energy_mJ) const;
  /// Index of the state with these joints, which is added if it is new.
  std::size_t enter(const Eigen::Matrix3Xd& joints, double energy_mJ);

 private:
  struct Entry {
    Eigen::Matrix3Xd joints;
    double energy_mJ = 0;
  };
  std::vector<MeshSymmetry> symmetries_;
  double tolerance_mm_;
  std::vector<Entry> entries_;
};

// The states of a shell: searched by perturbations, distinguished modulo its symmetries, and
// measured.

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
                                 const preset::SearchSettings& jitter, const SearchOptions& options,
                                 Watch& watch);

/// Results of a run in addition to the frames of its states.
struct StateSearchRun {
  record::Summary summary;  ///< of the state of lowest energy
  record::StateTables tables;
};

/// The state of lowest energy of a library that has one, as a run's summary.
record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const StateLibrary& library);

/// find_states() of a preset, then the transitions between them and the barriers; the states are
/// passed to `sink` as frames in the order of energy. Errors: as find_states(), and the sink's.
Result<StateSearchRun> run_states(const preset::Preset& preset, int threads, record::Sink& sink,
                                  Watch& watch);

// Transitions between perturbed states, and the barriers between them. Both functions report their
// progress to the watch from `begun` to `end`. Errors: bad_input, cancelled.

/// Releases the boundary of the first `jitter.transitions` states of a library until each ends, and
/// contracts it again; and pushes each eight times. A transition to a state that is not in the
/// library has the target 0; runs that do not converge are left out.
Result<std::vector<record::Transition>> transitions_between(
    const StateLibrary& library, const std::shared_ptr<const Scene>& scene,
    const preset::SearchSettings& jitter, int threads, double begun, double end, Watch& watch);

/// The lowest mountain passes between the states of a library that its picture shows: a
/// minimum-energy path is computed from each to the nearest images of two others, and from the
/// saddle a descent on either side, whatever states it reaches. Of several passes between two
/// states the lowest is kept. On the mesh that states are judged on. The numbers of paths and
/// passes are written to `library.search`, the lowest barrier of each state to its row.
Result<std::vector<record::Barrier>> barriers_between(StateLibrary& library,
                                                      const std::shared_ptr<const Scene>& scene,
                                                      const preset::SearchSettings& jitter,
                                                      int threads, double begun, double end,
                                                      Watch& watch);

}  // namespace gridshell::study
