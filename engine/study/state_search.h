// Search for other states of a shell by random perturbations [Baek 2018, 'DER Simulations and
// Jittering Algorithm']: independent trials, each with its own seed.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/record/shape_measures.h"
#include "engine/simulate/simulation.h"
#include "engine/study/multilevel_relaxation.h"

namespace gridshell::study {

/// Edges per segment of the mesh that trials end on and that distinguishes states.
inline constexpr int judged_edges = 4;

/// A state on the path of the actuation that trials perturb.
struct StartForm {
  double t = 1;  ///< path parameter
  State state;   ///< on the mesh of judged_edges
};

/// The states on the path of the actuation at the levels (progress) of `jitter`, or at the default
/// levels of its mode. A level that the path does not reach is left out. The mode "random" needs no
/// states: only their parameters are set. Errors: bad_input, cancelled; no_equilibrium if no level
/// is reached.
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

  /// The stable equilibrium at the end of the actuation that trial k reaches, on the mesh of
  /// judged_edges. Errors: no_equilibrium, with a short reason without numbers, so that trials can
  /// be counted by it; cancelled.
  Result<State> trial(int k, const Watch& watch);
  /// A trial from random positions that minimises the energy with the symmetry of the k-th of
  /// groups(), counted cyclically, before it does so without. Errors as trial().
  Result<State> symmetric_trial(int k, const Watch& watch);
  /// The state that `from`, at the end of the actuation, becomes if the boundary is released to
  /// progress `to` and contracted again; it may snap on the path. Errors as trial().
  Result<State> release_boundary(const State& from, double to, const Watch& watch);
  /// The state that `from` becomes after the k-th set of random pushes, which is the same for all
  /// states. Errors as trial().
  Result<State> push_at_random(const State& from, int k, const Watch& watch);

  const std::vector<SymmetryGroup>& groups() const { return groups_; }
  const std::vector<MeshSymmetry>& symmetries() const { return symmetries_; }
  /// Positions of the joints (3 x n, mm) and energy (mJ) of a state on the mesh of judged_edges.
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
  std::vector<MeshSymmetry> symmetries_;  // of the shell, on the mesh of judged_edges
  std::vector<SymmetryGroup> groups_;
  Eigen::VectorXd joint_length_;  // length of the rods that belongs to each joint, mm
  std::vector<int> pushable_;     // joints without a support
  MultilevelRelaxation cascade_;
  Simulation session_;
};

}  // namespace gridshell::study
