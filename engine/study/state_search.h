// Search for other states of a shell by perturbations [Baek 2018, 'DER Simulations and Jittering
// Algorithm']: one trial after another, each with its own seed.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/record/shape_measures.h"
#include "engine/simulate/simulation.h"
#include "engine/solve/multilevel_relaxation.h"

namespace gridshell::study {

/// Edges per segment of the mesh that trials end on and that distinguishes states.
inline constexpr int judged_edges = 4;

/// A state that the actuation passed: the start of a perturbation.
struct StartForm {
  double t = 1;  ///< path parameter
  State state;   ///< on the mesh that states are judged on
};

/// The forms at every level of `jitter` (its mode's own where it names none), along the path that
/// the actuation takes. A level that the path does not reach is left out; for "random" forms are
/// not needed and only their parameters are set. Errors: bad_input, cancelled; no_equilibrium where
/// none is reached.
Result<std::vector<StartForm>> forms_to_shake(const std::shared_ptr<const Scene>& scene,
                                              const preset::SearchSettings& jitter,
                                              const Watch& watch);

/// Makes trials; one object per thread. The result of trial k depends on the seed and k alone.
class StateSearcher {
 public:
  /// `forms` must outlive it. Errors (bad_input): rods that the rod model does not support.
  static Result<StateSearcher> make(std::shared_ptr<const Scene> scene,
                                    const preset::SearchSettings& jitter,
                                    const std::vector<StartForm>& forms);

  /// The stable equilibrium, at the end of the actuation, that trial k reaches on the mesh that
  /// states are judged on. Errors: no_equilibrium with the reason, in a few words that many trials
  /// share; cancelled.
  Result<State> trial(int k, const Watch& watch);
  /// A trial from a form with the imposed symmetry of the k-th of groups(), counted cyclically.
  Result<State> symmetric_trial(int k, const Watch& watch);
  /// From a state at the end of the actuation: the boundary released to progress `to` and
  /// contracted again, past the snaps on its path. Errors as trial().
  Result<State> release_boundary(const State& from, double to, const Watch& watch);
  /// Applies random pushes, the k-th set of this state.
  Result<State> push_at_random(const State& from, int k, const Watch& watch);

  const std::vector<SymmetryGroup>& groups() const { return groups_; }
  const std::vector<MeshSymmetry>& symmetries() const { return symmetries_; }
  /// Positions of the joints and energy (mJ) of a state on that mesh.
  Eigen::Matrix3Xd joints_of(const State& state) const;
  double energy_of(const State& state) { return cascade_.system().energy_at(state); }
  MultilevelRelaxation& cascade() { return cascade_; }
  const MultilevelRelaxation& cascade() const { return cascade_; }

 private:
  StateSearcher(std::shared_ptr<const Scene> scene, const preset::SearchSettings& jitter,
                const std::vector<StartForm>& forms, MultilevelRelaxation cascade,
                Simulation session);
  Result<State> pull_start(const StartForm& form, std::mt19937& random, const Watch& watch);
  Result<State> push_start(const StartForm& form, std::mt19937& random, const Watch& watch);
  Result<State> go_from(double from, const State& rest, double t, const Watch& watch);
  Result<State> go(double t, const Watch& watch);
  Eigen::Matrix3Xd random_nodes(double t, std::mt19937& random) const;

  std::shared_ptr<const Scene> scene_;
  preset::SearchSettings jitter_;
  const std::vector<StartForm>* forms_;
  std::vector<MeshSymmetry> symmetries_;  // of the shell, on the mesh that states are judged on
  std::vector<SymmetryGroup> groups_;
  Eigen::VectorXd joint_length_;  // of rod that belongs to each joint, mm
  std::vector<int> pushable_;     // joints without a support
  MultilevelRelaxation cascade_;
  Simulation session_;
};

}  // namespace gridshell::study
