// The library of a shell's states: each is distinguished from the others modulo the symmetries of
// the shell and measured (certificate on finer meshes, symmetry, modes, range in which it exists).
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

/// The meshes on which states are measured: those that the scene's accuracy requires, but at least
/// two, over which energies are extrapolated.
LevelPlan measuring_plan(const Scene& scene);

/// A stable equilibrium of a shell at the end of its actuation.
struct ShellState {
  record::StateRow row;  ///< its measures, and the number of trials that ended in it
  record::Frame frame;   ///< extrapolated as planned, upright if up and down are equivalent
  State rest;            ///< on the mesh of judged_edges
  double energy_mJ = 0;  ///< on that mesh, as a trial found it
  Effort effort = {};    ///< of measuring it
};

/// Measures states, one after another; one object per thread.
class StateMeasures {
 public:
  /// `tolerance_mm`: joints displaced by less under a symmetry count as fixed. Errors (bad_input):
  /// rods that the rod model does not support.
  static Result<StateMeasures> make(std::shared_ptr<const Scene> scene, double tolerance_mm);

  /// Measures the state `met` that a trial found; the result has no number yet. `life`: also find
  /// the range in which it exists. Empty if the state does not exist on finer meshes, is unstable
  /// on them, or its rods exceed the allowed strain.
  std::optional<ShellState> of(const ShellState& met, bool life, const Watch& watch);

  const Simulation& session() const { return session_; }
  /// Symmetries of the shell on the finest mesh.
  const std::vector<MeshSymmetry>& symmetries() const { return fine_; }

 private:
  StateMeasures(std::shared_ptr<const Scene> scene, double tolerance_mm, Simulation session,
                Simulation path);
  State upright(const State& rest) const;
  void put_life(const State& rest, record::StateRow& row, const Watch& watch);
  double eigenvalue(const Watch& watch);

  std::shared_ptr<const Scene> scene_;
  double tolerance_mm_;
  Simulation session_, path_;  // on all meshes; on the coarsest alone
  std::vector<MeshSymmetry> coarse_, fine_;
};

/// Identifies states, modulo symmetries, by their energies and the positions of their joints.
class StateCatalogue {
 public:
  /// `tolerance_mm`: shapes whose joints are nearer than that are one state.
  StateCatalogue(std::vector<MeshSymmetry> symmetries, double tolerance_mm);

  /// Index of the state of which `joints` (3 x n, mm) are an image under a symmetry; none: it is
  /// not in the catalogue.
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

/// The states that a search found.
struct StateLibrary {
  std::vector<ShellState> states;      ///< in ascending order of energy
  record::StateSearch search;          ///< how they were searched for
  record::Layout layout;               ///< of the frames
  Effort effort;                       ///< of all measurements
  int dof = 0, edges_per_segment = 0;  ///< of the finest mesh
};

struct SearchOptions {
  int threads = 1;
  bool lives = true;  ///< find the range of the path in which each state exists
};

/// Perturbs the shell of a scene `jitter.trials` times, and `jitter.confined` times with an imposed
/// symmetry, and certifies each state that it reaches, once, on the meshes of measuring_plan(). The
/// result does not depend on the number of threads. Errors: bad_input; cancelled; no_equilibrium,
/// with the reasons, if no trial ends in a state that finer meshes confirm.
Result<StateLibrary> find_states(const std::shared_ptr<const Scene>& scene,
                                 const preset::SearchSettings& jitter, const SearchOptions& options,
                                 Watch& watch);

/// Results of a run in addition to the frames of its states.
struct StateSearchRun {
  record::Summary summary;  ///< of the state of lowest energy
  record::StateTables tables;
};

/// Summary of the state of lowest energy. The library has at least one state.
record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const StateLibrary& library);

/// find_states() of a preset, then the transitions between them and the barriers; the states are
/// passed to `sink` as frames in the order of energy. Errors: as find_states(), and the sink's.
Result<StateSearchRun> run_states(const preset::Preset& preset, int threads, record::Sink& sink,
                                  Watch& watch);

// Transitions and energy barriers between the states of a library. Both functions report their
// progress to the watch, from `begun` to `end`. Errors: bad_input, cancelled.

/// The states that the first `jitter.transitions` states of a library become when they are
/// perturbed: once by releasing the boundary past the end of the state's range and contracting it
/// again, and by eight random sets of pushes. A transition to a state that is not in the library
/// has the target 0; perturbations that do not converge are left out.
Result<std::vector<record::Transition>> transitions_between(
    const StateLibrary& library, const std::shared_ptr<const Scene>& scene,
    const preset::SearchSettings& jitter, int threads, double begun, double end, Watch& watch);

/// The lowest mountain passes between the states of a library that its picture shows, on the mesh
/// of judged_edges. A minimum-energy path is computed from each state to the nearest images of two
/// others. A descent from the saddle on either side finds the states that the pass connects. Of
/// several passes between two states the lowest is returned. The numbers of paths and passes are
/// written to `library.search`, the lowest barrier of each state to its row.
Result<std::vector<record::Barrier>> barriers_between(StateLibrary& library,
                                                      const std::shared_ptr<const Scene>& scene,
                                                      const preset::SearchSettings& jitter,
                                                      int threads, double begun, double end,
                                                      Watch& watch);

}  // namespace gridshell::study
